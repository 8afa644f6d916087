// SPDX-License-Identifier: GPL-3.0-or-later
// Sums of (11) and the step along the search direction: the definition, one number at a time.
// sweep_memory_simd.cpp computes the same bits in lanes.
#include "common/math/ordered_products.hpp"
#include "solver/contact/sweep_memory.hpp"

namespace ice::reference {

double measure_change(const std::vector<ContactRow>& rows, const SweepMemory& memory) {
    double sum[kLanes] = {};
    for (std::size_t r = 0; r < rows.size(); ++r)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const RowImpulses &now = rows[r].impulse, &before = memory.before[r];
            const double normal = now.normal.v[lane] - before.normal.v[lane];
            const Vec3 tangent = get(now.tangent, lane) - get(before.tangent, lane);
            // |g|^2 of (11): each change of impulse weighted with k(n), so that it is an energy
            sum[lane] += (normal * normal + ordered_dot(tangent, tangent)) *
                         rows[r].inverse_effective_mass.v[lane];
        }
    // The order in which a register of eight lanes is summed on every instruction set.
    return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
}

namespace {

void move_on(double& value, double& before, double& direction, double beta) {
    // Equation (11) for one number; impulses and velocities advance by the same rule, so momentum
    // stays balanced.
    const double change = value - before;
    value = value + beta * direction;
    direction = beta * direction + change;
    before = value;
}

}  // namespace

void move_on(std::vector<ContactRow>& rows, std::vector<BodyMotion>& motion, double beta,
             SweepMemory& memory) {
    for (std::size_t r = 0; r < rows.size(); ++r)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            RowImpulses &now = rows[r].impulse, &before = memory.before[r],
                        &direction = memory.direction[r];
            move_on(now.normal.v[lane], before.normal.v[lane], direction.normal.v[lane], beta);
            for (std::size_t d = 0; d < 3; ++d)
                move_on(now.tangent[d].v[lane], before.tangent[d].v[lane],
                        direction.tangent[d].v[lane], beta);
        }
    for (std::size_t k = 0; k < motion.size(); ++k)
        for (std::size_t d = 0; d < 8; ++d)
            move_on(motion[k].v[d], memory.motion_before[k].v[d], memory.motion_direction[k].v[d],
                    beta);
}

}  // namespace ice::reference
