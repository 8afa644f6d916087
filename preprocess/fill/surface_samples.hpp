// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A small piece of the surface.
struct SurfaceSample {
    Vec3 point;             ///< its centre [m]
    Vec3 normal;            ///< outward, unit
    double area;            ///< [m2]; the samples' areas sum to the surface's
    std::int32_t triangle;  ///< row of the mesh
};

/// Cuts triangles into small pieces of about `size` [m], one triangle at a time, so that the
/// samples of a large surface never are in memory together.
///
/// A triangle is cut into strips along its longest edge and each strip into equal pieces: slender
/// triangles get no more pieces than their area needs. In 2D the flat ends of the prism (normal
/// along y) have no samples and the pieces are strips across the breadth, centres in y = 0.
class SurfaceSampler {
public:
    /// @param half  leave out samples with y < 0 (a solid that is its own mirror image): those in
    ///              y = 0 count half
    SurfaceSampler(const TriangleMesh& mesh, double size, int dimension, bool half = false)
        : mesh_(mesh), size_(size), dimension_(dimension), half_(half) {}

    /// Replaces `out` by the samples of one triangle.
    void sample(std::size_t triangle, std::vector<SurfaceSample>& out) const;

    std::size_t triangle_count() const { return mesh_.triangles.size(); }

private:
    void add_strips(std::size_t triangle, std::vector<SurfaceSample>& out) const;
    void add_section(std::size_t triangle, std::vector<SurfaceSample>& out) const;

    const TriangleMesh& mesh_;
    double size_;
    int dimension_;
    bool half_;
};

}  // namespace ice
