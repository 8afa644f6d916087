// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/scene/bodies.hpp"

namespace ice {

/// Speed [m/s] at which a body moves by the diameter of the smallest contact sphere in a time_step.
///
/// A body's surface is a layer of spheres to others: beyond this speed they may pass through it
/// (tunnel) without having met it. The hull's spheres count, too, also in a scene without floes.
/// @param time_step  [s], > 0
double tunnelling_speed(const Scene& scene, double time_step);

}  // namespace ice
