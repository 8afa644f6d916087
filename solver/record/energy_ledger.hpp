// SPDX-License-Identifier: GPL-3.0-or-later
/// Where the ship's work goes: every joule given to the ice is booked once.
#pragma once

#include <optional>
#include <vector>

#include "common/formats/summary_file.hpp"
#include "solver/case/case.hpp"
#include "solver/contact/solve_contacts.hpp"
#include "solver/integrate/integrate.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Sums since the start of the run [J], in 2D per metre of breadth. With dK and dU the changes of
/// kinetic and potential energy of the floes,
///
///     ship_work + separation = dK + dU + friction + restitution + crushing + drag
///                            + buoyancy_moment + residual.
///
/// What each holds, J_c being the impulse of contact c on body b in one of the two solver stages
/// and V = (v_r before + v_r after the stage) / 2 the mean of its relative velocity:
///
///     ship_work        sum of J_c . v_ship over the ship's contacts
///     friction         -J_t . V
///     crushing         -J_n n . V where the contact is at its strength
///     restitution      -J_n n . V elsewhere: what a plastic or partly elastic impact takes
///     drag             -(F . v + T . w) dt, v and w the means of before and after the loads
///     separation       put in by the moves that open overlaps, to first order in the moves
///     buoyancy_moment  buoyancy "centre" only: work of the moment that this model leaves out,
///                      without which weight and buoyancy have no potential
///
/// The impulses' part is an identity, for any impulses: velocities are linear in them, so a
/// stage's dK is sum J_c . V plus the ship's work (and the loads' work where they act in the same
/// stage). What is left, the residual, is the finite step of the motion between impulses:
/// of first order in time_step at impacts under load, of second order elsewhere.
struct EnergyLedger {
    double ship_work = 0.0;
    double kinetic = 0.0;  ///< change of kinetic energy over all steps
    double friction = 0.0, restitution = 0.0, crushing = 0.0, drag = 0.0;
    double separation = 0.0;
    double buoyancy_moment = 0.0;
    std::optional<double> potential_start;  ///< before the first step

    /// Energy at the end that the books do not explain, given the potential energy there.
    double residual(double potential_now) const;
};

/// Velocities of all bodies at one moment of a step.
struct Velocities {
    std::vector<Vec3> linear, angular;  ///< [m/s], [rad/s]
    void take(const Bodies& bodies);
};

/// What the ledger needs to know of a step. All of it is that of the poses before they advance.
struct StepBooks {
    double kinetic = 0.0;  ///< kinetic energy at the start, after floes were released [J]
    Velocities start;      ///< after floes were released
    Velocities collided;   ///< after the impact stage, before the loads
};

/// Books one step. The bodies have their velocities at the step's end and their poses before them.
void book_step(const Scene& scene, const Case& parameters,
               const std::vector<Constraint>& constraints, const std::vector<FloeLoad>& loads,
               const Nudges& nudges, const StepBooks& books, EnergyLedger& ledger);

/// Fills Summary::energy and warns where the residual is above its limit.
void fill_energy(const EnergyLedger& ledger, double potential_now, Summary& summary);

}  // namespace ice
