// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "preprocess/fill/offset_surface.hpp"

namespace ice {

/// How the layer is made.
struct LayerOptions {
    double radius = 0.1;     ///< [m]
    double spacing = 0.1;    ///< wanted distance of neighbours [m]
    int dimension = 3;       ///< 3, or 2: along the section's outline
    bool mirror = false;     ///< the solid is symmetric about y = 0: make the layer so, bit for bit
    double line_step = 0.2;  ///< between the points that edges are followed by [spacings]
    double sharp = 0.94;     ///< cosine of the turn between faces that meet in an edge: 20 degrees
    bool by_ends = false;  ///< follow edges by their ends alone, where these settle: straight ones
    std::function<void(double)> progress =
        {};  ///< where given, called with the share done now and then
};

/// Centres of spheres that touch the surface from inside, spaced evenly: the conforming layer.
///
/// 1. Lines: sharp edges first (in 2D the outline); their spheres touch both faces and are spaced
///    evenly between the corners, at most `spacing` apart.
/// 2. Fronts: round every sphere the free places of a hexagon are filled, settled on the offset
///    surface and kept if no neighbour is nearer than 0.74 spacing; parts that no edge leads to
///    start their own.
/// 3. Gaps: a sphere is placed in every corner of the spheres' Voronoi cells that is farther than
///    0.635 spacing from all of them, and wherever a surface sample that a sphere can touch still
///    has none.
///
/// Space is cut into tiles of eight colours; tiles of one colour are filled at the same time. The
/// result depends on the mesh and options alone, not on the number of threads. Parts too thin for a
/// sphere stay empty. With `mirror`, a sphere is followed by its image.
std::vector<Vec3> make_layer(const SurfaceTree& tree, const LayerOptions& options);

}  // namespace ice
