// SPDX-License-Identifier: GPL-3.0-or-later
//
// Projected Gauss-Seidel ("sequential impulses") over the contacts in the order of ContactRows:
// each in turn gets the impulse that satisfies its own conditions, given all others; repeated
// until no contact velocity changes any more. The fixed point satisfies all conditions together;
// conjugate gradients between the sweeps bring it near.
#include "solver/contact/solve_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/base/assert.hpp"
#include "solver/contact/constraint_order.hpp"
#include "solver/contact/sweep.hpp"

namespace ice {

namespace {

// Solutions with rebound at most [-]. The second one is for contacts that crush by another's
// rebound; contacts that reach their bound only in this one keep its rebound. Another one would
// cost a further solution. Where each sweep decided, two results alternated and most steps did not
// converge (docs/design-notes.md).
constexpr int kRebounds = 2;

// The last third of the iterations is plain sweeps: they end near the solution also where the
// accelerated ones circle it. A larger divisor [-] leaves fewer plain sweeps; only solutions that
// take many iterations reach them.
constexpr int kPlainShare = 3;

// Distance from closing [m] within which a contact takes part in the rest stage: most contacts are
// near ones that carry nothing. Without this margin a step takes 2.6 to 6.5 solutions instead of
// 1.07 to 1.14; twice as much takes a fifth more contacts.
constexpr double kNear = 1e-4;

// Rest solutions at most [-]: each adds the contacts that the last one closed; closing that is left
// becomes overlap. Fewer leave more steps unconverged; a step with more than two is rare.
constexpr int kRestSolutions = 5;

// The ship and held ice, if no impulse moves either of them along the normal: the ice is crushed.
// On a ship that is free in other directions friction acts, at most as much as ends the sliding.
void drive_through(Bodies& bodies, Constraint& c) {
    // friction opposite the sliding velocity, on the cone: mu times the bound
    const Vec3 v = relative_velocity(bodies, c);
    const Vec3 sliding = v - v.dot(c.normal) * c.normal;
    const double speed = sliding.norm();
    c.impact_normal = c.max_impulse;
    if (speed > 0.0) c.impact_tangent = -(c.friction * c.max_impulse / speed) * sliding;
    // Friction slows a ship that is free along the sliding; it does not reverse its motion.
    if (c.a != static_cast<std::int32_t>(kShip) || !bodies.ship.free || speed == 0.0) return;
    const double inverse_effective_mass = ship_response(bodies.ship, c.arm_a, sliding / speed);
    if (inverse_effective_mass * c.friction * c.max_impulse > speed)
        c.impact_tangent = -1.0 / inverse_effective_mass * sliding;
    push_ship(bodies, c, c.impact_tangent);
}

// How much nearer than its gap a contact will be at the end of the step [m]; negative while it
// stays apart.
double closes_by(const Bodies& bodies, const Constraint& c, double dt) {
    return -dt * relative_velocity(bodies, c).dot(c.normal) - std::max(c.gap, 0.0);
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
    gradient_.begin(contacts_, !law.is_rigid());
    while (true) {
        ++report.iterations;
        // A free ship is solved as copies, one per pair (section 13), which become one ship
        // again after each sweep; one on a prescribed course is not touched.
        contacts_.part_ship();
        report.residual =
            sweep(contacts_.blocks, contacts_.rows, contacts_.motion, contacts_.excess);
        contacts_.join_ship();
        report.converged = report.residual <= law.tolerance;
        if (report.converged || report.iterations >= law.iterations) return report;
        // plain sweeps at the end: they restore bounds and cones that a direction may leave
        if (report.iterations * kPlainShare < law.iterations * (kPlainShare - 1))
            gradient_.advance(contacts_);
    }
}

SolveReport ContactSolver::solve_impacts(Bodies& bodies, std::vector<Constraint>& constraints,
                                         const ContactLaw& law, double restitution) {
    // (6): the target is Newton's -e v_r0 . n, with v_r0 before the stage; 0 where the ice
    // crushes
    contacts_.begin_stage(bodies, constraints, &Constraint::impact_normal,
                          &Constraint::impact_tangent,
                          [&](const Constraint& c) -> ContactRows::Target {
                              return {c.rebounds ? -restitution * c.approach : 0.0, c.max_impulse};
                          });
    const SolveReport report = iterate(law);
    contacts_.end_stage(bodies, constraints, &Constraint::impact_normal,
                        &Constraint::impact_tangent);
    return report;
}

// Newton's restitution, but none where the ice crushes. Which contacts crush is known once the
// bodies have stopped, and again once others rebounded: a contact once crushed stays so, or the two
// results would alternate.
SolveReport ContactSolver::rebound(Bodies& bodies, std::vector<Constraint>& constraints,
                                   const ContactLaw& law) {
    if (law.is_rigid()) return solve_impacts(bodies, constraints, law, law.restitution);
    // first without rebound: it shows which contacts reach their bound, p A dt
    SolveReport report = solve_impacts(bodies, constraints, law, 0.0);
    for (int pass = 0; pass < kRebounds; ++pass) {
        int fresh = 0;
        for (const std::int32_t k : meeting_) {
            Constraint& c = constraints[k];
            if (!c.rebounds || c.impact_normal < c.max_impulse) continue;
            c.rebounds = false;
            ++fresh;
        }
        if (pass > 0 && fresh == 0) break;
        add(solve_impacts(bodies, constraints, law, law.restitution), report);
    }
    return report;
}

SolveReport ContactSolver::resolve_impacts(Bodies& bodies, std::vector<Constraint>& constraints,
                                           const ContactLaw& law, double dt) {
    meeting_.clear();
    bool approaching = false;
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        Constraint& c = constraints[k];
        // a contact that stays open through the step has no part in the impacts
        if (!meet_within(c.gap, c.approach, dt)) continue;
        meeting_.push_back(static_cast<std::int32_t>(k));
        approaching = approaching || c.approach < 0.0;
        // Neither body can move: the bound (13) acts as long as they approach. Rigid ice has no
        // bound: it carries nothing, and the step counts as jammed.
        if (!c.can_move && !std::isinf(c.max_impulse) && c.approach < 0.0) drive_through(bodies, c);
    }
    if (!approaching) return {};
    contacts_.build(bodies, constraints, meeting_);
    // the state before the solution, to which (8) may have to return
    limiter_.begin(bodies, contacts_, constraints, meeting_);
    SolveReport report = rebound(bodies, constraints, law);
    // Without rebound the solution loses energy by itself. With it, islands that would gain
    // energy get the largest share of the rebound for which they do not, (8).
    if (law.restitution == 0.0 || limiter_.energy_gain(bodies, contacts_, constraints) <= 0.0)
        return report;
    limiter_.set_aside(bodies, contacts_, constraints);
    add(solve_impacts(bodies, constraints, law, 0.0), report);
    limiter_.limit_rebound(bodies, contacts_, constraints);
    return report;
}

bool ContactSolver::enlist(const Bodies& bodies, const std::vector<Constraint>& constraints,
                           double tolerance, double dt) {
    const std::size_t before = active_.size();
    double most = 0.0;
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const Constraint& c = constraints[k];
        // constraints that take part already, or are between immovable bodies, are left out
        if (is_active_[k] || !c.can_move) continue;
        const double closes = closes_by(bodies, c, dt);
        most = std::max(most, closes);
        if (closes >= -kNear || c.rest_normal > 0.0)
            active_.push_back(static_cast<std::int32_t>(k));
    }
    // No other contact closes by more than the tolerance: the last solution is the result.
    if (before > 0 && most <= tolerance * dt) {
        active_.resize(before);
        return false;
    }
    for (std::size_t k = before; k < active_.size(); ++k) is_active_[active_[k]] = 1;
    std::sort(active_.begin(), active_.end());
    return active_.size() > before;
}

