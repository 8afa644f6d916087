// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace ice {

/// Rounding of a time that is a sum of steps [s]. Where means begin at a time, a step that ends
/// within it before that time counts: with 0, one that ends there may be left out; with a step's
/// length or more, the step before counts, too.
constexpr double kTimeRounding = 1e-9;

}  // namespace ice
