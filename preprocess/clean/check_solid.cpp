// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/check_solid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "common/geometry/mass_properties.hpp"
#include "preprocess/clean/self_intersections.hpp"

namespace ice {

namespace {

struct EdgeUse {
    int forwards = 0, backwards = 0;
};

}  // namespace

SolidDiagnosis diagnose_solid(const TriangleMesh& mesh) {
    SolidDiagnosis out;
    std::map<std::pair<std::int32_t, std::int32_t>, EdgeUse> edges;
    for (const auto& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t a = t[k], b = t[(k + 1) % 3];
            EdgeUse& use = edges[{std::min(a, b), std::max(a, b)}];
            ++(a < b ? use.forwards : use.backwards);
        }
    bool seen = false;
    for (const auto& [edge, use] : edges) {
        const int count = use.forwards + use.backwards;
        if (count == 2 && use.forwards == 1) continue;
        if (count == 1)
            ++out.open_edges;
        else if (count == 2)
            ++out.inconsistent_edges;
        else
            ++out.crowded_edges;
        if (!seen)
            out.example = 0.5 * (mesh.vertices[static_cast<std::size_t>(edge.first)] +
                                 mesh.vertices[static_cast<std::size_t>(edge.second)]);
        seen = true;
    }
    out.volume = measure_mass(mesh).volume;
    if (!out.closed()) return out;
    const auto pairs = find_self_intersections(mesh);
    out.intersecting_pairs = static_cast<std::int64_t>(pairs.size());
    if (!pairs.empty()) out.example = mesh.corner(pairs.front().first, 0);
    out.inside_out = pairs.empty() && out.volume < 0.0;
    return out;
}

std::string SolidDiagnosis::text() const {
    std::string faults;
    const auto add = [&](std::int64_t count, const char* what) {
        if (count > 0) faults += fmt::format("{}{} {}", faults.empty() ? "" : ", ", count, what);
    };
    add(open_edges, "open edges (holes or unwelded parts)");
    add(crowded_edges, "edges with more than two triangles");
    add(inconsistent_edges, "edges whose triangles face opposite ways");
    add(intersecting_pairs, "pairs of triangles that cross");
    if (!faults.empty())
        return faults + fmt::format(", the first at x = {:.4g}, y = {:.4g}, z = {:.4g} m",
                                    example.x(), example.y(), example.z());
    if (volume < 0.0) return "the surface is inside out";
    return volume == 0.0 ? "the volume is zero" : "";
}

void flip(TriangleMesh& mesh) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

}  // namespace ice
