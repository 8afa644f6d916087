// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/field/fill_prism.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/base/error.hpp"
#include "preprocess/field/make_prism.hpp"
#include "preprocess/fill/fill_spheres.hpp"

namespace ice {

namespace {

// Cosine of 6.3 degrees [-]: the sides of an arc meet in edges and corners, too. Without them no
// sphere has the normals between two sides, and another piece's edge enters there. A larger value
// puts spheres into flatter edges, a smaller one leaves more edges of arcs without.
constexpr double kSharp = 0.994;

bool is_mirror_symmetric(const Outline& outline) {
    return std::all_of(outline.begin(), outline.end(), [&](const Vec2& p) {
        return std::any_of(outline.begin(), outline.end(), [&](const Vec2& q) {
            return (q - Vec2(p.x(), -p.y())).norm() < kEqualCorners;
        });
    });
}

// Turns about x by a quarter: the middle plane of a prism, z = 0, becomes y = 0, and back.
Vec3 turned(const Vec3& p) { return {p.x(), -p.z() + 0.0, p.y()}; }
Vec3 turned_back(const Vec3& p) { return {p.x(), p.z(), -p.y() + 0.0}; }

// How a floe lies while it is filled.
//
// The fill makes half of a solid that is symmetric about y = 0 and mirrors it, in half the time. A
// prism is symmetric about its middle plane: it is turned so that this one is y = 0, and back. One
// that is symmetric about y = 0 as it lies stays so, and its port and starboard spheres are alike.
//
// The shell is made in tiles of 32 spacings, and their corner is the origin. A floe about its
// centroid would lie in eight of them; it is moved into one.
class FillPose {
public:
    FillPose(const Outline& outline, double spacing)
        : turn_(!is_mirror_symmetric(outline)), move_(16.0 * spacing, 0.0, 16.0 * spacing) {}

    bool turns() const { return turn_; }
    Vec3 to(const Vec3& p) const { return (turn_ ? turned(p) : p) + move_; }
    Vec3 from(const Vec3& p) const { return turn_ ? turned_back(p - move_) : Vec3(p - move_); }
    Vec3 direction_from(const Vec3& d) const { return turn_ ? turned_back(d) : d; }

private:
    bool turn_;
    Vec3 move_;
};

}  // namespace

SphereSet fill_prism(const Outline& outline, const PrismSpec& spec, std::int64_t* corners) {
    FillOptions options;
    options.radius = spec.radius;
    options.spacing = spec.spacing;
    options.surface_only = spec.surface_only;
    options.quick = true;
    const FillPose pose(outline, spec.spacing);
    options.sharp = kSharp;
    options.edges_by_ends = pose.turns();  // the others are those of grids: a few for all floes
    TriangleMesh prism = make_prism(outline, spec.thickness, spec.chamfer);
    for (Vec3& vertex : prism.vertices) vertex = pose.to(vertex);
    SpheresReport report;
    SphereSet set = fill_spheres(prism, options, report);
    if (report.blind_corners > 0)
        throw bad_input("--radius",
                        fmt::format("{} of {} corners have no sphere for their three faces",
                                    report.blind_corners, report.corners),
                        "try another radius or spacing");
    if (corners != nullptr) *corners = report.corners;
    for (Vec3& vertex : set.mesh.vertices) vertex = pose.from(vertex);
    for (Vec3& center : set.centers) center = pose.from(center);
    for (Vec3& normal : set.normals) normal = pose.direction_from(normal);
    for (CreaseNormal& crease : set.creases) crease.normal = pose.direction_from(crease.normal);
    set.solid = measure_mass(set.mesh);
    return set;
}

SphereSet fill_strip(double length, const PrismSpec& spec) {
    FillOptions options;
    options.radius = spec.radius;
    options.spacing = spec.spacing;
    options.surface_only = spec.surface_only;
    // A rectangle in the x-z plane about the origin, with its outward normals [m].
    const double x = 0.5 * length, z = 0.5 * spec.thickness;
    const Vec3 corners[]{{-x, 0, -z}, {x, 0, -z}, {x, 0, z}, {-x, 0, z}};
    const Vec3 normals[]{-Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitZ(), -Vec3::UnitX()};
    Section section{{{}}};
    for (int k = 0; k < 4; ++k)
        section.loops[0].push_back({corners[k], corners[(k + 1) % 4], normals[k], 0});
    SpheresReport report;
    return fill_discs(section, {"ice"}, options, report);
}

}  // namespace ice
