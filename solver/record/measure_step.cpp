// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/measure_step.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>

#include "common/base/assert.hpp"

namespace ice {

namespace {

// A ship contact that still closes faster than this [m/s] after the solver is jammed: 1 cm/s is far
// above any tolerance in use and far below a ship's speed. Smaller counts solutions that ran out of
// iterations, larger misses slow jams.
constexpr double kJamSpeed = 0.01;

// Contacts of one floe and region become one entry.
void merge_regions(std::vector<RegionImpulse>& regions) {
    const auto key = [](const RegionImpulse& r) { return std::tuple(r.floe, r.region); };
    std::stable_sort(regions.begin(), regions.end(),
                     [&](const auto& l, const auto& r) { return key(l) < key(r); });
    std::size_t kept = 0;
    for (const RegionImpulse& r : regions) {
        if (kept > 0 && key(regions[kept - 1]) == key(r)) {
            regions[kept - 1].impulse += r.impulse;
            regions[kept - 1].friction += r.friction;
        } else {
            regions[kept++] = r;
        }
    }
    regions.resize(kept);
}

void find_jam(const Scene& scene, const Constraint& c, double dt, StepRecord& out) {
    // v_r . n + gap / dt of (6) in the rest stage: below zero the contact still closes
    const double closing =
        relative_velocity(scene.bodies, c).dot(c.normal) + std::max(c.gap, 0.0) / dt;
    // a floe that no impulse reached is no jam, unless it cannot move at all
    const bool pressed = c.total_normal() > 0.0 || !c.can_move;
    if (!pressed || c.is_at_bound() || closing > -kJamSpeed) return;
    if (out.jammed_contacts++ > 0) return;
    out.jammed_floe = c.b;
    out.jam_point = scene.bodies.position[c.b] + c.arm_b;
}

}  // namespace

StepRecord measure_step(const Scene& scene, const std::vector<Contact>& contacts,
                        const std::vector<Constraint>& constraints, double dt) {
    ICE_ASSERT(contacts.size() == constraints.size() && dt > 0.0);
    StepRecord out;
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const Constraint& c = constraints[k];
        const double normal = c.total_normal();
        // overlap before the step's motion; the closing speed before the impacts
        out.max_overlap = std::max(out.max_overlap, -c.gap);
        if (-c.approach > out.closing_speed) {
            out.closing_speed = -c.approach;
            out.closing_a = c.a;
            out.closing_b = c.b;
        }
        const bool ship = c.a == static_cast<std::int32_t>(kShip);
        if (ship) find_jam(scene, c, dt, out);
        if (normal <= 0.0) continue;
        ++out.contacts;
        out.impulse += normal;
        if (!ship) continue;
        // impulses act on the floe; the ship feels the opposite
        const Vec3 push = -normal * c.normal, rub = -c.total_tangent();
        out.contact_force += push / dt;
        out.friction_force += rub / dt;
        if (c.on_unbent) out.breaking_x += (push + rub).x() / dt;
        // arms begin in the centre of gravity, the moment is about the mesh's origin
        out.moment += (c.arm_a + scene.bodies.ship.centre).cross(Vec3(push + rub)) / dt;
        out.regions.push_back({c.b, contacts[k].region, push + rub, rub});
    }
    merge_regions(out.regions);
    out.moving_floes = static_cast<std::int32_t>(scene.bodies.moving.size());
    out.kinetic_energy = kinetic_energy(scene.bodies);
    return out;
}

void measure_floe_forces(const std::vector<Constraint>& constraints, double dt,
                         std::span<const std::int32_t> entry_of, std::span<FloeForces> out) {
    std::fill(out.begin(), out.end(), FloeForces{});
    if (out.empty()) return;
    for (const Constraint& c : constraints) {
        const std::int32_t a = entry_of[c.a], b = entry_of[c.b];
        if (a < 0 && b < 0) continue;
        // forces on the floe: contact and friction by the ship, `ice` by its neighbours
        const Vec3 push = c.total_normal() / dt * c.normal, rub = c.total_tangent() / dt;
        if (c.a == static_cast<std::int32_t>(kShip)) {
            out[b].contact -= push;
            out[b].friction -= rub;
        } else {
            if (b >= 0) out[b].ice += push + rub;
            if (a >= 0) out[a].ice -= push + rub;
        }
    }
}

}  // namespace ice
