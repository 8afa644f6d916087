// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/check_solid.hpp"

#include <fmt/format.h>

#include "common/geometry/mass_properties.hpp"
#include "preprocess/clean/edge_table.hpp"
#include "preprocess/clean/self_intersections.hpp"

namespace ice {

SolidDiagnosis diagnose_solid(const TriangleMesh& mesh) {
    SolidDiagnosis out;
    bool seen = false;
    for (const MeshEdge& edge : edge_table(mesh)) {
        if (edge.regular()) continue;
        ++(edge.count == 1   ? out.open_edges
           : edge.count == 2 ? out.inconsistent_edges
                             : out.crowded_edges);
        if (!seen)
            out.example = 0.5 * (mesh.vertices[static_cast<std::size_t>(edge.a)] +
                                 mesh.vertices[static_cast<std::size_t>(edge.b)]);
        seen = true;
    }
    out.volume = measure_mass(mesh).volume;
    if (!out.closed()) return out;
    const auto pairs = find_self_intersections(mesh);
    out.intersecting_pairs = static_cast<std::int64_t>(pairs.size());
    if (!pairs.empty()) {
        const std::size_t t = pairs.front().first;
        out.example = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
    }
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
