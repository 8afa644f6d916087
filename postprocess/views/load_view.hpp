// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "postprocess/views/projection.hpp"

namespace ice::views {

/// A scalar on the hull's triangles.
struct HullLoad {
    const TriangleMesh& hull;         ///< as it is, ship frame: drawn bare below the colours
    const TriangleMesh& mesh;         ///< the hull in small triangles
    const std::vector<double>& load;  ///< [T] per triangle of `mesh` [Pa]
    double scale_end = 0.0;           ///< load of the darkest colour [Pa]; 0: none is drawn
    double waterline = 0.0;           ///< height of the water in the ship frame [m]
};

/// The hull from one side with its loaded triangles coloured, as one SVG element with axes in the
/// ship frame, in cells of 3 px. Colours have 20 steps and are linear in the load.
/// @param width of the picture [px]; its height follows, at most about 0.55 of it and the margins
std::string draw_load_view(const HullLoad& hull, ViewFrom from, double width);

/// The colours with their loads.
/// @param half, end loads as text: half of the scale's end, and the end; @param what is coloured
std::string draw_load_legend(const std::string& half, const std::string& end,
                             const std::string& unit, const std::string& what);

}  // namespace ice::views
