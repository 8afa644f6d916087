// SPDX-License-Identifier: GPL-3.0-or-later
/// The one exception of the project: place, fault and remedy.
#pragma once

#include <stdexcept>
#include <string>

namespace ice {

/// Exit codes of all programs (docs/contract.md, section 2).
enum class ExitCode { ok = 0, failed = 1, bad_input = 2, interrupted = 130 };

/// Thrown by the libraries; printed only by the programs' main functions.
///
/// `where` is a file, `file:line:column` or a key; `fault` one sentence; `remedy` tells the user
/// what to change. `what()` joins them: "where: fault\n  remedy".
class Error : public std::runtime_error {
public:
    Error(ExitCode code, const std::string& where, const std::string& fault,
          const std::string& remedy);

    /// Exit code the program should end with.
    ExitCode code() const { return code_; }

private:
    ExitCode code_;
};

/// Wrong command line, mesh, case or sphere file: exit code 2.
Error bad_input(const std::string& where, const std::string& fault, const std::string& remedy);

/// The run itself failed (disk full, diverged): exit code 1.
Error run_failed(const std::string& where, const std::string& fault, const std::string& remedy);

}  // namespace ice
