// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/narrow/feature/pair_view.hpp"

namespace ice {

/// How far two bodies are apart at least [m]: the widest gap between them along any normal of
/// either one's ConvexBounds (separating axes); negative where none separates them, minus
/// infinity where the bounds of a body are not known. Crushed ice only makes the true distance
/// larger.
///
/// Bodies this far apart have no contact, whatever single spheres measure: a sphere represents its
/// surface within its shape's patch radius, which near an edge ends beyond the body.
double separation(const PairView& view);

/// The separation, or any gap wider than `enough` [m] where there is one: bodies that are apart
/// mostly stay so along the same normal.
/// @param axis  number of the normal to begin with, a's first, then b's; on return the one along
///              which the gap is, where there are any
double separation(const PairView& view, double enough, std::size_t& axis);

/// The separation shrinks by at most this factor [-], at least 1, times the sum of both bodies'
/// paths (MotionBounds::path).
double separation_share(const PairView& view);

}  // namespace ice
