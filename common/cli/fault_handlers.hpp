// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace ice {

/// From now on a program ends with one message, the contract's exit code and no file half-written
/// also where no exception reaches its main function:
///
/// - an exception in a thread or where none may leave: 1;
/// - SIGTERM and Ctrl-C, until the program catches them itself (catch_interrupts): 130;
/// - files at the size limit of the shell or the batch system (SIGXFSZ, which would kill it) are
///   written like those on a full disk, whose errors are checked;
/// - a pager that is quit, or head, does not end the program (SIGPIPE): see write_data().
///
/// Names of outputs under way (PartFile) are removed. @param program  for the messages; is copied
void install_fault_handlers(const std::string& program);

/// A program's message when memory runs out.
extern const char* const kOutOfMemory;

}  // namespace ice
