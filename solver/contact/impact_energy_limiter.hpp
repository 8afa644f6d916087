// SPDX-License-Identifier: GPL-3.0-or-later
/// Restitution that adds no energy: docs/method.md, section 4.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/contact/contact_rows.hpp"

namespace ice {

/// Bounds the energy of the impact stage, equation (8); keeps its memory between steps. Calls in
/// this order: begin(), energy_gain(); where that is above 0, set_aside(), limit_rebound().
class ImpactEnergyLimiter {
public:
    /// Before the impacts. @param which  constraints that take part; the others have no impulse
    /// @pre contacts was built for these
    void begin(const Bodies& bodies, const ContactRows& contacts,
               const std::vector<Constraint>& constraints, const std::vector<std::int32_t>& which);

    /// Energy [J] that the impacts put into the floes beyond the ship's work, largest of all
    /// islands (floes connected by such contacts); at most 0 for impacts that only lose energy, 0
    /// for no contacts.
    ///
    /// With v_r at the constraints at the beginning and now, the sum of
    /// J . (v_r before + v_r now) / 2 over an island's constraints.
    double energy_gain(const Bodies& bodies, const ContactRows& contacts,
                       const std::vector<Constraint>& constraints);

    /// Keeps the solution with rebound and restores the start.
    void set_aside(Bodies& bodies, const ContactRows& contacts,
                   std::vector<Constraint>& constraints);

    /// Takes as much of the rebound away as keeps every island from gaining energy.
    ///
    /// Newton's restitution fixes normal speeds whatever work friction does meanwhile, and may add
    /// energy in oblique impacts (Kane and Levinson, Dynamics, 1985). The solution without rebound
    /// never does, and any mixture of the two keeps contacts closed, cones and bounds: per island
    ///
    ///     J = J_plastic + s (J_rebound - J_plastic),   s in [0, 1] the largest with gain <= 0.
    ///
    /// Islands meet at the ship only. If it is free, the mixture is one to the
    /// order of the floes' mass over the ship's.
    ///
    /// On entry bodies and constraints hold the solution without rebound, on return the mixture.
    /// @pre set_aside was called with the other one
    void limit_rebound(Bodies& bodies, const ContactRows& contacts,
                       std::vector<Constraint>& constraints);

private:
    /// Velocities of the touched bodies [m/s], [rad/s], by local number, and impulses of which_
    /// [N s].
    struct State {
        std::vector<Vec3> velocity, angular_velocity, tangent;
        std::vector<double> normal;
    };
    void save(const Bodies& bodies, const ContactRows& contacts,
              const std::vector<Constraint>& constraints, State& out) const;
    void find_islands(const Bodies& bodies, const ContactRows& contacts,
                      const std::vector<Constraint>& constraints);
    std::int32_t island_of(const Bodies& bodies, const ContactRows& contacts,
                           const Constraint& c) const;
    void mix_ship(Bodies& bodies, const ContactRows& contacts,
                  const std::vector<Constraint>& constraints) const;
    // Per island: the gain of energy of impulses J that lead from the beginning to `end` [J].
    void measure_gains(const Bodies& bodies, const ContactRows& contacts,
                       const std::vector<Constraint>& constraints, const State& end,
                       std::vector<double>& out) const;

    std::vector<std::int32_t> which_;
    State start_, rebound_, plastic_, now_;
    std::vector<std::int32_t> islands_;  // per touched body: the smallest local number in it
    std::vector<double> gains_, at_zero_, at_half_, at_one_;  // per touched body
};

}  // namespace ice
