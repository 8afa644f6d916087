// SPDX-License-Identifier: GPL-3.0-or-later
/// Where level ice will crack as a ship goes through it: the pieces that break off its edge, before
/// a run.
#pragma once

#include <functional>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"
#include "solver/level_ice/ice_sheet.hpp"

namespace ice {

/// A hull's outline at the height z of its own axes: the convex hull of the section, anticlockwise.
/// Empty where the height misses the mesh.
Loop section_outline(const TriangleMesh& mesh, double z);

/// The passage of a ship through a sheet.
struct Passage {
    Loop outline;     ///< convex, of the hull at the ice, at its first place [m]
    double distance;  ///< along x [m]
    /// Speed [m/s] when the ship has gone so far [m].
    std::function<double(double)> speed_at;
    double length;  ///< the ice's characteristic length [m]
    CuspLaw law;
};

/// What becomes of a sheet.
struct BrokenSheet {
    std::vector<Loop> pieces;  ///< in the order in which they break off
    IceSheet rest;             ///< what the ship does not reach
    double brash = 0.0;        ///< area of what was too small for pieces [m2]
};

/// Breaks a sheet by geometry alone, as models of ships in level ice do (Wang 2001; Su, Riska, Moan
/// 2010, which were not read): the outline moves along x by small steps; where it has entered the
/// ice, deepest first, a crack runs around the place at cusp_radius() for the speed along the
/// outline's normal. What each break leaves is the edge for the next, so that no piece is left
/// within the outline's way. Pieces, rest and brash have the sheet's area together.
BrokenSheet break_sheet(IceSheet sheet, const Passage& passage);

/// The sheet within `margin` of the box of `pieces`, in tiles of about `tile` along x, one on each
/// side of the box's middle: ice that holds the pieces and never breaks.
std::vector<Loop> tile_rest(IceSheet sheet, const std::vector<Loop>& pieces, double margin,
                            double tile);

}  // namespace ice
