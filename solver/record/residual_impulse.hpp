// SPDX-License-Identifier: GPL-3.0-or-later
/// Impulses that an unconverged step lacks at its contacts.
#pragma once

#include <vector>

#include "solver/contact/constraints.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Sum over all contacts of the impulse that would mend each alone [N s]: with the velocities at
/// the end of the step, k(n) of constraints.hpp and
///
///     u = v_r . n + max(gap, 0) / dt,
///
/// -u / k(n) where the contact still closes, u < 0, and is not at its bound; u / k(n), at most
/// the impulse it has, where a resting impulse pushes it apart, u > 0, and no impact did.
/// 0 when all conditions of the rest stage hold. Contacts that nothing can move are left out.
///
/// (docs/method.md, section 4, on the stopping test.)
///
/// Each contact is mended alone, so contacts of one floe count its mass several times: the sum is
/// an upper estimate of the force that the step lacks; the next step brings most of it.
/// @param dt  time step [s]
double residual_impulse(const Bodies& bodies, const std::vector<Constraint>& constraints,
                        double dt);

}  // namespace ice
