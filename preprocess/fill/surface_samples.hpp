// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A small piece of the surface.
struct SurfaceSample {
    Vec3 point;   ///< its centre [m]
    Vec3 normal;  ///< outward, unit
    double area;  ///< [m2]; the samples' areas sum to the surface's
    std::int32_t triangle;
};

/// Cuts every triangle into equal small ones of edges about `size` [m], two million at most in all.
/// In 2D the flat ends of the prism (normal along y) are left out and the pieces are strips across
/// the breadth, with centres in the plane y = 0.
std::vector<SurfaceSample> sample_surface(const TriangleMesh& mesh, double size, int dimension);

}  // namespace ice
