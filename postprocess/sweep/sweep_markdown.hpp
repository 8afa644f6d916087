// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "postprocess/sweep/sweep_points.hpp"

namespace ice::sweep {

/// Two tables in Markdown, a row per point each: resistance with interval, normal forces on the
/// parts of the hull and friction, which add up to it, and Lindqvist's formula; and the uses of the
/// ship's work; runs in 3D and in 2D have tables of their own. Columns without a known value, or
/// with zeros only, are left out. "" without points.
std::string sweep_markdown(const Sweep& sweep);

}  // namespace ice::sweep
