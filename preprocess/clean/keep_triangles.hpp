// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Keeps the triangles whose entry in `keep` is not zero, in order, and the vertices they use, in
/// the order of their first use. `keep` has one entry per triangle; region names stay.
void keep_triangles(TriangleMesh& mesh, const std::vector<std::uint8_t>& keep);

}  // namespace ice
