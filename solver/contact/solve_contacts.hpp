// SPDX-License-Identifier: GPL-3.0-or-later
/// Many contacts at once: impulses that satisfy all contact conditions together
/// (docs/method.md, section 4).
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "solver/contact/conjugate_gradient.hpp"
#include "solver/contact/constraints.hpp"
#include "solver/contact/impact_energy_limiter.hpp"

namespace ice {

/// How an iterative stage ended.
struct SolveReport {
    int iterations = 0;     ///< sweeps of all solutions that the stage took
    double residual = 0.0;  ///< largest change of a contact velocity in a last iteration [m/s]
    bool converged = true;  ///< residual <= tolerance; of the rest: nor does a contact still close
};

/// The two stages of a step's contacts; keeps its memory between steps, and nothing else.
class ContactSolver {
public:
    /// Impact stage: contacts that meet within the step bounce, on the velocities before the
    /// loads.
    ///
    /// For every contact with gap + dt min(v_r0 . n, 0) <= 1 um (meet_within), accumulated impulses
    /// J_n, J_t with
    ///
    ///     0 <= J_n <= max_impulse,   u = v_r . n + e v_r0 . n:   u >= 0 where J_n = 0,
    ///     u = 0 where 0 < J_n < max_impulse,   u <= 0 where J_n = max_impulse,
    ///     |J_t| <= mu J_n, opposite to the sliding where it is mu J_n
    ///
    /// (equations (6) and (7)).
    ///
    /// A contact that reaches its bound does not rebound (e = 0 for it). With a finite crushing
    /// pressure the stage therefore solves first with e = 0 for all; then with e for the contacts
    /// below their bound, twice at most. A contact that reaches its bound loses e for the step.
    /// Contacts at rest have v_r0 . n = 0 and do not bounce, without any threshold (Guendelman,
    /// Bridson, Fedkiw, ACM TOG 22(3), 2003, section 5).
    ///
    /// Where this would add energy (friction at e near 1) the rebound is weakened: limit_rebound().
    /// Between a ship on a prescribed course and a held floe no impulse moves anything: with a
    /// finite crushing pressure an approaching contact carries its bound and friction, without one
    /// nothing (a jam, see measure_step). Where no contact approaches, the stage does nothing. It
    /// starts from the impulses that the constraints have, zero after build_constraints.
    /// @param dt  time step [s], that of build_constraints
    SolveReport resolve_impacts(Bodies& bodies, std::vector<Constraint>& constraints,
                                const ContactLaw& law, double dt);

    /// Rest stage, after the loads: no contact closes further than its gap,
    /// v_r . n >= -max(gap, 0) / dt, with what the impact stage left of the bound. Starts from
    /// rest_normal and rest_tangent as given (WarmStart::recall).
    ///
    /// Solved for the contacts that the loads close or nearly close; while a solution closes
    /// others, again with them and those it nearly closes. A contact that stays apart carries
    /// nothing, so the conditions of the rest are the same without it. `residual` is the last
    /// solution's; not converged where contacts still close after five.
    /// @param dt  time step [s], that of build_constraints
    /// @pre impact_normal is the impact stage's; constraints ordered by (a, b); no rest_normal
    /// where nothing can move, no rest_tangent where there is no rest_normal
    SolveReport resolve_rest(Bodies& bodies, std::vector<Constraint>& constraints,
                             const ContactLaw& law, double dt);
    /// Constraints that took part in the last rest stage, or, where it did not converge, would
    /// have to; ascending. The others carry nothing in it.
    const std::vector<std::int32_t>& resting() const { return active_; }

private:
    // Sweeps over contacts_ until no velocity changes any more.
    SolveReport iterate(const ContactLaw& law);
    SolveReport solve_impacts(Bodies& bodies, std::vector<Constraint>& constraints,
                              const ContactLaw& law, double restitution);
    SolveReport rebound(Bodies& bodies, std::vector<Constraint>& constraints,
                        const ContactLaw& law);

    // Adds the contacts to active_ that have to take part in the rest stage; are there any new
    // ones? Once there are some, only a contact that closes brings others.
    bool enlist(const Bodies& bodies, const std::vector<Constraint>& constraints, double tolerance,
                double dt);
    void begin_rest(const Bodies& bodies, const std::vector<Constraint>& constraints, double dt);
    void begin_rest_with_guess(Bodies& bodies, std::vector<Constraint>& constraints, double dt);

    ContactRows contacts_;
    ConjugateGradient gradient_;
    ImpactEnergyLimiter limiter_;
    std::vector<std::pair<Vec3, Vec3>> velocities_;  // of the bodies that take part
    std::vector<std::int32_t> meeting_, active_;     // constraints: of the impacts, of the rest
    std::vector<std::uint8_t> is_active_;            // by constraint
};

}  // namespace ice