void ContactSolver::begin_rest(const Bodies& bodies, const std::vector<Constraint>& constraints,
                               double dt) {
    contacts_.begin_stage(bodies, constraints, &Constraint::rest_normal, &Constraint::rest_tangent,
                          [&](const Constraint& c) -> ContactRows::Target {
                              // (6): the velocity that closes an open gap at the end of the
                              // step, and no further
                              return {-std::max(c.gap, 0.0) / dt, c.max_impulse - c.impact_normal};
                          });
}

// The first guess is applied to the bodies only while their motion is copied: subtracting it
// afterwards would leave rounding.
void ContactSolver::begin_rest_with_guess(Bodies& bodies, std::vector<Constraint>& constraints,
                                          double dt) {
    velocities_.clear();
    for (const std::int32_t body : contacts_.bodies())
        velocities_.emplace_back(bodies.velocity[body], bodies.angular_velocity[body]);
    // the guess of the last step enters the rows' motions through the bodies' velocities
    for (const std::int32_t k : active_) {
        const Constraint& c = constraints[k];
        if (c.rest_normal > 0.0)
            apply_impulse(bodies, c, c.rest_normal * c.normal + c.rest_tangent);
    }
    begin_rest(bodies, constraints, dt);
    // the bodies themselves keep their velocities; end_stage() applies the whole impulse once
    for (std::size_t k = 0; k < velocities_.size(); ++k) {
        const std::int32_t body = contacts_.bodies()[k];
        std::tie(bodies.velocity[body], bodies.angular_velocity[body]) = velocities_[k];
    }
    for (const std::int32_t k : active_) {
        constraints[k].rest_normal = 0.0;
        constraints[k].rest_tangent.setZero();
    }
}

SolveReport ContactSolver::resolve_rest(Bodies& bodies, std::vector<Constraint>& constraints,
                                        const ContactLaw& law, double dt) {
    ICE_ASSERT(are_ordered(constraints));
    active_.clear();
    is_active_.assign(constraints.size(), 0);
    SolveReport report;
    // A solution may close contacts that did not take part: they are added and all are solved
    // again, at most five times. Only the first solution has a guess; later ones start from the
    // impulses of the one before.
    for (int solution = 0; solution < kRestSolutions; ++solution) {
        if (!enlist(bodies, constraints, law.tolerance, dt)) return report;
        contacts_.build(bodies, constraints, active_);
        solution == 0 ? begin_rest_with_guess(bodies, constraints, dt)
                      : begin_rest(bodies, constraints, dt);
        const int before = report.iterations;
        report = iterate(law);
        report.iterations += before;
        contacts_.end_stage(bodies, constraints, &Constraint::rest_normal,
                            &Constraint::rest_tangent);
    }
    report.converged = report.converged && !enlist(bodies, constraints, law.tolerance, dt);
    return report;
}

}  // namespace ice
