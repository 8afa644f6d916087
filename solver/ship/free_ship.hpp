// SPDX-License-Identifier: GPL-3.0-or-later
/// The ship of a run: on its prescribed course, or free (docs/method.md, section 13).
#pragma once

#include <optional>

#include "common/base/assert.hpp"
#include "solver/contact/overlaps.hpp"
#include "solver/ship/ship_loads.hpp"

namespace ice {

class CheckpointFile;

/// The energy ledger of a free ship, in its free motions, since the start [J]:
///
///     thrust + tow + mooring + separation = ice + losses + dK + dU + residual,
///
/// each the force times the mean of the velocities at a step's start and end; U of weight and
/// water. The residual is of second order in the time step.
struct ShipEnergies {
    double thrust = 0.0, tow = 0.0, mooring = 0.0;  ///< work on the ship
    double ice = 0.0;                               ///< work of the ship on the ice
    double losses = 0.0;                            ///< open-water resistance and damping
    double separation = 0.0;                        ///< put in by the moves that open overlaps
    std::optional<double> kinetic_start, potential_start;  ///< before the first step

    /// Energy that the ledger does not explain [J]. @param gained  dK + dU [J]
    double residual(double gained) const {
        return thrust + tow + mooring + separation - ice - losses - gained;
    }
};

/// Forces change the motions that are free; the others keep to Case::ship_speed.
///
/// The motion is that of the centre of gravity, with the matrix of mass and added mass
/// (docs/method.md, section 13): symplectic Euler as for floes, linear damping at the middle of the
/// step. Added mass turns with the ship; what that does to a turning ship's velocity (Munk's
/// moment) is left out. With no freedom nothing differs from a body that moves as prescribed.
class FreeShip {
public:
    /// Puts the ship where it floats, with masses. Once; nothing to do for a prescribed course.
    /// @throws Error (exit code 2) as make_ship_rig
    void begin(const Case& parameters, Scene& scene);
    /// Puts it into another attitude, its centre of gravity over the same point. @pre it is free
    /// @param height  of the mesh's origin [m]
    void place(Scene& scene, double height, const ShipAngles& angles);
    bool is_free() const { return rig_.has_value(); }
    /// @pre it is free
    const ShipRig& rig() const {
        ICE_ASSERT(is_free());
        return *rig_;
    }

    /// Beginning of a step: prescribed velocities, and the ship's response to impulses in it.
    /// @param time  at the start of the step [s]
    void start_step(const Case& parameters, Scene& scene, double time);
    /// Loads change the velocity over a time_step. @param time  at the start of the step [s]
    void apply_loads(const Case& parameters, Scene& scene, double time);
    /// Enters a step of dt [s] in energies(), before the poses advance.
    void enter_step(const Scene& scene, const std::vector<Constraint>& constraints,
                    const PositionCorrections& corrections, double dt);
    /// Turns the ship, after its place has advanced with its velocity, and moves it by its position
    /// correction. @param dt  [s]
    void turn(Scene& scene, const PositionCorrections& corrections, double dt);

    const ShipLoads& loads() const { return loads_; }  ///< of the last step
    /// Roll, pitch and yaw now [rad]; zero on a prescribed course.
    const ShipAngles& angles() const { return angles_; }
    const ShipEnergies& energies() const { return energies_; }
    /// Velocity of the centre of gravity [m/s] and spin about it [rad/s], at the start of the last
    /// step.
    const Vec3& velocity_start() const { return velocity_start_; }
    const Vec3& spin_start() const { return spin_start_; }
    /// Kinetic energy of ship and added mass in the free motions [J]; 0 on a prescribed course.
    double kinetic_energy(const Bodies& bodies) const;
    /// Potential energy of weight and water [J]; 0 where the ship is held upright and at its
    /// height.
    double potential_energy(const Scene& scene, const Case& parameters) const;

    /// Writes or sets its state, by the file's direction.
    void carry(CheckpointFile& file);

private:
    ShipState state_of(const Bodies& bodies, double time) const;
    void add_damping(const Case& parameters, Scene& scene);

    std::optional<ShipRig> rig_;
    bool begun_ = false;
    ShipLoads loads_;
    Vec3 velocity_start_ = Vec3::Zero(), spin_start_ = Vec3::Zero();  // of the step

    // state
    ShipAngles angles_ = ShipAngles::Zero();
    Vec3 velocity_ = Vec3::Zero(), spin_ = Vec3::Zero();  // at the end of the last step
    double speed_error_ = 0.0;                            // int (hold_speed - U) dt [m]
    ShipEnergies energies_;
};

}  // namespace ice
