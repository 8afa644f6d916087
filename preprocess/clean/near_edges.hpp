// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A point that lies beside a segment.
struct NearEdge {
    std::size_t point = 0, edge = 0;  ///< rows of the arguments
    double along = 0.0;     ///< of its foot, from the segment's start (0) to its end (1) [-]
    double distance = 0.0;  ///< [m]
};

/// All points within reach of segments whose foot lies between the segment's ends (CGAL's box
/// intersection finds the candidates). By point, then by distance.
/// @param points  N [m]   @param edges  E pairs of points [m]   @param reach  E, of each edge [m]
std::vector<NearEdge> find_near_edges(const std::vector<Vec3>& points,
                                      const std::vector<std::pair<Vec3, Vec3>>& edges,
                                      const std::vector<double>& reach);

}  // namespace ice
