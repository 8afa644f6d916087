// SPDX-License-Identifier: GPL-3.0-or-later
/// A convex part of a solid that is not convex.
#pragma once

#include <vector>

#include "solver/shape/solid.hpp"

namespace ice {

/// One convex part of a solid; all parts together are the solid.
///
/// Its planes and edges are those of the whole solid's surface. Nothing touches the cuts between
/// two parts: they only show that a body is beyond them, and bound the upper and lower faces.
struct SolidPart {
    ConvexPiece solid;
    std::vector<SidePlane> cuts;  ///< planes between it and other parts, outward
    ConvexPiece closed;           ///< the part with its cuts as planes and edges like all others
    Vec3 middle = Vec3::Zero();   ///< of a sphere around the part, body axes [m]
    double radius = 0.0;          ///< of that sphere [m]
};

}  // namespace ice
