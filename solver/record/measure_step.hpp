// SPDX-License-Identifier: GPL-3.0-or-later
/// A step's impulses as forces of the ice on the ship: impulses over dt.
#pragma once

#include <span>
#include <vector>

#include "solver/contact/constraints.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Impulse of one floe on one region of the hull in a step [N s].
struct RegionImpulse {
    std::int32_t floe, region;     ///< number of the body; row of the hull's region_names
    Vec3 impulse;                  ///< normal and tangential parts [N s]
    Vec3 friction = Vec3::Zero();  ///< the tangential part of it [N s]
};

struct StepRecord {
    Vec3 contact_force = Vec3::Zero();   ///< on the ship, normal parts [N]
    Vec3 friction_force = Vec3::Zero();  ///< on the ship, tangential parts [N]
    double breaking_x = 0.0;             ///< of both along x by floes held until they bend [N]
    Vec3 moment = Vec3::Zero();          ///< on the ship about its mesh origin [N m]
    int contacts = 0;                    ///< that carried an impulse
    double impulse = 0.0;                ///< sum of all contacts' normal impulses [N s]
    int moving_floes = 0;                ///< free floes in the step
    double max_overlap = 0.0;            ///< deepest of all contacts [m], at least 0
    double kinetic_energy = 0.0;         ///< [J]
    std::vector<RegionImpulse> regions;  ///< sorted by floe, region; only with an impulse

    /// Ship contacts that the solver could not stop: the floe is jammed, rigid contact has no
    /// finite force there. The first one's floe, or 0.
    int jammed_contacts = 0;
    std::int32_t jammed_floe = 0;
    Vec3 jam_point = Vec3::Zero();  ///< of that contact, world axes [m]

    double closing_speed = 0.0;                 ///< largest at a contact before impact [m/s]
    std::int32_t closing_a = 0, closing_b = 0;  ///< the bodies that met with it
};

/// Forces on one floe in a step.
struct FloeForces {
    Vec3 contact = Vec3::Zero();   ///< this floe on the ship, normal part [N]
    Vec3 friction = Vec3::Zero();  ///< this floe on the ship, tangential part [N]
    Vec3 ice = Vec3::Zero();       ///< of the other floes on this one [N]
};

/// Sums up a step; zeros for no contacts. @param dt  its length [s], > 0
/// @pre the constraints hold the impulses of the step just done, one for each contact
StepRecord measure_step(const Scene& scene, const std::vector<Contact>& contacts,
                        const std::vector<Constraint>& constraints, double dt);

/// Forces on tracked floes, by one pass over the constraints.
/// @param dt        length of the step [s]
/// @param entry_of  by body, its entry in `out`; -1 for other floes and the ship
/// @param out       its old content is dropped
void measure_floe_forces(const std::vector<Constraint>& constraints, double dt,
                         std::span<const std::int32_t> entry_of, std::span<FloeForces> out);

}  // namespace ice
