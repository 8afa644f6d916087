// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace ice::report {

/// The page that web/build.mjs built: everything of a report but its title, body and data, for
/// which it has markers @NAME@.
std::string_view page_template();

}  // namespace ice::report
