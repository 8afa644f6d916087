// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/field/outline.hpp"

namespace ice {

/// The part of a rectangle where one site is nearest, by distance squared minus weight [m2].
struct PowerCell {
    Outline corners;  ///< convex; empty where other sites' weights leave nothing
    std::vector<std::int32_t> neighbours;  ///< across the edge from corner k to k + 1: a site, or
                                           ///< -1 at the rectangle's side
};

/// Cells of all sites, in their order (CGAL's regular triangulation). They cover the rectangle.
///
/// Its sides come from images of the sites: points nearer to a site than to its image lie inside.
/// Edges may have no length: sites beside a side and their images lie on one circle.
/// @pre sites lie inside the rectangle, no two in one place; one weight [m2] per site
std::vector<PowerCell> power_cells(const std::vector<Vec2>& sites,
                                   const std::vector<double>& weights, const Rectangle& rectangle);

}  // namespace ice
