// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Gives sheets that meet in an edge of more than two triangles vertices of their own, so that each
/// edge has two triangles again. Triangles of opposite direction are paired, those of one part
/// first, then those with the smallest angle between them; vertices in which only a point is
/// shared part as well. Coordinates stay. A mesh without such edges is left as it is.
/// @return edges separated. @pre the mesh is welded and its faces are oriented
std::int64_t separate_sheets(TriangleMesh& mesh);

}  // namespace ice
