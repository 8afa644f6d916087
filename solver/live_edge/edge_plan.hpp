// SPDX-License-Identifier: GPL-3.0-or-later
/// The inside of LiveEdge: the bodies of one renewal. Used by sources of this folder only.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "solver/live_edge/carried_notches.hpp"
#include "solver/live_edge/live_edge.hpp"
#include "solver/shape/shape.hpp"

namespace ice {

// In the sense of IceSheet, in thicknesses [-]: a piece has at least the area of a square of half a
// thickness. Larger makes more brash, smaller makes pieces that hold few spheres.
constexpr double kSmallestPiece = 0.5;

// Ice is filled if something is left of its outline this far inwards, in thicknesses [-]: a radius
// of its spheres, and a little more, so that a sphere does not just touch. Larger makes more brash.
constexpr double kLeastHalfBreadth = 0.26;

// Least distance of an outline's corners [m]: nearer ones would each get a sphere in a corner.
// Larger moves outlines by up to as much.
constexpr double kNearest = 1e-3;

// Breaking load of ice that never bends [N]; time [s] at which a piece in the scene leaves it.
constexpr double kNever = std::numeric_limits<double>::infinity();

struct LiveEdge::Plan {
    struct Body {
        Loop outline;
        bool is_tile;
        double load, radius;         // of the crack [N] (2D: N/m), [m]
        double area;                 // of the part of the sheet that it represents [m2]
        std::optional<Shape> shape;  // none: no spheres fit
    };
    std::vector<Body> bodies;
    std::vector<std::int32_t> changed;
    CarriedNotches notches;  // of the tiles that go
};

}  // namespace ice
