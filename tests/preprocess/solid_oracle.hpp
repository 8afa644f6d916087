// SPDX-License-Identifier: GPL-3.0-or-later
/// Inside tests and distances by CGAL, independent of SurfaceTree.
#pragma once

#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice::test {

struct OracleAnswer {
    bool inside;      ///< strictly inside the solid, exact predicates
    double distance;  ///< to the surface [m]
};

std::vector<OracleAnswer> ask_oracle(const TriangleMesh& mesh, const std::vector<Vec3>& points);

}  // namespace ice::test
