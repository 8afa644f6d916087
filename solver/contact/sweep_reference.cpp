// SPDX-License-Identifier: GPL-3.0-or-later
// A sweep, (9) and (10): the definition, one contact at a time. sweep_simd.cpp computes the same
// bits for eight pairs side by side.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/math/ordered_products.hpp"
#include "solver/contact/sweep.hpp"

namespace ice::reference {

namespace {

// A body of a pair while its contacts are swept.
struct Side {
    Vec3 velocity, angular_velocity;
    double inverse_mass, inverse_inertia[6];  // xx yy zz xy xz yz
    bool has_added_mass;
    double excess[6] = {};  // likewise

    // @param water  null for bodies without added mass
    Side(const BodyMotion& m, const LaneValues& mass, const std::array<LaneValues, 6>& i,
         const std::array<LaneValues, 6>* water, std::size_t lane)
        : velocity(m.v[0], m.v[1], m.v[2]),
          angular_velocity(m.v[3], m.v[4], m.v[5]),
          inverse_mass(mass.v[lane]),
          has_added_mass(water != nullptr) {
        for (std::size_t k = 0; k < 6; ++k) {
            inverse_inertia[k] = i[k].v[lane];
            if (has_added_mass) excess[k] = (*water)[k].v[lane];
        }
    }
    Vec3 at(const Vec3& arm) const { return velocity + angular_velocity.cross(arm); }
    // v := v + (1/m + excess) j, w := w + I^-1 (r x j), with the world's inverse inertia
    void push(const Vec3& arm, const Vec3& j) {
        velocity = velocity + inverse_mass * j;
        if (has_added_mass) velocity = velocity + product(excess, j);
        angular_velocity = angular_velocity + product(inverse_inertia, arm.cross(j));
    }
    static Vec3 product(const double* i, const Vec3& m) {
        return {(i[0] * m.x() + i[3] * m.y()) + i[4] * m.z(),
                (i[3] * m.x() + i[1] * m.y()) + i[5] * m.z(),
                (i[4] * m.x() + i[5] * m.y()) + i[2] * m.z()};
    }
    void store(BodyMotion& m) const {
        m.v[0] = velocity.x();
        m.v[1] = velocity.y();
        m.v[2] = velocity.z();
        m.v[3] = angular_velocity.x();
        m.v[4] = angular_velocity.y();
        m.v[5] = angular_velocity.z();
    }
};

// Largest changes of velocity so far; the tangential one squared.
struct Changes {
    double normal = 0.0, tangent_sq = 0.0;
};

void solve(ContactRow& row, std::size_t lane, Side& a, Side& b, Changes& most) {
    const Vec3 n = get(row.normal, lane);
    const Vec3 arm_a = get(row.arm_a, lane), arm_b = get(row.arm_b, lane);
    const Vec3 v = b.at(arm_b) - a.at(arm_a);
    double& normal = row.impulse.normal.v[lane];
    // Equation (9): the normal impulse that brings v . n to the target, clamped to [0,
    // max_impulse].
    const double reached =
        normal + (row.target_velocity.v[lane] - ordered_dot(n, v)) * row.effective_mass.v[lane];
    const double next = std::min(std::max(reached, 0.0), row.max_impulse.v[lane]);
    const double change = next - normal;
    normal = next;

    // Equations (7) and (10): the sliding velocity already includes the normal impulse just
    // applied; friction is a projection on the disc of radius mu J_n.
    const Vec3 after = v + change * get(row.response, lane);
    const Vec3 sliding = after - ordered_dot(n, after) * n;
    const Vec3 before = get(row.impulse.tangent, lane);
    Vec3 tangent = before - row.tangent_effective_mass.v[lane] * sliding;
    const double size_sq = ordered_dot(tangent, tangent), limit = row.friction.v[lane] * next;
    if (size_sq > limit * limit) tangent = (limit / std::sqrt(size_sq)) * tangent;
    const Vec3 turned = tangent - before;
    row.impulse.tangent[0].v[lane] = tangent.x();
    row.impulse.tangent[1].v[lane] = tangent.y();
    row.impulse.tangent[2].v[lane] = tangent.z();

    // both bodies get the change of the contact's impulse, at their own arms
    const Vec3 j = change * n + turned;
    a.push(arm_a, -1.0 * j);
    b.push(arm_b, j);
    // Changes are compared as velocities, so that contact.tolerance means the same for light and
    // heavy floes.
    const double k = row.tangent_inverse_effective_mass.v[lane];
    most.normal = std::max(most.normal, std::abs(change) * row.inverse_effective_mass.v[lane]);
    most.tangent_sq = std::max(most.tangent_sq, ordered_dot(turned, turned) * (k * k));
}

}  // namespace

double sweep(const std::vector<PairBlock>& blocks, std::vector<ContactRow>& rows,
             std::vector<BodyMotion>& motion, const std::vector<PairExcess>& excess) {
    Changes most;
    for (std::size_t n = 0; n < blocks.size(); ++n) {
        const PairBlock& block = blocks[n];
        const PairExcess* water = excess.empty() ? nullptr : &excess[n];
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            if (block.a[lane] < 0) continue;
            BodyMotion &ma = motion[static_cast<std::size_t>(block.a[lane])],
                       &mb = motion[static_cast<std::size_t>(block.b[lane])];
            Side a(ma, block.inverse_mass_a, block.inverse_inertia_a,
                   water != nullptr ? &water->a : nullptr, lane);
            Side b(mb, block.inverse_mass_b, block.inverse_inertia_b,
                   water != nullptr ? &water->b : nullptr, lane);
            for (std::int32_t r = 0; r < block.rows; ++r)
                solve(rows[static_cast<std::size_t>(block.first_row + r)], lane, a, b, most);
            // The ship and held floes are in many lanes at once: they are never stored, so no lane
            // waits for another.
            if (a.inverse_mass > 0.0) a.store(ma);
            if (b.inverse_mass > 0.0) b.store(mb);
        }
    }
    return std::max(most.normal, std::sqrt(most.tangent_sq));
}

}  // namespace ice::reference
