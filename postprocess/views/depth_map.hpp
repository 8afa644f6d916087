// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "postprocess/views/faces.hpp"
#include "postprocess/views/projection.hpp"

namespace ice::views {

/// Nearest surface of a body per picture cell: tells which floes are in front of the hull.
///
/// A painter's sort by centres fails between a long hull and small floes; comparing a floe with the
/// hull at its own place does not.
class DepthMap {
public:
    /// Rasters the mesh with `columns` cells along the longer side of its projected box; an empty
    /// mesh covers nothing.
    DepthMap(const TriangleMesh& mesh, const Projection& projection, int columns);

    /// Nearness of the surface at a place on the page [m]; -infinity where the body is not.
    double nearness(double right, double up) const;

private:
    void draw(const Vec3& a, const Vec3& b, const Vec3& c);

    int columns_ = 0, rows_ = 0;
    double cell_ = 1.0, right0_ = 0.0, up0_ = 0.0;
    std::vector<double> nearest_;
};

}  // namespace ice::views
