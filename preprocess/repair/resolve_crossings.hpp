// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A surface that crosses itself -> the boundary of its inside.
///
/// Triangles that cross are cut where they meet (cut_faces), and a piece stays where the winding
/// number is positive on one side of it and not on the other: a mesh arrangement (Zhou et al.,
/// "Mesh arrangements for solid geometry", ACM TOG 35(4), 2016). Parts that overlap or touch become
/// one, sheets inside and folds that are inside out go. Everything else keeps its vertices bit for
/// bit, its order and its region. Edges of more than two triangles are separated.
///
/// @param mesh   without boundary as a chain (close_surface), parts facing outwards
/// @param pairs  its crossing triangles (find_self_intersections)
/// @return nothing where the pieces do not make a closed surface. Cost O(T log T) and that of
///         cut_faces.
std::optional<TriangleMesh> resolve_crossings(
    const TriangleMesh& mesh, const std::vector<std::pair<std::size_t, std::size_t>>& pairs);

}  // namespace ice
