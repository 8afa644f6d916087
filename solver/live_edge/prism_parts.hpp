// SPDX-License-Identifier: GPL-3.0-or-later
/// Convex parts of a floe whose outline is hollow.
#pragma once

#include <vector>

#include "common/geometry/loop_area.hpp"
#include "solver/shape/solid_part.hpp"

namespace ice {

/// The parts of an upright prism from z = -thickness / 2 to +thickness / 2, cut along diagonals of
/// its outline; one part where it is convex.
///
/// Two prisms overlap where two of their parts do, and their contacts are those of all pairs of
/// parts. A vertical edge at the end of a cut has the normals of the whole solid's faces.
/// @param outline  anticlockwise, no three corners in a row on one line [m]
/// @return nothing where the outline is not simple, or a part has too many planes
std::vector<SolidPart> prism_parts(const Loop& outline, double thickness);

}  // namespace ice
