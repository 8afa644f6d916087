// SPDX-License-Identifier: GPL-3.0-or-later
/// The flow around a hull on a grid.
#pragma once

#include "common/formats/flow_file.hpp"
#include "solver/flow/panel_sums.hpp"

namespace ice {

struct FlowOptions {
    double water = 0.0;    ///< z of the water in the mesh's frame [m]
    double panel = 0.0;    ///< longest edge [m]; 0: chosen, see make_wetted_hull()
    double spacing = 0.0;  ///< of the table's nodes [m]; 0: for some 300 000 nodes, or 10 000 in 2D
    double finest = 0.0;   ///< a chosen spacing is no smaller [m]
    bool table = true;     ///< else the panels alone are solved
};

/// A table, and the warnings of its making.
struct HullFlow {
    FlowTable table;
    double panel = 0.0;               ///< longest edge of the panels [m]
    double length = 0.0;              ///< of the wetted hull [m]
    double worst = 0.0;               ///< largest normal velocity left on the hull, ship speeds [-]
    Vec3 worst_place = Vec3::Zero();  ///< where [m]
    double net_flux = 0.0;            ///< share of the sources that does not vanish in sinks [-]
    double solve_seconds = 0.0, table_seconds = 0.0;  ///< wall time of each [s]
};

/// The flow around a hull, 3D or 2D, from its sources to a table.
///
/// The table reaches a breadth around the hull (2D: two draughts); in the outer third of that the
/// flow fades smoothly to 0. Nodes in the hull have the flow at a point outside: a tenth of a
/// spacing from the surface's nearest point. Speeds above 1.2 in the earth frame, which sharp edges
/// make, are lowered to that. The bits are the same for any number of threads and any instruction
/// set. options.panel wins over the bound on panels: too many are refused, never made coarser.
/// @param dimension  3, or 2 for a section
/// @throws Error (exit code 2) where the hull is not in the water, or the options give more than
///         8000 panels or 2e7 nodes; (1) where the flow has no solution
HullFlow make_hull_flow(const TriangleMesh& hull, int dimension, const FlowOptions& options);

/// Warnings about a flow: a residual above 5 %, sources that do not add up to 0. Empty for a flow
/// without faults.
std::vector<std::string> warnings_of(const HullFlow& flow);

}  // namespace ice
