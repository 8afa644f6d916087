// SPDX-License-Identifier: GPL-3.0-or-later
/// Completed runs whose warnings affect their mean: the points of a curve to look at first.
#pragma once

#include <filesystem>
#include <string>

#include "postprocess/sweep/read_sweep.hpp"

namespace ice::sweep {

/// "2 of 4 completed runs have warnings that affect their mean, by up to 37 %"; "" where no run has
/// one. A warning whose effect was not measured does not count.
std::string affected_line(const Sweep& sweep);

/// HTML: that line, which opens to a list of these warnings by run; "" where there is none. Runs
/// are links as in run_table().
/// @param page  to whose folder the links are relative
std::string affected_section(const Sweep& sweep, const std::filesystem::path& page);

}  // namespace ice::sweep
