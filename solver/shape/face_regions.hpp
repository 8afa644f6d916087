// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/formats/sphere_set.hpp"

namespace ice {

/// The regions of the faces that surface spheres represent, to enter contacts for.
///
/// Most spheres have one region, that of the mesh around them. One beside a border of regions, in
/// an edge or near its end, represents faces of both: the contact's normal decides which of them
/// it presses. Faces are the mesh's triangles up to half a spacing farther from the sphere's centre
/// than its radius.
class FaceRegions {
public:
    FaceRegions() = default;
    /// Copies its input. Costs as much as triangles plus spheres, not their product.
    explicit FaceRegions(const SphereSet& set);

    /// Row of the set's region_names: that of the sphere's face whose normal is nearest to n (unit,
    /// outward, the set's axes), and of faces in one plane the nearest to the sphere. So a push
    /// between the normals of two faces that meet in an edge counts for one of them, whole. Without
    /// borders nearby it is of_spheres()'s.
    std::int32_t at(std::int32_t sphere, const Vec3& n) const;

    /// Where most of each surface sphere's area lies.
    const std::vector<std::int32_t>& of_spheres() const { return of_sphere_; }

private:
    struct Face {
        Vec3 normal;
        std::int32_t region;
    };
    std::vector<std::int32_t> of_sphere_;
    std::vector<Face> faces_;         // by sphere, near ones first; only beside borders
    std::vector<std::size_t> first_;  // of faces_, by sphere, and the end; empty: there are none
};

}  // namespace ice
