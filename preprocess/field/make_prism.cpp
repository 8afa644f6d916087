// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/field/make_prism.hpp"

#include <fmt/format.h>

#include "common/base/assert.hpp"
#include "common/base/error.hpp"
#include "preprocess/slice/section_geometry.hpp"

namespace ice {

namespace {

using Triangle = std::array<std::int32_t, 3>;

// Triangles that fill an outline, anticlockwise.
std::vector<Triangle> fill_outline(const Outline& outline) {
    const auto n = static_cast<std::int32_t>(outline.size());
    std::vector<Triangle> out;
    if (is_convex(outline)) {
        // from corners k and l the next lies on the side with the fewer: no fan of needles
        for (std::int32_t low = 0, high = n - 1; high - low > 1;) {
            if (low + 1 <= n - high) {
                out.push_back({low, low + 1, high});
                ++low;
            } else {
                out.push_back({low, high - 1, high});
                --high;
            }
        }
        return out;
    }
    std::vector<Vec3> loop;  // triangulate works in x-z
    for (const Vec2& p : outline) loop.emplace_back(p.x(), 0.0, p.y());
    return triangulate({loop});
}

}  // namespace

TriangleMesh make_prism(const Outline& outline, double thickness, double chamfer) {
    ICE_ASSERT(area_of(outline) > 0.0 && chamfer >= 0.0 && chamfer < 0.5 * thickness);
    const auto n = static_cast<std::int32_t>(outline.size());
    // the faces are drawn in by the chamfer, which makes its slope 45 degrees
    const Outline flat = chamfer > 0.0 ? inset(outline, chamfer) : outline;
    if (flat.empty()) {
        const Vec2 at = centroid_of(outline);
        throw bad_input("ice.chamfer",
                        fmt::format("{:g} m leaves nothing of an edge of the floe at ({:.4g}, "
                                    "{:.4g}) m",
                                    chamfer, at.x(), at.y()),
                        "use a smaller chamfer");
    }
    TriangleMesh mesh;
    mesh.region_names = {"ice"};
    // rings of corners from below: bottom face, lower and upper end of the side, top face
    const double half = 0.5 * thickness;
    std::vector<std::pair<const Outline*, double>> rings{{&flat, -half}, {&flat, half}};
    if (chamfer > 0.0)
        rings = {
            {&flat, -half}, {&outline, chamfer - half}, {&outline, half - chamfer}, {&flat, half}};
    for (const auto& [corners, z] : rings)
        for (const Vec2& p : *corners) mesh.vertices.emplace_back(p.x(), p.y(), z);

    const auto count = static_cast<std::int32_t>(rings.size());
    for (std::int32_t ring = 0; ring + 1 < count; ++ring)
        for (std::int32_t k = 0; k < n; ++k) {
            const std::int32_t a = ring * n + k, b = ring * n + (k + 1) % n;
            // the outline runs anticlockwise: with a, b, b + n the sides face outward
            mesh.triangles.push_back({a, b, b + n});
            mesh.triangles.push_back({a, b + n, a + n});
        }
    const std::int32_t top = (count - 1) * n;
    for (const auto& [a, b, c] : fill_outline(flat)) {
        // the bottom faces downward, its triangles turn the other way
        mesh.triangles.push_back({a, c, b});
        mesh.triangles.push_back({top + a, top + b, top + c});
    }
    mesh.region.assign(mesh.triangles.size(), 0);
    return mesh;
}

}  // namespace ice
