// SPDX-License-Identifier: GPL-3.0-or-later
/// The water of a case: at rest, or with a current and the flow around the hull.
#pragma once

#include <vector>

#include "common/formats/warning.hpp"
#include "solver/case/case.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Reads the case's flow, or makes it. A flow made for a case ("double-body") is kept beside the
/// hull's sphere set as "<stem>.<hash of mesh, draught and spacing>.flow.h5", and read from there
/// the next time; where that folder cannot be written, a message says so and the run continues.
/// Runs that need it at once wait for the one that makes it. Nodes are half the thinnest floe's
/// height apart or more. A ship that never moves through the water has no flow made.
/// @param scene  hull and floes as they begin
/// @throws Error (exit code 2) for a file that does not fit the hull
WaterFlow make_water(const Case& parameters, const Scene& scene);

/// Warns of speeds at which the water's surface does not stay flat (a Froude number above 0.2), and
/// of a flow that passes through the hull.
std::vector<Warning> check_water(const Case& parameters, const Scene& scene);

}  // namespace ice
