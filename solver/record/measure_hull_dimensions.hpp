// SPDX-License-Identifier: GPL-3.0-or-later
/// The ship's dimensions and angles at calm water, which empirical formulas need.
#pragma once

#include <optional>

#include "common/formulas/level_ice.hpp"
#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Measures L, B, T, L_par, L_bow [m], phi and alpha [rad].
///
/// The waterline is the mesh's section at `waterline` [m] (ship frame). phi: slope of the foremost
/// points of the sections there and 0.1 T deeper. alpha: from the stem to where the waterline
/// reaches a quarter of the breadth. L_par: the part of the waterline that is at least 0.99 B
/// broad; L_bow: the length ahead of it.
/// @return nothing when the hull does not cross the water
std::optional<HullDimensions> measure_hull_dimensions(const TriangleMesh& hull, double waterline);

}  // namespace ice
