// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "preprocess/field/field_spec.hpp"

namespace ice {

/// One key of a specification and the member that takes its value.
struct FieldKey : Key {
    void (*store)(FieldSpec&, const Value&);
};

/// All keys in the order in which they are shown.
const std::vector<FieldKey>& field_keys();

/// The keys of one pattern. Keys that all patterns have are not among them.
struct PatternKeys {
    std::string_view name;
    std::vector<std::string_view> required, optional;
};

/// In the order of FieldPattern.
const std::vector<PatternKeys>& pattern_keys();

}  // namespace ice
