// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shape/face_regions.hpp"

#include <algorithm>

#include "common/geometry/closest_on_triangle.hpp"
#include "solver/shape/sphere_grid.hpp"

namespace ice {

namespace {

// Normals of one region this near (cosine [-]; 2.6 degrees) are one face's: curved hulls have many.
// Larger stores more faces for a sphere, with the same results; smaller may miss a border.
constexpr double kSameRegionNormal = 0.999;

// A face whose normal is nearer by less than this (cosine [-]) lies in the same plane: the nearer
// face counts. Smaller lets rounding choose between two regions of a flat side.
constexpr double kSameRegionPlane = 1e-6;

struct NearFace {
    double distance_sq;  // from the sphere's centre [m2]
    Vec3 normal;
    std::int32_t region;
};

// Calls visit(sphere, triangle, distance_sq) for the triangles within each sphere's reach.
template <class Visit>
void for_each_near(const SphereSet& set, const SphereGrid& grid, double largest,
                   const Visit& visit) {
    for (std::size_t t = 0; t < set.mesh.triangles.size(); ++t) {
        const Vec3 a = set.mesh.corner(t, 0), b = set.mesh.corner(t, 1), c = set.mesh.corner(t, 2);
        Eigen::AlignedBox3d box(a);
        box.extend(b).extend(c);
        const double range = 0.5 * box.sizes().maxCoeff() + largest + 0.5 * set.spacing;
        grid.for_each_near(box.center(), range, [&](std::int32_t sphere) {
            const auto k = static_cast<std::size_t>(sphere);
            const double reach = set.radii[k] + 0.5 * set.spacing;
            if (box.squaredExteriorDistance(set.centers[k]) > reach * reach) return;
            const double distance_sq =
                (closest_on_triangle(set.centers[k], a, b, c).point - set.centers[k]).squaredNorm();
            if (distance_sq <= reach * reach) visit(k, t, distance_sq);
        });
    }
}

// Adds a face, or makes it nearer where it is known.
void note(const NearFace& face, std::vector<NearFace>& faces) {
    for (NearFace& known : faces) {
        if (known.region != face.region || known.normal.dot(face.normal) < kSameRegionNormal)
            continue;
        if (face.distance_sq < known.distance_sq) known = face;
        return;
    }
    faces.push_back(face);
}

}  // namespace

FaceRegions::FaceRegions(const SphereSet& set) : of_sphere_(set.regions) {
    if (set.mesh.region_names.size() < 2) return;
    const std::size_t count = set.surface_count;
    const double largest = *std::max_element(set.radii.begin(), set.radii.end());
    const SphereGrid grid(std::span(set.centers).first(count), 2.0 * largest);

    // Two passes: which spheres see a second region at all, then the faces of these alone.
    std::vector<std::uint8_t> at_border(count, 0);
    for_each_near(set, grid, largest, [&](std::size_t k, std::size_t t, double) {
        if (set.mesh.region[t] != of_sphere_[k]) at_border[k] = 1;
    });
    std::vector<std::vector<NearFace>> near(count);
    for_each_near(set, grid, largest, [&](std::size_t k, std::size_t t, double distance_sq) {
        if (!at_border[k]) return;
        const Vec3 normal = set.mesh.area_vector(t).stableNormalized();
        if (normal.isZero()) return;  // no area: its neighbours count
        note({distance_sq, normal, set.mesh.region[t]}, near[k]);
    });

    first_.assign(1, 0);
    for (std::vector<NearFace>& faces : near) {
        std::stable_sort(faces.begin(), faces.end(), [](const NearFace& l, const NearFace& r) {
            return l.distance_sq < r.distance_sq;
        });
        for (const NearFace& face : faces) faces_.push_back({face.normal, face.region});
        first_.push_back(faces_.size());
    }
}

std::int32_t FaceRegions::at(std::int32_t sphere, const Vec3& n) const {
    const auto k = static_cast<std::size_t>(sphere);
    std::int32_t region = of_sphere_[k];
    if (first_.empty()) return region;
    // a sphere in an edge: the region of the face whose normal is nearest to the contact's
    double nearest = -2.0;  // below any cosine
    for (std::size_t f = first_[k]; f < first_[k + 1]; ++f) {
        const double along = n.dot(faces_[f].normal);
        if (along <= nearest + kSameRegionPlane) continue;
        nearest = along;
        region = faces_[f].region;
    }
    return region;
}

}  // namespace ice
