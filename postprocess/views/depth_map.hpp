// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "postprocess/views/faces.hpp"
#include "postprocess/views/projection.hpp"

namespace ice::views {

/// Nearest surface of a body per picture cell: shows which floes are in front of the hull.
///
/// A painter's sort by centres fails between a long hull and small floes; comparing a floe with the
/// hull at its own place does not.
class DepthMap {
public:
    /// Rasters the mesh [m] with `columns` cells along the longer side of its projected box; an
    /// empty mesh covers nothing.
    DepthMap(const TriangleMesh& mesh, const Projection& projection, int columns);

    /// Nearness of the surface [m] at a place on the page [m]: larger is nearer to the viewer;
    /// -infinity where the body is not.
    double nearness(double right, double up) const;
    /// Row of the triangle that is seen at a place on the page [m]; none where the body is not.
    std::optional<std::size_t> triangle(double right, double up) const;

private:
    void draw(std::size_t triangle, const Vec3& a, const Vec3& b, const Vec3& c);
    std::optional<std::size_t> cell(double right, double up) const;

    int columns_ = 0, rows_ = 0;
    double cell_ = 1.0, right0_ = 0.0, up0_ = 0.0;
    std::vector<double> nearest_;
    std::vector<std::size_t> triangle_;  // where nearest_ is finite
};

}  // namespace ice::views
