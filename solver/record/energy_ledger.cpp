// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/energy_ledger.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

namespace ice {

namespace {

// A residual above this share of the ship's work is worth a warning.
constexpr double kWorryingResidual = 0.005;

Vec3 relative_velocity(const Velocities& v, const Constraint& c) {
    return v.linear[c.b] + v.angular[c.b].cross(c.arm_b) - v.linear[c.a] -
           v.angular[c.a].cross(c.arm_a);
}

// One stage of one contact.
void book_impulse(const Constraint& c, double normal, const Vec3& tangent, const Vec3& mean,
                  EnergyLedger& ledger) {
    const double pressed = -normal * c.normal.dot(mean);
    (c.crushed() ? ledger.crushing : ledger.restitution) += pressed;
    ledger.friction -= tangent.dot(mean);
}

}  // namespace

double EnergyLedger::residual(double potential_now) const {
    return ship_work + separation - kinetic - (potential_now - potential_start.value_or(0.0)) -
           friction - restitution - crushing - drag - buoyancy_moment;
}

void Velocities::take(const Bodies& bodies) {
    linear = bodies.velocity;
    angular = bodies.angular_velocity;
}

void book_step(const Scene& scene, const Case& parameters,
               const std::vector<Constraint>& constraints, const std::vector<FloeLoad>& loads,
               const Nudges& nudges, const StepBooks& books, EnergyLedger& ledger) {
    const Bodies& b = scene.bodies;
    for (const Constraint& c : constraints) {
        if (c.total_normal() == 0.0) continue;
        const Vec3 before = relative_velocity(books.start, c);
        const Vec3 between = relative_velocity(books.collided, c);
        const Vec3 after = relative_velocity(b, c);
        book_impulse(c, c.impact_normal, c.impact_tangent, 0.5 * (before + between), ledger);
        book_impulse(c, c.rest_normal, c.rest_tangent, 0.5 * (between + after), ledger);
        if (c.a == static_cast<std::int32_t>(kShip))
            ledger.ship_work +=
                (c.total_normal() * c.normal + c.total_tangent()).dot(b.velocity[kShip]);
    }
    const double dt = parameters.time_step;
    const bool unrighted = parameters.buoyancy == BuoyancyModel::centre;
    for (std::size_t i = 1; i < b.size(); ++i) {
        if (b.held[i]) continue;
        const FloeLoad& load = loads[i];
        const Vec3 v = 0.5 * (books.collided.linear[i] + b.velocity[i]);
        const Vec3 w = 0.5 * (books.collided.angular[i] + b.angular_velocity[i]);
        ledger.drag -= dt * (load.drag.force.dot(v) + load.drag.moment.dot(w));
        // the rotation of the last step and of this one, half each: the trapezoidal rule over the
        // run, with the moment at the pose between the two
        if (unrighted)
            ledger.buoyancy_moment +=
                dt * load.righting.dot(0.5 * (books.start.angular[i] + b.angular_velocity[i]));
        const Vec3 weight = load.force - load.drag.force;
        ledger.separation -= weight.dot(nudges.shift[i]) + load.righting.dot(nudges.turn[i]);
    }
}

void fill_energy(const EnergyLedger& ledger, double potential_now, Summary& summary) {
    const double residual = ledger.residual(potential_now);
    const double work = std::abs(ledger.ship_work);
    const double share = work > 0.0 ? residual / work : 0.0;
    auto& out = summary.energy;
    out["ship_work_J"] = ledger.ship_work;
    out["kinetic_change_J"] = ledger.kinetic;
    out["potential_J"] = potential_now - ledger.potential_start.value_or(potential_now);
    out["friction_J"] = ledger.friction;
    out["restitution_J"] = ledger.restitution;
    out["crushing_J"] = ledger.crushing;
    out["drag_J"] = ledger.drag;
    out["separation_J"] = ledger.separation;
    out["buoyancy_moment_J"] = ledger.buoyancy_moment;
    out["residual_J"] = residual;
    out["residual_share"] = share;
    if (std::abs(share) > kWorryingResidual)
        summary.warnings.push_back(fmt::format(
            "energy: {:.2g} % of the ship's work is not explained by motion, height, friction, "
            "impacts, crushing and drag; the time step is too long: lower simulation.time_step",
            100.0 * share));
}

}  // namespace ice
