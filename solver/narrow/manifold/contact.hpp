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
    std::int32_t a, b;                ///< bodies, a < b; a = 0 is the ship
    std::int32_t sphere_a, sphere_b;  ///< surface spheres of their shapes; -1 where solids meet
    std::uint64_t key;                ///< the same contact of a pair keeps it in the next step
    Vec3 point;                       ///< midway between the surfaces, world axes [m]
    Vec3 normal;                      ///< unit, from a to b
    double gap;                       ///< [m], negative where the surfaces overlap
    Patch patch;                      ///< the surface that presses here, for the bound (13)
    std::int32_t region;              ///< row of the hull's region_names; -1 between floes
    bool crushes_a;                   ///< the ice that is crushed is a's; else b's
    /// Of solids that can be crushed: the section that presses here, A of (13) [m2].
    double section = std::numeric_limits<double>::infinity();

    /// Do solids meet? They have no spheres.
    bool is_of_solids() const { return sphere_a < 0; }
};

/// Gaps that differ by less are equal [m]. Surfaces that rest on each other have gaps of either
/// sign, which are what the solver and rounding left: without this rounding decides which of them
/// take part in an impact. Larger values let floes bounce before they touch.
inline constexpr double kSameGap = 1e-6;

/// Do surfaces meet within a step?
/// @param gap       now [m], negative where they overlap
/// @param approach  its rate [m/s], negative where it closes
/// @param dt        the step [s]
inline bool meet_within(double gap, double approach, double dt) {
    return gap + dt * std::min(approach, 0.0) <= kSameGap;
}

}  // namespace ice
