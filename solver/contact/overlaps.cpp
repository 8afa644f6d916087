// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/contact/overlaps.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/base/assert.hpp"
#include "common/math/ordered_products.hpp"

namespace ice {

namespace {

// Time in which a shallow overlap would open at its first rate [s]: a fifth of it in a step of
// 0.02 s, as is usual in split-impulse solvers. Shorter opens overlaps sooner and puts in more
// energy (the ledger's separation); longer leaves jams deeper.
constexpr double kOpeningTime = 0.1;

// Most of an overlap that counts, in radii [-]: a deep one opens at half a radius in kOpeningTime,
// which is slow beside a floe and yet opens it within a second. Larger throws bodies apart that a
// fault of the contact search let in; smaller keeps them in each other for longer.
constexpr double kMostOpened = 0.5;

// Most of an overlap that one step opens [-], which steps above 0.02 s reach. All of it would
// overshoot where contacts share a body; less opens slowly at long steps.
constexpr double kMostInStep = 0.2;

// Sweeps over the moves of a step [-]; overlap that they leave opens in the next steps, since a
// step opens a fifth at most. More cost time, fewer leave more to the next steps.
constexpr int kSeparationIterations = 10;

double gap_after(const Bodies& bodies, const Constraint& c, double dt) {
    return c.gap + dt * relative_velocity(bodies, c).dot(c.normal);
}

bool is_of_ship(const Bodies& bodies, const Constraint& c) {
    return c.a == static_cast<std::int32_t>(kShip) && bodies.ship.free;
}

}  // namespace

double smaller_radius(const Scene& scene, const Constraint& c) {
    const auto of = [&](std::int32_t body) {
        return scene.shapes[static_cast<std::size_t>(scene.bodies.shape[body])].largest_radius;
    };
    return std::min(of(c.a), of(c.b));
}

Overlaps::Push Overlaps::push_of(const Bodies& bodies, const Constraint& c, std::size_t row,
                                 double target) {
    const bool ship = is_of_ship(bodies, c);
    const Mat3 &of_a = ship ? bodies.ship.inverse_inertia : bodies.inverse_inertia_world[c.a],
               &of_b = bodies.inverse_inertia_world[c.b];
    const Mat3 response = response_matrix(bodies.inverse_mass[c.a] + bodies.inverse_mass[c.b], of_a,
                                          c.arm_a, of_b, c.arm_b);
    // k(n) of (5), for a move instead of a velocity
    double inverse_effective_mass = ordered_dot(c.normal, ordered_product(response, c.normal));
    Vec3 shift = Vec3::Zero();
    if (ship) {
        shift = ordered_product(bodies.ship.inverse_mass, c.normal);
        inverse_effective_mass += ordered_dot(c.normal, shift);
    }
    return {row,
            target,
            0.0,
            ordered_product(of_a, c.arm_a.cross(c.normal)),
            ordered_product(of_b, c.arm_b.cross(c.normal)),
            1.0 / inverse_effective_mass,
            shift};
}

void Overlaps::correct_positions(const Scene& scene, const std::vector<Constraint>& constraints,
                                 const std::vector<std::size_t>& uncut, double dt,
                                 PositionCorrections& out) {
    const Bodies& bodies = scene.bodies;
    const double share = std::min(dt / kOpeningTime, kMostInStep);
    out.shift.resize(bodies.size(), Vec3::Zero());
    out.turn.resize(bodies.size(), Vec3::Zero());
    // only moving bodies have corrections from the last step to be cleared
    out.shift[kShip].setZero();
    out.turn[kShip].setZero();
    for (const std::int32_t i : bodies.moving) {
        out.shift[i].setZero();
        out.turn[i].setZero();
    }
    // overlaps as the final velocities leave them: what these open by themselves needs no shift
    pushes_.clear();
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const Constraint& c = constraints[k];
        const double radius = smaller_radius(scene, c);
        const double overlap = -gap_after(bodies, c, dt) - kToleratedOverlap * radius;
        // a ship on a prescribed course and held ice keep theirs
        const bool crushed = c.is_at_bound() && !std::binary_search(uncut.begin(), uncut.end(), k);
        if (overlap <= 0.0 || crushed || !c.can_move) continue;
        pushes_.push_back(push_of(bodies, c, k, share * std::min(overlap, kMostOpened * radius)));
    }
    // Gauss-Seidel on the moves: n . (d_b - d_a) >= target with a push that never pulls
    for (int iteration = 0; iteration < kSeparationIterations; ++iteration)
        for (Push& push : pushes_) {
            const Constraint& c = constraints[push.constraint];
            const Vec3 move = out.shift[c.b] + out.turn[c.b].cross(c.arm_b) - out.shift[c.a] -
                              out.turn[c.a].cross(c.arm_a);
            const double next =
                // (9) with moves: accumulated, so that a push which another one made needless
                // is taken back
                std::max(push.done + (push.target - move.dot(c.normal)) * push.effective_mass, 0.0);
            const double change = next - push.done;
            push.done = next;
            out.shift[c.a] -= change * bodies.inverse_mass[c.a] * c.normal;
            out.shift[c.b] += change * bodies.inverse_mass[c.b] * c.normal;
            out.turn[c.a] -= change * push.turn_a;
            out.turn[c.b] += change * push.turn_b;
            if (is_of_ship(bodies, c)) out.shift[kShip] -= change * push.ship_shift;
        }
}

void Overlaps::crush(Scene& scene, const std::vector<Contact>& contacts,
                     const std::vector<Constraint>& constraints, const ContactLaw& law, double dt) {
    ICE_ASSERT(constraints.size() == contacts.size());
    const Bodies& bodies = scene.bodies;
    crushings_.clear();
    if (law.is_rigid()) return;
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const Constraint& c = constraints[k];
        if (contacts[k].is_of_solids() || !c.is_at_bound()) continue;
        // what the step leaves at the final velocities; an opening contact has crushed nothing
        // more
        const double gap = gap_after(bodies, c, dt);
        if (gap >= 0.0) continue;
        const Contact& contact = contacts[k];
        if (contact.crushes_a)
            crushings_.push_back({c.a, contact.sphere_a, k, gap, -c.normal});
        else
            crushings_.push_back({c.b, contact.sphere_b, k, gap, c.normal});
    }
    std::sort(crushings_.begin(), crushings_.end(), [](const Crushing& l, const Crushing& r) {
        return std::tie(l.body, l.sphere, l.constraint) < std::tie(r.body, r.sphere, r.constraint);
    });
    for (std::size_t k = 0; k < crushings_.size();) {
        const std::int32_t body = crushings_[k].body, sphere = crushings_[k].sphere;
        // several hull spheres may press on one of the ice's: it is displaced once
        Vec3 move = Vec3::Zero();
        for (;
             k < crushings_.size() && crushings_[k].body == body && crushings_[k].sphere == sphere;
             ++k)
            add_along(-crushings_[k].gap, crushings_[k].inwards, move);
        // stored in the body's axes: crushed ice moves and turns with its floe
        const Shape& shape = scene.shapes[static_cast<std::size_t>(bodies.shape[body])];
        scene.crushed.crush(body, sphere, shape.center.size(),
                            bodies.rotation[body].transpose() * move);
    }
}

}  // namespace ice
