// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of the solid that each sphere represents: normals, shares of surface and volume,
/// region.
#pragma once

#include <vector>

#include "common/formats/sphere_set.hpp"
#include "common/geometry/surface_tree.hpp"
#include "preprocess/fill/survey.hpp"

namespace ice {

/// Sets normals, spreads and creases of the surface spheres.
///
/// A sphere that touches in one direction has that as its normal. One in an edge or corner touches
/// in several: all are listed in `creases`, its normal is the axis of the narrowest cone round them
/// and its spread that cone's half angle. One that touches nothing (lattice) takes the direction of
/// its foot.
/// @param twins  of find_twins, empty when the set is not symmetric: images get mirrored normals
void set_normals(const SurfaceTree& tree, const std::vector<std::int32_t>& twins, SphereSet& set);

/// Sums the areas that the samples give to their owners, scaled to the solid's area, and takes for
/// each sphere the region with the largest part of its area.
/// @param twins  as above: twins share equally; `sights` are then of y >= 0 only
void share_surface(const SurfaceTree& tree, const std::vector<Sight>& sights,
                   const std::vector<std::int32_t>& twins, SphereSet& set);

/// Shares the volume: an interior sphere represents its lattice cell, a surface sphere its part
/// of the rest, by area. Then the surface shares (those of a lattice: all) are multiplied by
/// 1 + a + b . (x - mean), with the four numbers that make all shares sum to the volume and their
/// first moments to the centroid. Where the centres lie in a plane or on a line that misses the
/// centroid no shares can do that: the rest is returned.
///
/// @param cell  volume of an interior sphere's cell [m3]; 0: equal shares for all (a lattice)
/// @param mirror  the set is its own mirror image: equal shares for twins, bit for bit
/// @return distance of the shares' centroid from the solid's [m]: rounding, unless the spheres lie
///         all to one side of it (too few of them)
double share_volume(double cell, bool mirror, SphereSet& set);

}  // namespace ice
