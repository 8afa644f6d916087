// SPDX-License-Identifier: GPL-3.0-or-later
/// "Did you mean": the known name that a mistyped one was probably meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ice {

/// The name that differs from `wrong` by the fewest inserted, removed or changed letters; the first
/// of equals.
///
/// In names with dots, a right last part behind a wrong first one counts as one change, so that
/// "contact.density" finds "ice.density".
/// @return "" where more than a quarter of the longer name's letters differ (two are always
///         allowed), or half of them or more
/// Cost: the product of both lengths for each name. An empty list gives "".
std::string nearest_name(std::string_view wrong, const std::vector<std::string>& names);

}  // namespace ice
