// SPDX-License-Identifier: GPL-3.0-or-later
/// The energy ledger: every joule that the ship gives to the ice is entered once.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/formats/summary_file.hpp"
#include "solver/case/case.hpp"
#include "solver/contact/overlaps.hpp"
#include "solver/loads/load_floes.hpp"
#include "solver/loads/potential_energy.hpp"
#include "solver/scene/step_start.hpp"

namespace ice {

/// Sums since the start of the run [J], in 2D per metre of breadth. With dK and dU the changes of
/// kinetic and potential energy of the floes,
///
///     ship_work + drift_work + separation + water_work + applied_work
///         = dK + dU + friction + restitution + crushing + breaking + drag + buoyancy_moment
///           + residual.
///
/// The terms, J_c being the impulse of contact c on body b in a step and
/// V = (v_r at its start + v_r at its end) / 2 the mean of the contact's relative velocity:
///
///     ship_work        sum of J_c . v_ship over the ship's contacts; of a free ship, the
///                      mean of its velocities there at the step's start and end
///     drift_work       sum of J_c . v over the contacts of held ice that drifts at v
///     friction         -J_t . V
///     crushing         -J_n n . V where the contact is at its bound
///     restitution      -J_n n . V elsewhere: the loss of a plastic or partly elastic impact
///     breaking         -(J_n n + J_t) . V instead of the three where the ship presses on a floe
///                      that is held until it bends: crushing and friction before it breaks off
///     drag             -(F . v + T . w) dt, v and w the means of start and end, and the first
///                      part of water_work
///     water_work       dt times the drag's work on the water's own motion, and the work of the
///                      flow's pressure: 0 in water at rest
///     applied_work     (F . v + T . w) dt of the caller's own loads
///     separation       put in by the moves that open overlaps, to first order in the moves
///     buoyancy_moment  buoyancy "centre" only: work of the moment that this model leaves out,
///                      without which weight and buoyancy have no potential
///
/// Velocities are linear in impulses and loads, so that for any of them, exactly,
///
///     dK = sum J_c . V + ship_work + drift_work + dt sum (F . v + T . w)   in every step.
///
/// (equations (19) and (20)). A floe at rest under load adds nothing to the ledger. The residual is
/// what weight and buoyancy do by this sum less what they do by -dU. Their force at the pose
/// between two steps acts on the mean of both steps' motions, the trapezoidal rule, so the residual
/// is of second order in time_step. With the means over the impact stage alone instead, as first
/// tried, every impact under load leaves dt F . (change of v) / 2: 0.8 % of the ship's work in the
/// paper's 2D case at 0.5 m/s.
struct EnergyLedger {
    double ship_work = 0.0, drift_work = 0.0;
    double kinetic_change = 0.0;  ///< of the floes, over all steps
    double friction = 0.0, restitution = 0.0, crushing = 0.0, breaking = 0.0, drag = 0.0;
    double water_work = 0.0, applied_work = 0.0;
    double separation = 0.0;
    double buoyancy_moment = 0.0;
    std::optional<double> potential_start;  ///< before the first step [J]; none before begin()

    /// Before each step; the first one takes the potential energy.
    void begin(const Scene& scene, const Case& parameters);
    /// Energy at the end that the ledger does not explain, given the potential energy there [J].
    double residual(double potential_now) const;
};

/// Enters one step. The bodies have their velocities at the step's end and their poses before them.
void enter_step(const Scene& scene, const Case& parameters,
                const std::vector<Constraint>& constraints, const std::vector<FloeLoad>& loads,
                const PositionCorrections& corrections, const StepStart& start,
                EnergyLedger& ledger);

/// Fills Summary::energy, and warns where more than 0.5 % of the ship's work, or of the losses
/// where they are larger, is not explained. @param potential_now  at the end [J]
void fill_energy(const EnergyLedger& ledger, double potential_now, Summary& summary);

}  // namespace ice
