// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/contact/contact_rows.hpp"

namespace ice {

/// State before a sweep and the direction of the conjugate gradients, beside rows and motions.
struct SweepMemory {
    std::vector<RowImpulses> before, direction;               ///< by row [N s]
    std::vector<BodyMotion> motion_before, motion_direction;  ///< by local body [m/s], [rad/s]
};

/// |g|^2 = sum of k(n) (dJ_n^2 + dJ_t^2) for the changes since `memory` [J]: k J^2 is twice the
/// kinetic energy that an impulse J gives the contact's effective mass 1 / k. Summed by lanes, then
/// over the lanes.
double measure_change(const std::vector<ContactRow>& rows, const SweepMemory& memory);

/// With g the change since `before` and d the direction: values += beta d, d = beta d + g,
/// before = values; for impulses and velocities (equation (11)). With beta = 0 values stay as they
/// are, and the direction begins anew with g. @param beta  [-], 0 to 1
void move_on(std::vector<ContactRow>& rows, std::vector<BodyMotion>& motion, double beta,
             SweepMemory& memory);

namespace reference {
// The definitions, one number at a time: read these first. Same bits on every instruction set.
double measure_change(const std::vector<ContactRow>& rows, const SweepMemory& memory);
void move_on(std::vector<ContactRow>& rows, std::vector<BodyMotion>& motion, double beta,
             SweepMemory& memory);
}  // namespace reference

}  // namespace ice
