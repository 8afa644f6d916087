// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace ice {

/// Surface spheres farther apart than this [radii] leave places that other bodies' corners pass:
/// along an edge the solver takes a sphere for two radii either way, a corner's for one. A larger
/// value passes sets with such places, a smaller one refuses sets that have none.
constexpr double kWidestSpacing = 3.0;
/// Spacings that differ by this share [-] are equal: rounding of a product of radius and factor. A
/// smaller value refuses the widest spacing itself.
constexpr double kSpacingRounding = 1e-9;

}  // namespace ice
