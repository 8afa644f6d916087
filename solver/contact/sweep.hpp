// SPDX-License-Identifier: GPL-3.0-or-later
/// A sweep of projected Gauss-Seidel: docs/method.md, section 4.
#pragma once

#include <vector>

#include "solver/contact/contact_rows.hpp"

namespace ice {

/// Brings every contact in turn to its conditions, the others being as they are.
///
/// Blocks one after the other, the rows of a block one after the other, its eight pairs at once.
/// For a contact with accumulated impulses J_n n + J_t, relative velocity v_r and effective masses
/// 1 / k(n), 1 / k_t:
///
///     J_n'  = clamp(J_n + (target_velocity - v_r . n) / k(n), 0, max_impulse)
///     v_r'  = v_r + (J_n' - J_n) K n
///     J_t'  = J_t - (v_r' - (v_r' . n) n) / k_t, shortened to mu J_n' where longer
///
/// (equations (9) and (10)) and the bodies' velocities change by the change of impulse. No blocks
/// give 0. The order of blocks and rows decides the result of a single sweep, so it is fixed.
/// @param excess  of the blocks' bodies (ContactRows::excess); empty where none has added mass
/// @return largest change of a contact's velocity [m/s]: |dJ_n| k(n) or |dJ_t| k_t
double sweep(const std::vector<PairBlock>& blocks, std::vector<ContactRow>& rows,
             std::vector<BodyMotion>& motion, const std::vector<PairExcess>& excess = {});

namespace reference {
// The definition, one contact at a time: read this first. Same bits on every instruction set.
double sweep(const std::vector<PairBlock>& blocks, std::vector<ContactRow>& rows,
             std::vector<BodyMotion>& motion, const std::vector<PairExcess>& excess = {});
}  // namespace reference

}  // namespace ice
