// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/siconos/step_again.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "common/base/assert.hpp"
#include "solver/loads/measure_loads.hpp"
#include "tests/siconos/siconos_solver.hpp"

namespace ice::oracle {

namespace {

// Our solution to rounding: the change of a contact's velocity in the last sweep [m/s], and sweeps
// [-] that are more than it has needed.
constexpr double kToRounding = 1e-12;
constexpr int kEnough = 100000;

bool is_of_ship(const Constraint& c) { return c.a == static_cast<std::int32_t>(kShip); }

// The conditions of one stage, and our impulses in it.
struct Stage {
    std::function<double(const Constraint&)> target;  // [m/s]
    std::function<bool(const Constraint&)> takes_part;
    std::function<Vec3(const Constraint&)> impulse;     // ours [N s]
    std::function<bool(const Constraint&)> is_bounded;  // at its upper bound
};

// Siconos' impulses on the ship for a stage, those of contacts at their bound being ours.
Vec3 ship_impulse(Bodies bodies, const std::vector<Constraint>& solved, const Stage& stage,
                  int most, double& error) {
    std::vector<Constraint> free;
    std::vector<double> target;
    Vec3 sum = Vec3::Zero();
    for (const Constraint& c : solved) {
        if (!stage.takes_part(c)) continue;
        if (!c.can_move || stage.is_bounded(c)) {
            if (c.can_move) apply_impulse(bodies, c, stage.impulse(c));
            if (is_of_ship(c)) sum -= stage.impulse(c);
            continue;
        }
        free.push_back(c);
        target.push_back(stage.target(c));
    }
    const ConeSolution solution = solve_cones(bodies, free, target, most);
    error = std::max(error, solution.error);
    for (std::size_t k = 0; k < free.size(); ++k)
        if (is_of_ship(free[k])) sum -= solution.impulse[k];
    return sum;
}

Stage impacts_of(double dt) {
    return {[](const Constraint&) { return 0.0; },
            [dt](const Constraint& c) { return meet_within(c.gap, c.approach, dt); },
            [](const Constraint& c) { return Vec3(c.impact_normal * c.normal + c.impact_tangent); },
            [](const Constraint& c) { return c.impact_normal >= c.max_impulse * (1.0 - 1e-9); }};
}

Stage rest_of(double dt) {
    return {[dt](const Constraint& c) { return -std::max(c.gap, 0.0) / dt; },
            [](const Constraint&) { return true; },
            [](const Constraint& c) { return Vec3(c.rest_normal * c.normal + c.rest_tangent); },
            [](const Constraint& c) { return c.is_at_bound(); }};
}

Vec3 ship_impulse(const std::vector<Constraint>& constraints) {
    Vec3 sum = Vec3::Zero();
    for (const Constraint& c : constraints)
        if (is_of_ship(c)) sum -= c.total_normal() * c.normal + c.total_tangent();
    return sum;
}

}  // namespace

StepAgain solve_again(const Bodies& before, const World& after, int most) {
    ICE_ASSERT(after.parameters.contact.restitution == 0.0 && !after.edge.has_sheet());
    const double dt = after.parameters.time_step;
    ContactLaw law = after.parameters.contact;
    law.iterations = kEnough;
    law.tolerance = kToRounding;
    StepAgain out;
    out.as_run = ship_impulse(after.constraints);
    out.converged = after.impacts.converged && after.rest.converged;

    Bodies bodies = before;
    bodies.velocity[kShip] = after.start.velocity[kShip];
    bodies.angular_velocity[kShip] = after.start.angular_velocity[kShip];
    std::vector<Constraint> constraints = after.constraints;
    for (Constraint& c : constraints) {
        c.impact_normal = c.rest_normal = 0.0;
        c.impact_tangent = c.rest_tangent = Vec3::Zero();
    }
    ContactSolver solver;
    Bodies start = bodies;
    solver.resolve_impacts(bodies, constraints, law, dt);
    out.siconos = ship_impulse(start, constraints, impacts_of(dt), most, out.error);
    apply_loads(bodies, after.loads, dt);
    start = bodies;
    solver.resolve_rest(bodies, constraints, law, dt);
    out.siconos += ship_impulse(start, constraints, rest_of(dt), most, out.error);
    out.ours = ship_impulse(constraints);
    for (const Constraint& c : constraints) {
        if (c.total_normal() == 0.0) continue;
        ++out.contacts;
        out.at_bound += c.is_at_bound() ? 1 : 0;
    }
    return out;
}

}  // namespace ice::oracle
