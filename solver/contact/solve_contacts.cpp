// SPDX-License-Identifier: GPL-3.0-or-later
//
// Projected Gauss-Seidel ("sequential impulses") over the contacts in the order of ContactRows:
// each in turn gets the impulse that satisfies its own conditions, given all others; repeated
// until no contact velocity changes any more. The fixed point satisfies all conditions together;
// extrapolation between the sweeps brings it near.
#include "solver/contact/solve_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace ice {

namespace {

// Overlap that is left alone [m]: contacts that just touch stay contacts.
constexpr double kSlop = 1e-4;

// Share of the overlap beyond kSlop removed in a step. 1 would overshoot where contacts share a
// body; 0.2 is the usual value of split-impulse solvers.
constexpr double kPushShare = 0.2;

// Most a contact is pushed apart in a step [m], so that a deep overlap opens smoothly.
constexpr double kMostPush = 0.005;

constexpr int kSeparationIterations = 10;

// Solutions with rebound at most; the second one is for contacts that crush by another's rebound.
// Contacts that only this one brings to their strength keep what rebound it leaves them.
constexpr int kRebounds = 2;

// The last third of the iterations is plain sweeps: they end near the answer also where the
// extrapolated ones go round it.
constexpr int kPlainShare = 3;

bool meets_within_step(const Constraint& c, double dt) {
    return c.gap + dt * std::min(c.approach, 0.0) <= 0.0;
}

// The ship and ice that is held for good: neither can give way, so the ice crushes.
void drive_through(const Bodies& bodies, Constraint& c) {
    const Vec3 v = relative_velocity(bodies, c);
    const Vec3 sliding = v - v.dot(c.normal) * c.normal;
    const double speed = sliding.norm();
    c.impact_normal = c.strength;
    if (speed > 0.0) c.impact_tangent = -(c.friction * c.strength / speed) * sliding;
}

// A stage of several solutions is as good as the worst of them.
void add(const SolveReport& part, SolveReport& whole) {
    whole.iterations += part.iterations;
    whole.residual = std::max(whole.residual, part.residual);
    whole.converged = whole.converged && part.converged;
}

}  // namespace

SolveReport ContactSolver::iterate(const ContactLaw& law) {
    SolveReport report;
    extrapolation_.begin(contacts_);
    while (true) {
        ++report.iterations;
        report.residual = sweep(contacts_.blocks, contacts_.rows, contacts_.motion);
        report.converged = report.residual <= law.tolerance;
        if (report.converged || report.iterations >= law.iterations) return report;
        if (report.iterations * kPlainShare < law.iterations * (kPlainShare - 1))
            extrapolation_.advance(contacts_);
    }
}

SolveReport ContactSolver::solve_impacts(Bodies& bodies, std::vector<Constraint>& constraints,
                                         const ContactLaw& law, double restitution) {
    contacts_.begin_stage(bodies, constraints, &Constraint::impact_normal,
                          &Constraint::impact_tangent,
                          [&](const Constraint& c) -> ContactRows::Target {
                              return {meets_within_step(c, law.dt),
                                      c.rebounds ? -restitution * c.approach : 0.0, c.strength};
                          });
    const SolveReport report = iterate(law);
    contacts_.end_stage(bodies, constraints, &Constraint::impact_normal,
                        &Constraint::impact_tangent);
    return report;
}

// Newton's restitution, but none where the ice crushes. Which contacts crush is known once the
// bodies have stopped, and again once others rebounded: a contact once crushed stays so, or the two
// answers would take turns.
SolveReport ContactSolver::rebound(Bodies& bodies, std::vector<Constraint>& constraints,
                                   const ContactLaw& law) {
    if (std::isinf(law.crushing_pressure))
        return solve_impacts(bodies, constraints, law, law.restitution);
    SolveReport report = solve_impacts(bodies, constraints, law, 0.0);
    for (int pass = 0; pass < kRebounds; ++pass) {
        int fresh = 0;
        for (Constraint& c : constraints)
            if (c.rebounds && c.impact_normal >= c.strength) {
                c.rebounds = false;
                ++fresh;
            }
        if (pass > 0 && fresh == 0) break;
        add(solve_impacts(bodies, constraints, law, law.restitution), report);
    }
    return report;
}

