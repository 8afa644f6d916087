// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/energy_ledger.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ice {

namespace {

// A residual above this share [-] of the ship's work, or of the losses where they are larger, is
// worth a warning. The residual is of second order in the time step, so that a shorter one lowers
// it. Only the warning depends on this number.
constexpr double kWorryingResidual = 0.005;

// The uses of the work of one contact, (19). @param start  velocities at the start of the step
void enter_contact(const Bodies& now, const Constraint& c, const StepStart& start,
                   EnergyLedger& ledger) {
    const Vec3 before = start.velocity[c.b] + start.angular_velocity[c.b].cross(c.arm_b) -
                        start.velocity[c.a] - start.angular_velocity[c.a].cross(c.arm_a);
    // Work of an impulse on the mean of the velocities before and after it, (20): exact, since
    // velocities are linear in impulses.
    const Vec3 mean = 0.5 * (before + relative_velocity(now, c));
    const Vec3 push = c.total_normal() * c.normal, rub = c.total_tangent();
    // ship and ice that is held until it bends: the work before the break
    if (c.on_unbent) {
        ledger.breaking -= (push + rub).dot(mean);
    } else {
        // at its bound the impulse crushes ice, below it the work is lost in the impact
        (c.is_at_bound() ? ledger.crushing : ledger.restitution) -= push.dot(mean);
        ledger.friction -= rub.dot(mean);
    }
    const auto works_on = [&](std::int32_t i) {  // drifting held ice, on its neighbours
        return i != static_cast<std::int32_t>(kShip) && now.held[i] != 0;
    };
    // No force of the model moves held ice that drifts: its work on others comes from outside.
    if (works_on(c.a)) ledger.drift_work += (push + rub).dot(now.velocity[c.a]);
    if (works_on(c.b)) ledger.drift_work -= (push + rub).dot(now.velocity[c.b]);
    if (c.a != static_cast<std::int32_t>(kShip)) return;
    // the ship's work is that of its own mean velocity, too; on a course it does not change
    const Vec3 ship =
        now.ship.free ? Vec3(0.5 * (start.velocity[kShip] + now.velocity[kShip]) +
                             (0.5 * (start.angular_velocity[kShip] + now.angular_velocity[kShip]))
                                 .cross(c.arm_a))
                      : now.velocity[kShip];
    ledger.ship_work += (push + rub).dot(ship);
}

}  // namespace

void EnergyLedger::begin(const Scene& scene, const Case& parameters) {
    if (!potential_start) potential_start = potential_energy(scene, parameters);
}

double EnergyLedger::residual(double potential_now) const {
    // (19), solved for the residual; dU is the change of potential energy since the start
    return ship_work + drift_work + separation + water_work + applied_work - kinetic_change -
           (potential_now - potential_start.value_or(0.0)) - friction - restitution - crushing -
           breaking - drag - buoyancy_moment;
}

void enter_step(const Scene& scene, const Case& parameters,
                const std::vector<Constraint>& constraints, const std::vector<FloeLoad>& loads,
                const PositionCorrections& corrections, const StepStart& start,
                EnergyLedger& ledger) {
    const Bodies& b = scene.bodies;
    for (const Constraint& c : constraints)
        if (c.total_normal() > 0.0) enter_contact(b, c, start, ledger);
    const double dt = parameters.time_step;
    const bool unrighted = parameters.buoyancy == BuoyancyModel::centre;
    for (std::size_t k = 0; k < b.moving.size(); ++k) {
        const auto i = static_cast<std::size_t>(b.moving[k]);
        const FloeLoad& load = loads[k];
        // A force F over the step changes the kinetic energy by F dt * (v0 + v1) / 2, exactly: the
        // work is taken with the mean velocity, whatever the integrator does with the position.
        const Vec3 v = 0.5 * (start.velocity[i] + b.velocity[i]);
        const Vec3 w = 0.5 * (start.angular_velocity[i] + b.angular_velocity[i]);
        ledger.drag -= dt * (load.drag.force.dot(v) + load.drag.moment.dot(w));
        // of the drag's work the part against the water; the rest comes from the moving water
        ledger.drag += dt * load.water_power;
        ledger.water_work += dt * load.water_power;
        // potential energy includes the moment that buoyancy "centre" leaves out: its work is
        // missing
        if (unrighted) ledger.buoyancy_moment += dt * load.righting.dot(w);
        const WaterLoad& push = load.pressure;
        ledger.water_work += dt * (push.force.dot(v) + push.moment.dot(w));
        const WaterLoad& own = load.applied;
        ledger.applied_work += dt * (own.force.dot(v) + own.moment.dot(w));
        // The position correction lifts floes against weight and buoyancy without a velocity. That
        // work is in no other entry.
        const Vec3 weight = load.force - load.drag.force - push.force - own.force;
        ledger.separation -=
            weight.dot(corrections.shift[i]) + load.righting.dot(corrections.turn[i]);
    }
}

void fill_energy(const EnergyLedger& ledger, double potential_now, Summary& summary) {
    const double residual = ledger.residual(potential_now);
    const double work = std::abs(ledger.ship_work) + std::abs(ledger.drift_work);
    const double share = work > 0.0 ? residual / work : 0.0;
    // a ship that has hardly touched anything must not be blamed for floes that bob
    const double turnover = std::max(work, ledger.friction + ledger.restitution + ledger.crushing +
                                               ledger.breaking + ledger.drag);
    auto& out = summary.energy;
    out["ship_work_J"] = ledger.ship_work;
    // Entries of parts that a case does not have are left out of the summary.
    if (ledger.drift_work != 0.0) out["drift_work_J"] = ledger.drift_work;
    out["kinetic_change_J"] = ledger.kinetic_change;
    out["potential_J"] = potential_now - ledger.potential_start.value_or(potential_now);
    out["friction_J"] = ledger.friction;
    out["restitution_J"] = ledger.restitution;
    out["crushing_J"] = ledger.crushing;
    if (ledger.breaking != 0.0) out["breaking_J"] = ledger.breaking;
    out["drag_J"] = ledger.drag;
    if (ledger.water_work != 0.0) out["water_work_J"] = ledger.water_work;
    if (ledger.applied_work != 0.0) out["applied_work_J"] = ledger.applied_work;
    out["separation_J"] = ledger.separation;
    out["buoyancy_moment_J"] = ledger.buoyancy_moment;
    out["residual_J"] = residual;
    out["residual_share"] = share;
    if (work > 0.0 && std::abs(residual) > kWorryingResidual * turnover)
        summary.warnings.push_back(
            judged(fmt::format("energy: {:.2g} % of the ship's work is not explained by motion, "
                               "height, friction, impacts, crushing and drag: lower "
                               "simulation.time_step",
                               100.0 * residual / turnover),
                   std::abs(residual) / turnover));
}

}  // namespace ice
