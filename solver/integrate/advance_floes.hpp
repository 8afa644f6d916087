// SPDX-License-Identifier: GPL-3.0-or-later
/// Momenta and poses at the end of a step: docs/method.md, sections 2 and 7.
#pragma once

#include <span>
#include <vector>

#include "solver/contact/overlaps.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Further inputs of the motion in a step, beside the velocities at its end.
struct Advance {
    const std::vector<Vec3>& angular_velocity_start;  ///< by body [rad/s]
    const PositionCorrections& corrections;           ///< by body [m], [rad]
    double dt;                                        ///< [s]
};

/// Takes the velocity changes of a step into the momenta and moves floes with these, then by the
/// corrections:
///
///     P = m v,   L += I (w - w_start),   x += dt v + shift,   q by advance_orientation, then turn,
///
/// (equations (1) and (18)) with added mass P = (m + R A R^T) v, R of the start (P2),
///
/// and updates what update_derived() derives. If w has not changed, L keeps its bits, so that
/// torque-free motion conserves it.
/// @param floes  numbers of floes that are not held, ascending; none changes nothing
/// @pre update_derived() was called with the present poses
void advance_floes(Bodies& bodies, std::span<const std::int32_t> floes, const Advance& step);

namespace reference {
// The definition, one floe at a time: read this first. Same bits on every instruction set.
void advance_floes(Bodies& bodies, std::span<const std::int32_t> floes, const Advance& step);
}  // namespace reference

}  // namespace ice
