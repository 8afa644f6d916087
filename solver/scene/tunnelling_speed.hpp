// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/scene/bodies.hpp"

namespace ice {

/// Speed [m/s] at which a body goes the diameter of the smallest contact sphere within a time_step.
///
/// A body's surface is a layer of spheres to others: beyond this speed they may pass through it
/// (tunnel) without having met it.
double tunnelling_speed(const Scene& scene, double time_step);

}  // namespace ice
