// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/toml/schema.hpp"

namespace ice {

/// A key's value as TOML writes it: floats with a point, an exponent or a name, texts quoted with
/// control characters escaped, lists in brackets; a list of whole numbers stays one.
std::string toml_text(const Value& value, const Key& key);

}  // namespace ice
