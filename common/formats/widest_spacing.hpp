// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace ice {

/// Surface spheres farther apart than this, in radii, leave holes that other bodies' corners pass:
/// along an edge the solver takes a sphere for two radii either way, a corner's for one.
constexpr double kWidestSpacing = 3.0;
/// Spacings that differ by this share [-] are equal: rounding of a product of radius and factor.
constexpr double kSpacingRounding = 1e-9;

}  // namespace ice
