// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/narrow/feature/pair_view.hpp"

namespace ice {

/// Limits the depth of candidates by the meshes, where not both solids are convex.
///
/// measure_gap_surface uses the faces that meet at two spheres, not the solids: behind two planes
/// that cross far away a point may seem to be deep although it lies outside, or near another face.
/// For each candidate deeper than deep_slack [m]:
/// - on a face, the incident support point is as deep in the other body as its shortest way out of
///   that body's ice is long (way_out), less its own distance outside of its own body: a mesh or a
///   notch cuts off tips of edges and corners. The contact is no deeper;
/// - across two edges, the point midway between them must lie in both bodies. Each edge's point
///   nearest to the other edge bounds the depth likewise, by sqrt(2) times as much: behind a
///   right-angled edge the faces are nearer by this factor.
/// Candidates without depth are dropped; find_deep_seats finds where such bodies meet. 2D and two
/// convex solids, whose separating axis gives their depth, are left as they are, and so are
/// candidates that are less deep, and an empty list. The order is kept.
///
/// @param candidates  of the pair; their gaps may grow, none becomes deeper
void check_depths(const PairView& view, std::vector<Candidate>& candidates);

}  // namespace ice