SolveReport ContactSolver::resolve_impacts(Bodies& bodies, std::vector<Constraint>& constraints,
                                           const ContactLaw& law) {
    contacts_.build(bodies, constraints);
    for (Constraint& c : constraints)
        if (c.normal_mass == 0.0 && !std::isinf(c.strength) && c.approach < 0.0 &&
            meets_within_step(c, law.dt))
            drive_through(bodies, c);
    const bool approaching = std::any_of(
        constraints.begin(), constraints.end(),
        [&](const Constraint& c) { return c.approach < 0.0 && meets_within_step(c, law.dt); });
    if (!approaching) return {};
    start_.save(bodies, constraints);
    SolveReport report = rebound(bodies, constraints, law);
    if (law.restitution == 0.0 || energy_gain(bodies, constraints, start_) <= 0.0) return report;
    full_.save(bodies, constraints);
    start_.restore(bodies, constraints);
    const SolveReport stopped = solve_impacts(bodies, constraints, law, 0.0);
    add(stopped, report);
    plastic_.save(bodies, constraints);
    full_.restore(bodies, constraints);
    limit_rebound(bodies, constraints, start_, plastic_);
    return report;
}

SolveReport ContactSolver::resolve_rest(Bodies& bodies, std::vector<Constraint>& constraints,
                                        const ContactLaw& law) {
    for (Constraint& c : constraints) {
        if (c.normal_mass == 0.0) c.rest_normal = 0.0;
        if (c.rest_normal > 0.0)
            apply_impulse(bodies, c, c.rest_normal * c.normal + c.rest_tangent);
        else
            c.rest_tangent.setZero();
    }
    contacts_.begin_stage(
        bodies, constraints, &Constraint::rest_normal, &Constraint::rest_tangent,
        [&](const Constraint& c) -> ContactRows::Target {
            return {true, -std::max(c.gap, 0.0) / law.dt, c.strength - c.impact_normal};
        });
    const SolveReport report = iterate(law);
    contacts_.end_stage(bodies, constraints, &Constraint::rest_normal, &Constraint::rest_tangent);
    return report;
}

void separate_overlaps(const Bodies& bodies, const std::vector<Constraint>& constraints,
                       const ContactLaw& law, Nudges& out) {
    out.shift.assign(bodies.size(), Vec3::Zero());
    out.turn.assign(bodies.size(), Vec3::Zero());
    struct Push {
        const Constraint* c;
        double wanted, done;
    };
    std::vector<Push> pushes;
    for (const Constraint& c : constraints) {
        const double gap = c.gap + law.dt * relative_velocity(bodies, c).dot(c.normal);
        if (gap < -kSlop && c.normal_mass > 0.0 && !c.crushed())
            pushes.push_back({&c, std::min(kPushShare * (-gap - kSlop), kMostPush), 0.0});
    }
    for (int iteration = 0; iteration < kSeparationIterations; ++iteration)
        for (Push& push : pushes) {
            const Constraint& c = *push.c;
            const Vec3 move = out.shift[c.b] + out.turn[c.b].cross(c.arm_b) - out.shift[c.a] -
                              out.turn[c.a].cross(c.arm_a);
            const double next =
                std::max(push.done + (push.wanted - move.dot(c.normal)) * c.normal_mass, 0.0);
            const double change = next - push.done;
            push.done = next;
            out.shift[c.a] -= change * bodies.inverse_mass[c.a] * c.normal;
            out.shift[c.b] += change * bodies.inverse_mass[c.b] * c.normal;
            out.turn[c.a] -= change * c.turn_a;
            out.turn[c.b] += change * c.turn_b;
        }
}

void crush_ice(Scene& scene, const std::vector<Contact>& contacts,
               const std::vector<Constraint>& constraints, double dt) {
    const Bodies& bodies = scene.bodies;
    std::map<std::pair<std::int32_t, std::int32_t>, Vec3> moved;  // (body, sphere), world axes
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const Constraint& c = constraints[k];
        const double gap = c.gap + dt * relative_velocity(bodies, c).dot(c.normal);
        if (!c.crushed() || gap >= 0.0) continue;
        const Contact& contact = contacts[k];
        const std::int32_t body = contact.crushes_a ? c.a : c.b;
        const std::int32_t sphere = contact.crushes_a ? contact.sphere_a : contact.sphere_b;
        const Vec3 inwards = contact.crushes_a ? Vec3(-c.normal) : c.normal;
        // several hull spheres may press on one of the ice's: it gives way once
        Vec3& done = moved.try_emplace({body, sphere}, Vec3::Zero()).first->second;
        done += std::max(0.0, -gap - done.dot(inwards)) * inwards;
    }
    for (const auto& [place, move] : moved) {
        const auto [body, sphere] = place;
        const Shape& shape = scene.shapes[static_cast<std::size_t>(bodies.shape[body])];
        scene.crushed.crush(body, sphere, shape.center.size(),
                            bodies.rotation[body].transpose() * move);
    }
}

}  // namespace ice
