// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/pack_hull.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "postprocess/report/tables.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::report {

using nlohmann::json;

namespace {

// Largest number in 16 bits [-]: hulls of more vertices have 32 bits for each corner, twice the
// bytes.
constexpr std::size_t kLargest16 = 0xffff;

// 16 bits over each axis' own range, in half the bytes of floats.
std::array<Quantiser, 3> axes_of(const TriangleMesh& mesh) {
    std::array<Quantiser, 3> axes;
    for (std::size_t d = 0; d < 3; ++d) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Vec3& v : mesh.vertices) {
            low = std::min(low, v[static_cast<Eigen::Index>(d)]);
            high = std::max(high, v[static_cast<Eigen::Index>(d)]);
        }
        axes[d] = make_quantiser(low, high, 0.0);
    }
    return axes;
}

void pack_vertices(const TriangleMesh& mesh, const std::array<Quantiser, 3>& axes, Pack& pack) {
    std::vector<std::int16_t> vertices;
    for (const Vec3& v : mesh.vertices)
        for (std::size_t d = 0; d < 3; ++d)
            vertices.push_back(axes[d].code(v[static_cast<Eigen::Index>(d)]));
    pack.add_series("hull_vertices", std::move(vertices), 1, 0);
}

void pack_triangles(const TriangleMesh& mesh, Pack& pack) {
    std::vector<std::uint16_t> narrow;
    std::vector<std::uint32_t> wide;
    for (const auto& t : mesh.triangles)
        for (const std::int32_t v : t) {
            narrow.push_back(static_cast<std::uint16_t>(v));
            wide.push_back(static_cast<std::uint32_t>(v));
        }
    // 16 bits number the vertices of nearly all hulls
    if (mesh.vertices.size() <= kLargest16)
        pack.add("hull_triangles", narrow);
    else
        pack.add("hull_triangles", wide);
}

void pack_loads(const statistics::LoadMap& hull, double end, Pack& pack) {
    std::vector<std::uint16_t> load;
    for (const double p : hull.load)
        // Loads beyond the end of the scale have one colour and need no value of their own.
        load.push_back(static_cast<std::uint16_t>(
            end > 0.0 ? std::lround(65535.0 * std::min(1.0, p / end)) : 0));
    pack.add("hull_load", load);
}

// [number, name] of the regions that triangles have.
json pack_regions(const TriangleMesh& mesh, Pack& pack) {
    std::vector<std::uint8_t> region;
    std::set<int> used;
    for (const std::int32_t r : mesh.region) {
        region.push_back(static_cast<std::uint8_t>(std::min(r, 255)));
        used.insert(region.back());
    }
    pack.add("hull_region", region);
    json regions = json::array();
    for (const int r : used) regions.push_back({r, mesh.region_names[static_cast<std::size_t>(r)]});
    return regions;
}

}  // namespace

json pack_hull(const statistics::LoadMap& hull, Pack& pack) {
    json scale = json::array(), offset = json::array();
    const std::array<Quantiser, 3> axes = axes_of(hull.mesh);
    for (const Quantiser& axis : axes) {
        scale.push_back(axis.step);
        offset.push_back(axis.offset);
    }
    // the viewer finds the arrays by name, so their order is free
    pack_vertices(hull.mesh, axes, pack);
    pack_triangles(hull.mesh, pack);
    const double end = statistics::scale_end(hull);
    pack_loads(hull, end, pack);
    json regions = pack_regions(hull.mesh, pack);
    const PressureUnit unit = choose_pressure_unit(end);
    return {{"scale", scale},
            {"offset", offset},
            {"regions", regions},
            {"scale_text", views::readable(end / unit.pascals)},
            {"half_text", views::readable(0.5 * end / unit.pascals)},
            {"unit", unit.name}};
}

}  // namespace ice::report
