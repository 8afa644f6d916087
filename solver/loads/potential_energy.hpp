// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/case/case.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Potential energy of all floes, held ones too, in weight and water [J], 2D [J/m]:
///
///     U = sum m g z - rho_w g V (z + z_B),
///
/// V the submerged volume and z_B the height of its centre above the floe's origin: pushing a piece
/// of volume under to a depth d lifts as much water by d. -dU/dz is weight plus buoyancy, and the
/// derivative by rotation the moment of "distributed" buoyancy. Without buoyancy only m g z.
double potential_energy(const Scene& scene, const Case& parameters);

}  // namespace ice
