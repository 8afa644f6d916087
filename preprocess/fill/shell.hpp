// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "preprocess/fill/surface_samples.hpp"
#include "preprocess/measure/surface_tree.hpp"

namespace ice {

struct ShellOptions {
    double radius = 0.1;   ///< [m]
    double spacing = 0.1;  ///< wanted distance of neighbours [m]
    int dimension = 3;
    bool mirror = false;  ///< the solid is symmetric about y = 0: make the layer so, bit for bit
};

/// Centres of spheres that touch the surface from inside, spaced evenly: the conforming layer.
///
/// Sharp edges first: their spheres touch both faces and stand evenly between the corners, at most
/// `spacing` apart. Then faces, by an advancing front: from a placed sphere the six places of a
/// hexagon around it are tried, settled on the offset surface and kept if no neighbour is nearer
/// than 0.75 spacing. At last every surface sample that a sphere could touch but that has none
/// within 0.6 spacing gets its own.
///
/// @param samples  of the surface, spaced at most a quarter of `spacing`
/// The result depends on the mesh and options alone; parts too thin for a sphere stay empty.
std::vector<Vec3> make_shell(const SurfaceTree& tree, const std::vector<SurfaceSample>& samples,
                             const ShellOptions& options);

/// True when every vertex has its mirror image across y = 0 and every triangle's image lies on the
/// surface: the solid is symmetric, whatever its triangles.
bool is_mirror_symmetric(const SurfaceTree& tree);

}  // namespace ice
