// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/check_solid.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/geometry/edge_table.hpp"
#include "common/geometry/mass_properties.hpp"
#include "preprocess/clean/find_parts.hpp"
#include "preprocess/clean/find_self_intersections.hpp"
#include "preprocess/clean/orient_faces.hpp"
#include "preprocess/clean/weld.hpp"
#include "preprocess/load/half_hull.hpp"
#include "preprocess/repair/opening_loops.hpp"

namespace ice {

SolidDiagnosis diagnose_edges(const TriangleMesh& mesh) {
    SolidDiagnosis out;
    bool seen = false;
    for (const MeshEdge& edge : edge_table(mesh)) {
        if (edge.regular()) continue;
        ++(edge.count == 1   ? out.open_edges
           : edge.count == 2 ? out.inconsistent_edges
                             : out.crowded_edges);
        // the first fault is the example in the message: one place is enough to find the others
        if (!seen)
            out.example = 0.5 * (mesh.vertices[static_cast<std::size_t>(edge.a)] +
                                 mesh.vertices[static_cast<std::size_t>(edge.b)]);
        seen = true;
    }
    out.volume = measure_mass(mesh).volume;
    return out;
}

SolidDiagnosis diagnose_solid(const TriangleMesh& mesh) {
    // from cheap to costly
    SolidDiagnosis out = diagnose_edges(mesh);
    out.parts = find_parts(mesh).count;
    // Crossings cost most and are searched last: an open surface has other faults to mend first.
    if (!out.closed()) return out;
    const auto pairs = find_self_intersections(mesh);
    out.intersecting_pairs = static_cast<std::int64_t>(pairs.size());
    if (!pairs.empty()) {
        const std::size_t t = pairs.front().first;
        out.example = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
    }
    // with crossings the signed volume proves nothing
    out.inside_out = pairs.empty() && out.volume < 0.0;
    return out;
}

std::string SolidDiagnosis::text() const {
    std::string faults;
    const auto add = [&](std::int64_t count, const char* what) {
        if (count > 0) faults += fmt::format("{}{} {}", faults.empty() ? "" : ", ", count, what);
    };
    add(open_edges, "open edges (openings or unwelded parts)");
    add(crowded_edges, "edges with more than two triangles");
    add(inconsistent_edges, "edges whose triangles face opposite ways");
    add(intersecting_pairs, "pairs of triangles that cross");
    if (!faults.empty())
        return faults + fmt::format(", the first at x = {:.4g}, y = {:.4g}, z = {:.4g} m",
                                    example.x(), example.y(), example.z());
    if (volume < 0.0) return "the surface is inside out";
    return volume == 0.0 ? "the volume is zero" : "";
}

std::vector<Opening> find_openings(const TriangleMesh& mesh) {
    std::vector<Opening> openings;
    for (const OpeningLoop& loop : opening_loops(mesh)) {
        Opening opening;
        const std::size_t n = loop.vertices.size();
        opening.edges = static_cast<std::int64_t>(n);
        for (std::size_t k = 0; k < n; ++k) {
            const Vec3 a = mesh.vertices[static_cast<std::size_t>(loop.vertices[k])];
            const Vec3 b = mesh.vertices[static_cast<std::size_t>(loop.vertices[(k + 1) % n])];
            opening.at += a / static_cast<double>(n);
            opening.perimeter += (b - a).norm();
        }
        openings.push_back(opening);
    }
    // The longest first: it is mostly the one that a user has to close.
    std::stable_sort(openings.begin(), openings.end(),
                     [](const Opening& l, const Opening& r) { return l.perimeter > r.perimeter; });
    return openings;
}

std::string describe_mesh(TriangleMesh mesh) {
    const std::size_t triangles = mesh.triangles.size();
    // Faults are those of the welded mesh: a file of single triangles would have nothing but open
    // edges.
    const WeldCounts welded = weld(mesh);
    const SolidDiagnosis d = diagnose_solid(mesh);
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    if (box.isEmpty()) box.extend(Vec3::Zero());
    std::string out;
    const auto line = [&](const std::string& name, const std::string& value) {
        out += fmt::format("  {:<18}{}\n", name, value);
    };
    line("triangles", fmt::format("{} in {} parts; {} repeated or without area", triangles, d.parts,
                                  welded.duplicate_triangles + welded.degenerate_triangles));
    line("box",
         fmt::format("x {:.6g} to {:.6g}, y {:.6g} to {:.6g}, z {:.6g} to {:.6g} m", box.min().x(),
                     box.max().x(), box.min().y(), box.max().y(), box.min().z(), box.max().z()));
    line("signed volume", fmt::format("{:.6g} m3{}", d.volume,
                                      d.inside_out ? ", inside out"
                                      : d.closed() ? ""
                                                   : ", without meaning: not closed"));
    const std::string faults = d.text();
    line("surface", faults.empty() ? "closed, faces outwards, crosses nowhere" : faults);
    if (const HalfHull half = looks_like_half_hull(mesh)) line("half hull", half.text());
    // Openings are found after faces are turned to agree: before, each seam between turned patches
    // looks like one.
    orient_faces(mesh);
    const auto openings = find_openings(mesh);
    for (std::size_t k = 0; k < openings.size(); ++k) {
        const Opening& o = openings[k];
        // The longest ten: a torn mesh has thousands.
        if (k == 10) {
            line("opening", fmt::format("and {} more, shorter", openings.size() - k));
            break;
        }
        line("opening", fmt::format("{} edges, {:.3g} m around, at {:.4g}, {:.4g}, {:.4g} m",
                                    o.edges, o.perimeter, o.at.x(), o.at.y(), o.at.z()));
    }
    if (!d.closed()) {
        const auto pairs = find_self_intersections(mesh);
        if (!pairs.empty()) line("crossing", fmt::format("{} pairs of triangles", pairs.size()));
    }
    return out;
}

}  // namespace ice
