// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "preprocess/fill/offset_surface.hpp"

namespace ice {

/// On a solid that is its own mirror image across y = 0: brings a seat into the half y >= 0 and,
/// where it would lie nearer than `gap` [m] to the centre plane (and so to its own image), into
/// that plane. Nothing where it must move there but cannot: the surface lies along the plane.
std::optional<Seat> mirror_seat(const SurfaceTree& tree, Seat seat, double radius, double gap);

/// The mirror image of a seat across y = 0. Its triangle is that of the original, its touches are
/// unknown.
Seat image_of(const Seat& seat);

}  // namespace ice
