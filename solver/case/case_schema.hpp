// SPDX-License-Identifier: GPL-3.0-or-later
/// One table of all case keys.
#pragma once

#include <string>
#include <vector>

#include "common/toml/schema.hpp"
#include "solver/case/case.hpp"

namespace ice {

/// One key of the case file and the member that takes its value.
struct CaseKey : Key {
    void (*store)(Case&, FloeGroup&, const Value&);
};

/// All keys in the order of the contract.
const std::vector<CaseKey>& case_keys();

/// The schema of these keys, for reading and explaining.
const Schema& case_schema();

}  // namespace ice
