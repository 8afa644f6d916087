// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "common/formats/sphere_set.hpp"
#include "preprocess/field/outline.hpp"

namespace ice {

/// How a floe is made from its outline: a slab of ice with contact spheres.
struct PrismSpec {
    double thickness, chamfer;  ///< [m]
    double radius, spacing;     ///< of the spheres [m]
    bool surface_only = true;
};

/// A floe as a closed solid (make_prism) filled with spheres (fill_spheres), in the axes of its
/// outline, z = 0 midway.
///
/// The solver cuts pieces from level ice with it while it runs: no file, no CGAL in its headers.
///
/// @param corners  where given, becomes the count of corners, each with a sphere of its own
/// @throws Error (exit code 2) when no sphere fits, or a corner gets none
SphereSet fill_prism(const Outline& outline, const PrismSpec& spec,
                     std::int64_t* corners = nullptr);

/// The sphere set of a floe in 2D: the section `length` x `spec.thickness` [m] filled with discs
/// (fill_discs), about its centre. The chamfer is left out.
///
/// @throws Error (exit code 2) when no disc fits
SphereSet fill_strip(double length, const PrismSpec& spec);

}  // namespace ice
