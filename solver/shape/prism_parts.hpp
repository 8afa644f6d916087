// SPDX-License-Identifier: GPL-3.0-or-later
/// Convex parts of a floe whose outline is hollow: solids that meet like one.
#pragma once

#include <vector>

#include "common/geometry/loop_area.hpp"
#include "solver/shape/solid.hpp"

namespace ice {

/// One convex part of a solid that is not convex.
///
/// Its planes and edges are those of the whole solid's surface. Nothing touches the cuts between
/// two parts: they only show that a body is beyond them, and bound the upper and lower faces.
struct SolidPart {
    ConvexPiece solid;
    std::vector<SidePlane> cuts;  ///< planes between it and other parts, outward
    Vec3 middle = Vec3::Zero();   ///< of a sphere around the part, body axes [m]
    double radius = 0.0;          ///< of that sphere [m]
};

/// The parts of an upright prism from z = -thickness / 2 to +thickness / 2, cut along diagonals of
/// its outline; one part where it is convex.
///
/// Two prisms overlap where two of their parts do, and their contacts are those of all pairs of
/// parts. A vertical edge at the end of a cut has the normals of the whole solid's faces.
/// @param outline  anticlockwise [m]
/// @return nothing where the outline is not simple, or a part has too many planes
std::vector<SolidPart> prism_parts(const Loop& outline, double thickness);

}  // namespace ice
