// SPDX-License-Identifier: GPL-3.0-or-later
/// Faults of a case before its first step: overlapping bodies, time steps that are too long.
#pragma once

#include <vector>

#include "common/formats/warning.hpp"
#include "solver/step/step.hpp"

namespace ice {

/// Two bodies that share room at the start; a < b, so the hull is a = 0.
struct StartOverlap {
    std::int32_t a, b;
    double depth;              ///< of one below the surface of the other, about [m]
    Vec3 point;                ///< where it is deepest, world axes [m]
    std::int32_t inside = -1;  ///< the body that lies wholly inside the other one; -1: neither
};

/// All pairs of bodies that overlap by more than kToleratedOverlap, the deepest first. The spheres
/// add nothing to it: they stay within their solid to 1e-6 of the radius.
///
/// Surfaces are compared as in a step, and the solids as a run checks them
/// (record/solid_overlap.hpp), since a body deep inside another one meets no surface there. Floes
/// that are held count, too; unbroken ice (hold "always") may overlap unbroken ice.
/// @param scene  unchanged at the end
std::vector<StartOverlap> find_start_overlaps(Scene& scene, const Case& parameters);

/// Looks at a world that was just built.
/// @return warnings: the ship or a floe is faster than tunnelling_speed; spheres farther apart than
///         kWidestSpacing, with the rule "centres" than they are wide; part of the hull in the ice
///         belt that no sphere represents; overlaps, where allowed; those of check_sheet()
/// @throws Error (exit code 2) naming the bodies that overlap, how deep and where, unless
///         `allow_overlap`; of check_sheet()
std::vector<Warning> check_start(World& world, bool allow_overlap);

}  // namespace ice
