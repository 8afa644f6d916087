// SPDX-License-Identifier: GPL-3.0-or-later
//
// Projected Gauss-Seidel ("sequential impulses") over the contacts in the order of ContactRows:
// each in turn gets the impulse that satisfies its own conditions, given all others; repeated
// until no contact velocity changes any more. The fixed point satisfies all conditions together;
// extrapolation between the sweeps brings it near.
#include "solver/contact/solve_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ice {

namespace {

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
    extrapolation_.begin(contacts_, !std::isinf(law.crushing_pressure));
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
    contacts_.begin_stage(bodies, constraints, meeting_, &Constraint::impact_normal,
                          &Constraint::impact_tangent,
                          [&](const Constraint& c) -> ContactRows::Target {
                              return {c.rebounds ? -restitution * c.approach : 0.0, c.strength};
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
        for (const std::int32_t k : meeting_) {
            Constraint& c = constraints[k];
            if (!c.rebounds || c.impact_normal < c.strength) continue;
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
    meeting_.clear();
    bool approaching = false;
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        Constraint& c = constraints[k];
        if (!meets_within_step(c, law.dt)) continue;
        meeting_.push_back(static_cast<std::int32_t>(k));
        approaching = approaching || c.approach < 0.0;
        if (c.normal_mass == 0.0 && !std::isinf(c.strength) && c.approach < 0.0)
            drive_through(bodies, c);
    }
    if (!approaching) return {};
    passive_.begin(bodies, contacts_, constraints, meeting_);
    SolveReport report = rebound(bodies, constraints, law);
    if (law.restitution == 0.0 || passive_.energy_gain(bodies, contacts_, constraints) <= 0.0)
        return report;
    passive_.set_aside(bodies, contacts_, constraints);
    add(solve_impacts(bodies, constraints, law, 0.0), report);
    passive_.limit_rebound(bodies, contacts_, constraints);
    return report;
}

SolveReport ContactSolver::resolve_rest(Bodies& bodies, std::vector<Constraint>& constraints,
                                        const ContactLaw& law) {
    // the first guess moves copies: taken back from the bodies it would leave its rounding there
    velocities_.clear();
    for (const std::int32_t body : contacts_.bodies())
        velocities_.emplace_back(bodies.velocity[body], bodies.angular_velocity[body]);
    guessed_.clear();
    all_.resize(constraints.size());
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        Constraint& c = constraints[k];
        all_[k] = static_cast<std::int32_t>(k);
        if (c.normal_mass == 0.0) c.rest_normal = 0.0;
        if (c.rest_normal > 0.0) {
            apply_impulse(bodies, c, c.rest_normal * c.normal + c.rest_tangent);
            guessed_.push_back(all_[k]);
        } else {
            c.rest_tangent.setZero();
        }
    }
    contacts_.begin_stage(bodies, constraints, all_, &Constraint::rest_normal,
                          &Constraint::rest_tangent,
                          [&](const Constraint& c) -> ContactRows::Target {
                              return {-std::max(c.gap, 0.0) / law.dt, c.strength - c.impact_normal};
                          });
    for (std::size_t k = 0; k < velocities_.size(); ++k) {
        const std::int32_t body = contacts_.bodies()[k];
        std::tie(bodies.velocity[body], bodies.angular_velocity[body]) = velocities_[k];
    }
    for (const std::int32_t k : guessed_) {
        constraints[k].rest_normal = 0.0;
        constraints[k].rest_tangent.setZero();
    }
    const SolveReport report = iterate(law);
    contacts_.end_stage(bodies, constraints, &Constraint::rest_normal, &Constraint::rest_tangent);
    return report;
}

}  // namespace ice
