// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/geometry/surface_tree.hpp"

namespace ice {

/// Sharp edges of a closed mesh as polylines of start points inside the solid: along each edge, a
/// point every `step` [m], moved inwards by about `radius`. Edges that continue each other are one
/// polyline. Edges are convex ones whose faces turn by more than the angle whose cosine is `sharp`;
/// a polyline ends where it turns by more than that.
std::vector<std::vector<Vec3>> trace_sharp_edges(const SurfaceTree& tree, double radius,
                                                 double step, double sharp);

/// In 2D: the outline of the prism's section as closed polylines of start points, moved inwards.
std::vector<std::vector<Vec3>> trace_section(const SurfaceTree& tree, double radius, double step);

/// Evenly spaced points on a polyline of settled centres [m], at most `spacing` [m] apart, ends
/// included. Corners (turns of more than 20 degrees) are kept and split the polyline.
std::vector<Vec3> resample(const std::vector<Vec3>& polyline, double spacing);

}  // namespace ice
