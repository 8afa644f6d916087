// SPDX-License-Identifier: GPL-3.0-or-later
/// The output of the narrow phase and input of the contact solver.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "common/geometry/triangle_mesh.hpp"
#include "solver/narrow/manifold/patch.hpp"

namespace ice {

/// A place where two bodies touch or may touch within the step. Lists of contacts are ordered by
/// (a, b), within a pair by place (ContactFinder): results depend on that order.
struct Contact {
    std::int32_t a, b;  ///< bodies, a < b; a = 0 is the ship
    /// Contact spheres of their shapes. Where solids meet: -1; of the ship the nearest sphere, for
    /// which the load is recorded.
    std::int32_t sphere_a, sphere_b;
    /// The same contact of a pair has it in the next step, too. The solver begins with the impulse
    /// that this contact had in the last step.
    std::uint64_t key;
    Vec3 point;           ///< midway between the surfaces, world axes [m]
    Vec3 normal;          ///< unit, from a to b
    double gap;           ///< [m], negative where the surfaces overlap
    Patch patch;          ///< of spheres: what presses here, A of (13) by depth
    std::int32_t region;  ///< row of the hull's region_names; -1 between floes
    bool crushes_a;       ///< if ice is crushed here: true where it is a's, false: b's
    /// Of solids: what presses here, A of (13) [m2]; infinite where they are not crushed.
    double section = std::numeric_limits<double>::infinity();

    /// Do solids meet? Ice that meets as a solid has no sphere.
    bool is_of_solids() const { return sphere_b < 0; }
};

/// Gaps that differ by less are equal [m]. The solver and rounding leave surfaces that rest on each
/// other with gaps of either sign. At a tolerance of 0 this sign decides which contacts take part
/// in an impact. Larger values let floes bounce before they touch.
inline constexpr double kSameGap = 1e-6;

/// Do surfaces meet within a step?
/// @param gap       now [m], negative where they overlap
/// @param approach  its rate [m/s], negative where it closes
/// @param dt        the step [s]
inline bool meet_within(double gap, double approach, double dt) {
    return gap + dt * std::min(approach, 0.0) <= kSameGap;
}

}  // namespace ice
