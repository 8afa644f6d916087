// SPDX-License-Identifier: GPL-3.0-or-later
// Effective masses of contacts, (5) and k_t: the definition, one contact at a time.
// responses_simd.cpp computes the same bits for as many pairs as the machine has lanes.
#include <Eigen/Geometry>
#include <cmath>

#include "common/math/ordered_products.hpp"
#include "solver/contact/responses.hpp"

namespace ice::reference {

namespace {

Mat3 get(const std::array<LaneValues, 9>& from, std::size_t lane) {
    Mat3 out;
    for (int k = 0; k < 9; ++k) out(k / 3, k % 3) = from[static_cast<std::size_t>(k)].v[lane];
    return out;
}

// Largest k(t) over unit tangents t. Stepping with it, friction converges to exactly opposite the
// sliding direction.
double largest_tangent_response(const Mat3& k, const Vec3& n) {
    // any tangent will do; the axis least along n is never parallel to it
    int axis = 0;
    n.cwiseAbs().minCoeff(&axis);
    const Vec3 across = n.cross(Vec3::Unit(axis));
    const Vec3 s = across / std::sqrt(ordered_dot(across, across)), t = n.cross(s);
    const double ss = ordered_dot(s, ordered_product(k, s));
    // The larger eigenvalue of K in the tangent plane: mean of the diagonal plus the radius of
    // Mohr's circle.
    const double tt = ordered_dot(t, ordered_product(k, t));
    const double st = ordered_dot(s, ordered_product(k, t));
    return 0.5 * (ss + tt) + std::sqrt(0.25 * (ss - tt) * (ss - tt) + st * st);
}

// The sum of both bodies' excess.
Mat3 get(const PairExcess& from, std::size_t lane) {
    constexpr std::size_t kEntry[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
    Mat3 out;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            out(i, k) = from.a[kEntry[i][k]].v[lane] + from.b[kEntry[i][k]].v[lane];
    return out;
}

// @param excess  null for bodies without added mass
void measure(double inverse_mass, const Mat3& inverse_inertia_a, const Mat3& inverse_inertia_b,
             const Mat3* excess, std::size_t lane, ContactRow& row) {
    const Vec3 n = get(row.normal, lane);
    // K n by (5): the change of v_r by a unit normal impulse
    const Vec3 arm_a = get(row.arm_a, lane), arm_b = get(row.arm_b, lane);
    const Vec3 turn_a = ordered_product(inverse_inertia_a, arm_a.cross(n));
    const Vec3 turn_b = ordered_product(inverse_inertia_b, arm_b.cross(n));
    Vec3 response = inverse_mass * n + turn_a.cross(arm_a) + turn_b.cross(arm_b);
    if (excess != nullptr) response += ordered_product(*excess, n);
    for (std::size_t d = 0; d < 3; ++d)
        row.response[d].v[lane] = response[static_cast<Eigen::Index>(d)];
    // k(n) = n . K n and k_t, and their inverses
    Mat3 k = response_matrix(inverse_mass, inverse_inertia_a, arm_a, inverse_inertia_b, arm_b);
    if (excess != nullptr) k += *excess;
    row.effective_mass.v[lane] = 1.0 / ordered_dot(n, ordered_product(k, n));
    row.tangent_effective_mass.v[lane] = 1.0 / largest_tangent_response(k, n);
    row.inverse_effective_mass.v[lane] = 1.0 / row.effective_mass.v[lane];
    row.tangent_inverse_effective_mass.v[lane] = 1.0 / row.tangent_effective_mass.v[lane];
}

}  // namespace

void measure_responses(const PairBlock& block, const BlockInverseInertias& inverse_inertias,
                       std::span<ContactRow> rows, const PairExcess* excess) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const Mat3 inverse_inertia_a = get(inverse_inertias.a, lane),
                   inverse_inertia_b = get(inverse_inertias.b, lane);
        const double inverse_mass = block.inverse_mass_a.v[lane] + block.inverse_mass_b.v[lane];
        const Mat3 of_water = excess != nullptr ? get(*excess, lane) : Mat3(Mat3::Zero());
        // A lane without a contact in this row has no normal: zeros, with which a sweep changes
        // nothing.
        for (ContactRow& row : rows) {
            if (get(row.normal, lane) != Vec3::Zero()) {
                measure(inverse_mass, inverse_inertia_a, inverse_inertia_b,
                        excess != nullptr ? &of_water : nullptr, lane, row);
                continue;
            }
            for (LaneValues& part : row.response) part.v[lane] = 0.0;
            for (LaneValues* value :
                 {&row.inverse_effective_mass, &row.tangent_inverse_effective_mass,
                  &row.effective_mass, &row.tangent_effective_mass})
                value->v[lane] = 0.0;
        }
    }
}

}  // namespace ice::reference
