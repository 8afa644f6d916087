// SPDX-License-Identifier: GPL-3.0-or-later
/// Bounds of the rule of measure_gap_surface, for those who must agree on them.
#pragma once

namespace ice {

/// Spreads closer than this (in cosine) count as equally flat: normals are stored as floats.
constexpr double kSameSpread = 1e-6;

/// Cosine of the tilt of a face that is met edge first.
constexpr double kLeaning = 0.2;

/// A face cuts into an edge that slants towards it all along; two edges meet where they cross.
constexpr double kSlantOnFace = 0.95, kSlantOnEdge = 0.1;

/// Edges closer to parallel than this (sine) have no normal across both.
constexpr double kParallel = 0.05;

}  // namespace ice
