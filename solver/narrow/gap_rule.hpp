// SPDX-License-Identifier: GPL-3.0-or-later
/// Bounds of the rule of measure_gap_surface, for those who must agree on them.
#pragma once

#include "solver/narrow/measure_gap.hpp"

namespace ice {

/// Spreads closer than this (in cosine) count as equally flat: normals are stored as floats.
constexpr double kSameSpread = 1e-6;

/// Cosine of the tilt of a face that is met edge first.
constexpr double kLeaning = 0.2;

/// A face cuts into an edge that slants towards it all along; two edges meet where they cross.
constexpr double kSlantOnFace = 0.95, kSlantOnEdge = 0.1;

/// Edges closer to parallel than this (sine) have no normal across both.
constexpr double kParallel = 0.05;

/// Squared distance [m2] across n from the part of the surface that `s` stands for to a probe's
/// point. An edge's sphere stands for the face from above its centre out to the corner, and for
/// nothing beyond: there the other body's edge has nothing under it. Infinite beyond, by more than
/// `slack` [m]. @param edges  both spheres are edges or corners
double distance_across(const SphereSurface& s, const Vec3& n, const Vec3& probe, bool edges,
                       double slack = 0.0);

}  // namespace ice
