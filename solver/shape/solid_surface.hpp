// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/surface_tree.hpp"

namespace ice {

/// A closed mesh and the tree that finds its point nearest to another one: how deep that one is.
class SolidSurface {
public:
    /// @param mesh  closed and outward oriented, body axes [m]; copied
    explicit SolidSurface(const TriangleMesh& mesh) : mesh_(mesh), tree_(mesh_) {}
    SolidSurface(const SolidSurface&) = delete;  // the tree refers to this mesh
    SolidSurface& operator=(const SolidSurface&) = delete;

    /// The nearest point [m] to p [m], its distance [m], and whether p lies inside; body axes.
    Foot closest(const Vec3& p) const { return tree_.closest(p); }

private:
    TriangleMesh mesh_;
    SurfaceTree tree_;
};

}  // namespace ice
