// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/run/measure_imbalance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "solver/record/measure_step.hpp"

namespace ice {

namespace {

// A sum that should vanish, and the sum of its terms' magnitudes.
struct Sum {
    Vec3 value = Vec3::Zero();
    double size = 0.0;

    void add(const Vec3& v) {
        value += v;
        size += v.norm();
    }
    double share(const Vec3& axes) const {
        // a sum without terms is balanced, too: not 0 / 0
        const double off = value.cwiseProduct(axes).norm();
        return off == 0.0 ? 0.0 : off / size;
    }
};

struct Sums {
    Sum linear, angular;
};

// Contact impulses on each body, and their moment about its position before the step.
void add_contacts(const std::vector<Constraint>& constraints, std::vector<Sums>& sums) {
    for (const Constraint& c : constraints) {
        // J acts on b and -J on a; both are taken off what the momenta gained
        const Vec3 j = c.total_normal() * c.normal + c.total_tangent();
        sums[c.a].linear.add(j);
        sums[c.b].linear.add(-j);
        sums[c.a].angular.add(c.arm_a.cross(j));
        sums[c.b].angular.add(-c.arm_b.cross(j));
    }
}

// The floes' changes less the loads, and the impulses on everything that cannot move.
Sums all_together(const Momenta& before, const World& w, const StepRecord& ship,
                  const std::vector<FloeLoad>& loads, const std::vector<Sums>& contacts) {
    const Bodies& b = w.scene.bodies;
    const double dt = w.parameters.time_step;
    Sums all;
    for (std::size_t i = 1; i < b.size(); ++i) {
        // a held floe takes its impulses into the ice around it
        const Vec3 gain = b.held[i] ? Vec3(-contacts[i].linear.value)
                                    : Vec3(b.momentum[i] - before.linear[i] - dt * loads[i].force);
        const Vec3 spin =
            b.held[i] ? Vec3(-contacts[i].angular.value)
                      : Vec3(b.angular_momentum[i] - before.angular[i] - dt * loads[i].moment);
        all.linear.add(gain);
        // angular momentum about the origin: spin and x times linear momentum
        all.angular.add(spin);
        all.angular.add(before.position[i].cross(gain));
        // the momenta and loads whose difference this is were rounded themselves
        const double swing = before.position[i].norm();
        const double linear =
            before.linear[i].norm() + contacts[i].linear.size + dt * loads[i].force.norm();
        all.linear.size += linear;
        all.angular.size += before.angular[i].norm() + contacts[i].angular.size +
                            dt * loads[i].moment.norm() + swing * linear;
    }
    const Vec3 force = ship.contact_force + ship.friction_force;
    all.linear.add(dt * force);
    all.angular.add(dt * ship.moment);
    all.angular.add(dt * before.position[kShip].cross(force));
    return all;
}

// How far the free ones of three motions are from balance: change of momentum less impulse, in
// their axes. @param given  size of what the impulse is the sum of
double off_balance(const ShipBody& body, Freedom first, const Mat3& masses, const Vec3& from,
                   const Vec3& to, const Vec3& impulse, double given) {
    const auto is_free = [&](int k) { return body.free[static_cast<std::size_t>(first + k)]; };
    double off = 0.0, size = given;
    for (int k = 0; k < 3; ++k) {
        if (!is_free(k)) continue;
        // the row of the matrix on the free motions: locked ones have no equation
        Vec3 row = masses.row(k);
        for (int j = 0; j < 3; ++j)
            if (!is_free(j)) row[j] = 0.0;
        off += std::abs(row.dot(to - from) - impulse[k]);
        size += row.cwiseAbs().dot(to.cwiseAbs() + from.cwiseAbs()) + std::abs(impulse[k]);
    }
    return off == 0.0 ? 0.0 : off / size;
}

double imbalance_of_ship(const Momenta& before, const World& w, const StepRecord& reported,
                         const Sums& contacts) {
    const Bodies& b = w.scene.bodies;
    const double dt = w.parameters.time_step;
    const ShipBody& body = w.ship.rig().body;
    const ShipAxes axes = axes_of(before.ship_angles);
    const ShipMasses masses = masses_of(body, before.ship_angles);
    const ShipForce loads = w.ship.loads().total();
    const Vec3 ice = reported.contact_force + reported.friction_force;
    // about the centre of gravity, as (S1); the report's moment is about the mesh's origin
    const Vec3 ice_moment = reported.moment - b.ship.centre.cross(ice);
    const Mat3 to_axes = axes.translation.transpose(), to_rates = axes.rotation.inverse();
    // Equations of motion in the ship's axes: along the free axes, the change of M v is the
    // impulse of loads and ice. Fixed axes are left out, their reaction is unknown.
    const double linear = off_balance(
        body, surge, masses.translation, to_axes * w.ship.velocity_start(),
        to_axes * b.velocity[kShip], dt * (to_axes * (loads.force + ice)), contacts.linear.size);
    const double angular =
        off_balance(body, roll, masses.rotation, to_rates * w.ship.spin_start(),
                    to_rates * b.angular_velocity[kShip],
                    dt * (axes.rotation.transpose() * (loads.moment + ice_moment)),
                    contacts.angular.size + b.ship.centre.norm() * contacts.linear.size);
    return std::max(linear, angular);
}

}  // namespace

double Imbalance::worst() const { return std::max({linear, angular, together, ship}); }

Momenta momenta_of(const World& w) {
    const Bodies& b = w.scene.bodies;
    return {b.position, b.momentum, b.angular_momentum, w.ship.angles()};
}

Imbalance measure_imbalance(const Momenta& before, const World& after) {
    const Bodies& b = after.scene.bodies;
    const double dt = after.parameters.time_step;
    // A 2D run has motion in x, z and about y only; the other components are held, so they balance
    // nothing.
    const bool flat = after.scene.dimension == 2;
    const Vec3 axes = flat ? Vec3(1, 0, 1) : Vec3::Ones();
    const Vec3 turns = flat ? Vec3(0, 1, 0) : Vec3::Ones();

    std::vector<Sums> sums(b.size());
    add_contacts(after.constraints, sums);
    Imbalance out;
    const std::vector<FloeLoad> loads = loads_by_body(b, after.loads);
    const StepRecord reported = measure_step(after.scene, after.contacts, after.constraints, dt);
    const Sums all = all_together(before, after, reported, loads, sums);
    out.together = std::max(all.linear.share(axes), all.angular.share(turns));
    if (after.ship.is_free()) out.ship = imbalance_of_ship(before, after, reported, sums[kShip]);

    for (std::size_t i = 1; i < b.size(); ++i) {
        if (b.held[i]) continue;
        Sums& s = sums[i];
        // Each sum is zero where the step balances: new momentum - old momentum - dt * loads -
        // impulses.
        s.linear.add(b.momentum[i]);
        s.linear.add(-before.linear[i]);
        s.linear.add(-dt * loads[i].force);
        s.angular.add(b.angular_momentum[i]);
        s.angular.add(-before.angular[i]);
        s.angular.add(-dt * loads[i].moment);
        // a not-a-number must not pass for balance
        const double linear = s.linear.share(axes), angular = s.angular.share(turns);
        if (!(linear <= out.linear)) out.linear = linear, out.linear_floe = int(i);
        if (!(angular <= out.angular)) out.angular = angular, out.angular_floe = int(i);
    }
    return out;
}

Imbalance require_balance(const Momenta& before, const World& after) {
    const Imbalance found = measure_imbalance(before, after);
    const auto refuse = [&](const std::string& who, const char* what, double share) {
        throw run_failed(
            fmt::format("step {}, {}", after.steps, who),
            fmt::format("the change of {} differs from loads and contact impulses by {:.2g} of "
                        "them; rounding explains {:g}",
                        what, share, kBalanceTolerance),
            "this is a defect of the program: report it with the case, or run without --verify");
    };
    // each test is negated, so that a not-a-number is refused
    if (!(found.linear <= kBalanceTolerance))
        refuse(fmt::format("floe {}", found.linear_floe), "momentum", found.linear);
    if (!(found.angular <= kBalanceTolerance))
        refuse(fmt::format("floe {}", found.angular_floe), "angular momentum", found.angular);
    if (!(found.together <= kBalanceTolerance))
        refuse("ship and all floes", "momentum of both", found.together);
    if (!(found.ship <= kBalanceTolerance)) refuse("ship", "momentum", found.ship);
    return found;
}

}  // namespace ice
