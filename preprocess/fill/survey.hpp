// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/formats/sphere_set.hpp"
#include "common/geometry/surface_tree.hpp"
#include "preprocess/fill/point_cells.hpp"
#include "preprocess/fill/surface_samples.hpp"

namespace ice {

/// The surface spheres at one surface sample.
struct Sight {
    double area = 0.0;           ///< that the sample represents [m2]
    float gap = 0.0f;            ///< distance to the sphere it belongs to [m], >= 0
    float cover = -1.0f;         ///< from where a sphere would touch at the sample to the nearest
                                 ///< centre that covers it [m]; -1 where none can touch
    float normal_error = -1.0f;  ///< between the surface's normal and the nearest sphere's [rad];
                                 ///< -1 where none can touch or that sphere is in an edge
    std::int32_t owner = -1;     ///< surface sphere that the sample belongs to
    std::int32_t triangle = -1;  ///< row of the mesh; -1: none
    Eigen::Vector3f point = Eigen::Vector3f::Zero();  ///< [m]
};

/// Finds the surface spheres of a set that represent a piece of surface: their normal agrees
/// with the surface's (kFaceTurn, plus the spread in edges). Thread-safe.
class SphereFinder {
public:
    /// @pre set.centers, surface_count, normals and normal_spread are set; the set outlives this
    explicit SphereFinder(const SphereSet& set);

    /// Nearest sphere of any normal. `known`: one that is thought to be near, or -1.
    PointCells::Nearest nearest(const Vec3& p, std::int32_t known = -1) const;

    /// Nearest sphere that agrees with `normal`; where none does within two spacings of `any`, or
    /// `any` is eight spacings away (a part without spheres), the nearest of any normal, `any`.
    PointCells::Nearest agreeing(const Vec3& p, const Vec3& normal,
                                 const PointCells::Nearest& any) const;

    /// Nearest sphere that covers surface of this normal: it represents surface that does not
    /// face the other way (its normal is at most a right angle off, plus the spread), so that the
    /// spheres round an edge cover each other's faces and those behind a thin plate do not. Where
    /// none does within two spacings of `any`, `any`.
    PointCells::Nearest covering(const Vec3& p, const Vec3& normal,
                                 const PointCells::Nearest& any) const;

private:
    template <class Accept>
    PointCells::Nearest nearest_of(const Vec3& p, const PointCells::Nearest& any,
                                   const Accept& accept) const;
    bool agrees(std::int32_t sphere, const Vec3& normal) const {
        const auto k = static_cast<std::size_t>(sphere);
        return set_.normals[k].dot(normal) >= least_[k];
    }
    bool covers(std::int32_t sphere, const Vec3& normal) const;

    const SphereSet& set_;
    PointCells cells_;
    std::vector<double> least_;
};

/// Looks at the set from samples all over the surface, in triangle order. A sample belongs to the
/// sphere nearest to where a touching sphere would sit (point - R normal), among the spheres that
/// represent its face, so that the spheres of one face take no area of another round an edge.
///
/// @param half  sample only y >= 0 (solid and set are their own mirror images)
/// @param shares_only  from fewer samples, which tell area, owner, gap and place only
/// @pre as for SphereFinder
std::vector<Sight> survey_surface(const SurfaceTree& tree, const SphereSet& set,
                                  const SphereFinder& finder, bool half, bool shares_only = false);

/// Edge of the surface pieces that survey_surface samples [m]: a quarter of the spacing, more
/// where that would be over one and a half million of them.
double survey_size(const SphereSet& set, bool half);

}  // namespace ice
