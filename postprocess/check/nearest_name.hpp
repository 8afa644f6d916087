// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace ice::check {

/// The name that differs from `wrong` by the fewest inserted, removed or changed letters, or ""
/// when more than two fifths of the longer one's letters differ. The first of equals wins.
std::string nearest_name(const std::string& wrong, const std::vector<std::string>& names);

}  // namespace ice::check
