// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "postprocess/sweep/read_sweep.hpp"

namespace ice::sweep {

/// Fills axes, x and tied of a sweep from its runs' settings.
///
/// A key is an axis when two runs differ in it; runs that have no settings, because they failed
/// early, do not count. x is hull.speed where it varies, else the number with most values, the
/// first of equals. A key that has one value for each value of x (a duration chosen for the speed)
/// is tied to x and no axis of its own.
/// @param planned keys that the plan names as axes: then no others are, and none is tied;
///        empty: found as above
void choose_axes(Sweep& sweep, const std::vector<std::string>& planned);

}  // namespace ice::sweep
