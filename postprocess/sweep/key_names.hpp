// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "postprocess/sweep/read_sweep.hpp"

namespace ice::sweep {

/// Name of a case's key on an axis or above a column, with its unit: "speed [m/s]"; a key that has
/// no such name is its own title.
std::string axis_title(const std::string& key);

/// Text of a setting for people: a number with six digits, of a path only the file's name, "-" for
/// none.
std::string short_text(const Setting& setting);

/// Key and value for a legend: "speed 0.5 m/s", "floes.count [20, 9]".
/// @param whole paths with their folders
std::string name_value(const std::string& key, const Setting& setting, bool whole);

}  // namespace ice::sweep
