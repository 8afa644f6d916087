// SPDX-License-Identifier: GPL-3.0-or-later
/// What each sphere stands for: its share of the surface, of the volume, its normals and region.
#pragma once

#include <vector>

#include "common/formats/sphere_set.hpp"
#include "preprocess/fill/surface_samples.hpp"
#include "preprocess/measure/surface_tree.hpp"

namespace ice {

/// Gives every surface sample to the surface sphere nearest to where a touching sphere would sit
/// (point - R normal), and sums up areas, regions (the one with the largest area) and normals.
///
/// A touching sphere's normal is the mean of the directions in which it touches, its spread the
/// largest angle to one of them; a sphere that touches nothing (lattice) takes the direction of its
/// foot. Areas are scaled so that they sum to the solid's.
/// @pre set.centers, radii, layers, solid are set
void share_surface(const SurfaceTree& tree, const std::vector<SurfaceSample>& samples,
                   SphereSet& set);

/// Shares the volume: each sphere takes the lattice points of the solid nearest to it, then all
/// shares are multiplied by 1 + a + b . (x - mean), with the four numbers that make them sum to the
/// volume and their first moments to the centroid. Where the centres lie in a plane or on a line
/// that misses the centroid no shares can do that: the rest is returned.
/// @param equal  start from equal shares instead (the lattice: every sphere stands for its cell)
/// @return distance of the shares' centroid from the solid's [m]: rounding, unless the spheres lie
///         all to one side of it (too few of them)
double share_volume(const SurfaceTree& tree, bool equal, SphereSet& set);

}  // namespace ice
