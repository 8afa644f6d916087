// SPDX-License-Identifier: GPL-3.0-or-later
// The hull of the scenes loose and packed: where its spheres are, and the solid they touch.
#include <cmath>

#include "common/geometry/surface_tree.hpp"
#include "preprocess/fill/shares.hpp"
#include "preprocess/fill/survey.hpp"
#include "tests/bench/icebench_scene.hpp"

namespace ice::bench {

namespace {

constexpr double kLength = 10.0, kHalf = 1.0, kDeck = 0.5, kKeel = -1.3;  // [m]
constexpr double kBow = 3.0;                                              // length of the taper [m]
constexpr double kRadius = 0.1;  // of the spheres and their spacing [m]
constexpr double kShoulder = kLength - kBow;

// The spheres' centres lie on the faces of a solid that is smaller by the radius all round.
constexpr double kInnerHalf = kHalf - kRadius, kInnerDeck = kDeck - kRadius,
                 kInnerKeel = kKeel + kRadius;

double half_breadth(double x) {
    return x <= kShoulder ? kInnerHalf : kInnerHalf * (kLength - x) / kBow;
}

double bottom(double x) {
    return x <= kShoulder ? kInnerKeel
                          : kInnerKeel + (kInnerDeck - kInnerKeel) * (x - kShoulder) / kBow;
}

// Frames at every spacing: both sides, then the bottom between them, at the stern the transom.
std::vector<Vec3> sphere_centers() {
    constexpr double kRounding = 1e-9;
    std::vector<Vec3> out;
    for (double x = kRadius; x <= kLength - kRadius + kRounding; x += kRadius) {
        const double half = half_breadth(x), low = bottom(x);
        for (double z = low; z <= kInnerDeck + kRounding; z += kRadius)
            for (const double side : {1.0, -1.0}) out.emplace_back(x, side * half, z);
        const int across = static_cast<int>(std::floor(2.0 * half / kRadius));
        const bool stern = x < 1.5 * kRadius;
        const double high = stern ? kInnerDeck + kRounding : low;
        for (double z = low; z <= high; z += kRadius)
            for (int i = 1; i < across; ++i)
                out.emplace_back(x, -half + 2.0 * half * i / across, z);
    }
    return out;
}

void add_face(const std::vector<std::int32_t>& corners, TriangleMesh& mesh) {
    for (std::size_t k = 2; k < corners.size(); ++k)
        mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
}

// The solid whose faces the spheres touch from inside: those of the inner one moved out by the
// radius, and a small face at the stem.
TriangleMesh wedge_mesh() {
    // sides of the bow: kInnerHalf x + kBow y = side; its bottom: rise x - kBow z = ramp
    const double rise = kInnerDeck - kInnerKeel;
    const double side = kInnerHalf * kLength + kRadius * std::hypot(kInnerHalf, kBow);
    const double ramp = rise * kLength - kBow * kInnerDeck + kRadius * std::hypot(rise, kBow);
    const auto side_at = [&](double x) { return (side - kInnerHalf * x) / kBow; };
    const double side_from = (side - kBow * kHalf) / kInnerHalf;
    const double ramp_from = (ramp + kBow * kKeel) / rise;
    TriangleMesh mesh;
    const std::vector<Vec3> port{{0.0, kHalf, kKeel},
                                 {0.0, kHalf, kDeck},
                                 {side_from, kHalf, kKeel},
                                 {side_from, kHalf, kDeck},
                                 {ramp_from, side_at(ramp_from), kKeel},
                                 {kLength, side_at(kLength), (rise * kLength - ramp) / kBow},
                                 {kLength, side_at(kLength), kDeck}};
    for (const double y : {1.0, -1.0})
        for (const Vec3& v : port) mesh.vertices.emplace_back(v.x(), y * v.y(), v.z());
    add_face({0, 1, 3, 2}, mesh);          // port side
    add_face({2, 3, 6, 5, 4}, mesh);       // port side of the bow
    add_face({7, 9, 10, 8}, mesh);         // starboard
    add_face({9, 11, 12, 13, 10}, mesh);   //
    add_face({0, 7, 8, 1}, mesh);          // transom
    add_face({0, 2, 4, 11, 9, 7}, mesh);   // bottom
    add_face({4, 5, 12, 11}, mesh);        // bottom of the bow
    add_face({1, 8, 10, 13, 6, 3}, mesh);  // deck
    add_face({5, 6, 13, 12}, mesh);        // stem
    mesh.region.assign(mesh.triangles.size(), 0);
    return mesh;
}

}  // namespace

SphereSet make_wedge_set() {
    SphereSet set;
    set.radius = set.spacing = kRadius;
    set.mode = "surface";
    set.source_mesh = "wedge";
    set.mesh = wedge_mesh();
    set.solid = measure_mass(set.mesh);
    set.centers = sphere_centers();
    set.surface_count = set.centers.size();
    set.radii.assign(set.size(), kRadius);
    // normals, creases and shares as spherize finds them
    const SurfaceTree tree(set.mesh);
    set_normals(tree, {}, set);
    const SphereFinder finder(set);
    share_surface(tree, survey_surface(tree, set, finder, false), {}, set);
    share_volume(0.0, false, set);
    return set;
}

}  // namespace ice::bench
