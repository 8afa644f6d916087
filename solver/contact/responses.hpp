// SPDX-License-Identifier: GPL-3.0-or-later
/// Effective masses of contacts: docs/method.md, section 4.
#pragma once

#include <array>
#include <span>

#include "solver/contact/contact_rows.hpp"

namespace ice {

/// Inverse inertias of a block's bodies in world axes, all nine entries row by row [1/(kg m2)].
/// Rounding leaves them not quite symmetric; a sweep uses the upper half.
struct BlockInverseInertias {
    std::array<LaneValues, 9> a{}, b{};
};

/// Measures the responses of a block's contacts to impulses, from normal, arm_a and arm_b: sets
/// response, the effective masses and their inverses. With K of response_matrix
///
///     k(n) = n . K n,   largest k(t) = greater eigenvalue of K in the tangent plane
///
/// (equations (5) and (10)). With the smaller eigenvalue friction steps would be too long along the
/// other direction.
///
/// @param rows    of the block; where a lane has no contact (normal zero) all becomes zero
/// @param excess  of the block's bodies, added to K; null where they have no added mass
void measure_responses(const PairBlock& block, const BlockInverseInertias& inverse_inertias,
                       std::span<ContactRow> rows, const PairExcess* excess = nullptr);

namespace reference {
// The definition, one contact at a time: read this first. Same bits on every instruction set.
void measure_responses(const PairBlock& block, const BlockInverseInertias& inverse_inertias,
                       std::span<ContactRow> rows, const PairExcess* excess = nullptr);
}  // namespace reference

}  // namespace ice
