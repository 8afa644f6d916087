// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/base/error.hpp"

namespace ice {

namespace {

// The remedy has a line of its own, indented: in a terminal the fault and the cure stay apart.
std::string join(const std::string& where, const std::string& fault, const std::string& remedy) {
    std::string text = where.empty() ? fault : where + ": " + fault;
    if (!remedy.empty()) text += "\n  " + remedy;
    return text;
}

}  // namespace

Error::Error(ExitCode code, const std::string& where, const std::string& fault,
             const std::string& remedy)
    : std::runtime_error(join(where, fault, remedy)), code_(code) {}

Error bad_input(const std::string& where, const std::string& fault, const std::string& remedy) {
    return Error(ExitCode::bad_input, where, fault, remedy);
}

Error run_failed(const std::string& where, const std::string& fault, const std::string& remedy) {
    return Error(ExitCode::failed, where, fault, remedy);
}

}  // namespace ice
