// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/close_surface.hpp"

#include <algorithm>
#include <cmath>

#include "preprocess/clean/drop_repeats.hpp"
#include "preprocess/clean/find_parts.hpp"
#include "preprocess/clean/keep_triangles.hpp"
#include "preprocess/clean/orient_faces.hpp"
#include "preprocess/clean/weld.hpp"
#include "preprocess/load/half_hull.hpp"
#include "preprocess/repair/separate_sheets.hpp"

namespace ice {

namespace {

// Volume of a part that needed caps and counts as none, over its area to the power of 3/2 [-]: a
// plate a thousandth as thick as wide. Larger values drop fins that were left open, smaller ones
// keep loose triangles as solids.
constexpr double kScrap = 1e-3;

void mirror(TriangleMesh& mesh, Repairs& repairs) {
    const std::int64_t dropped = drop_centre_plane(mesh);
    if (dropped > 0) repairs.emplace_back("triangles in the centre plane dropped", dropped);
    add_mirror_image(mesh);
    weld(mesh);
    repairs.emplace_back("half hull mirrored across y = 0", 1);
}

// Parts made of little but a cap and the triangles below it: loose triangles, flags, single plates.
std::vector<std::uint8_t> find_scraps(const TriangleMesh& mesh, const Parts& parts,
                                      const std::vector<Cap>& caps) {
    // scrap: flat beside its own area, as a plate or a loose triangle with its cap
    std::vector<std::uint8_t> scrap(static_cast<std::size_t>(parts.count), 0);
    const std::vector<double> volumes = part_volumes(mesh, parts);
    std::vector<double> area(scrap.size(), 0.0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        area[static_cast<std::size_t>(parts.of_triangle[t])] += mesh.area_vector(t).norm();
    for (const Cap& cap : caps) {
        const auto part =
            static_cast<std::size_t>(parts.of_triangle[static_cast<std::size_t>(cap.first)]);
        scrap[part] = std::abs(volumes[part]) <= kScrap * std::pow(area[part], 1.5);
    }
    return scrap;
}

// Leaves out the triangles of scraps and the caps on them.
std::int64_t drop_scraps(TriangleMesh& mesh, std::vector<Cap>& caps) {
    const Parts parts = find_parts(mesh);
    const auto scrap = find_scraps(mesh, parts, caps);
    const auto count = std::count(scrap.begin(), scrap.end(), 1);
    if (count == 0) return 0;
    std::vector<std::uint8_t> keep(mesh.triangles.size());
    std::vector<std::int32_t> place(mesh.triangles.size() + 1, 0);
    for (std::size_t t = 0; t < keep.size(); ++t) {
        keep[t] = !scrap[static_cast<std::size_t>(parts.of_triangle[t])];
        place[t + 1] = place[t] + keep[t];
    }
    std::erase_if(caps, [&](const Cap& cap) { return !keep[static_cast<std::size_t>(cap.first)]; });
    // triangles behind dropped ones move up: caps name triangles by number
    for (Cap& cap : caps) {
        cap.first = place[static_cast<std::size_t>(cap.first)];
        for (RimEdge& edge : cap.rim) {
            edge.patch = place[static_cast<std::size_t>(edge.patch)];
            edge.neighbour = place[static_cast<std::size_t>(edge.neighbour)];
        }
    }
    keep_triangles(mesh, keep);
    return count;
}

template <class Condition>
TriangleMesh without_caps(const TriangleMesh& mesh, const std::vector<Cap>& caps,
                          const Condition& leave_out) {
    TriangleMesh out = mesh;
    std::vector<std::uint8_t> keep(mesh.triangles.size(), 1);
    for (std::size_t k = 0; k < caps.size(); ++k)
        if (leave_out(k)) std::fill_n(keep.begin() + caps[k].first, caps[k].count, std::uint8_t{0});
    keep_triangles(out, keep);
    return out;
}

void name_deck(TriangleMesh& mesh, const Cap& cap) {
    auto& names = mesh.region_names;
    const auto known = std::find(names.begin(), names.end(), "deck");
    const auto row = static_cast<std::int32_t>(known - names.begin());
    if (known == names.end()) names.emplace_back("deck");
    std::fill_n(mesh.region.begin() + cap.first, cap.count, row);
}

}  // namespace

std::int64_t turn_parts_outward(TriangleMesh& mesh) {
    const Parts parts = find_parts(mesh);
    const std::vector<double> volumes = part_volumes(mesh, parts);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        if (volumes[static_cast<std::size_t>(parts.of_triangle[t])] < 0.0)
            std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    return std::count_if(volumes.begin(), volumes.end(), [](double v) { return v < 0.0; });
}

ClosedSurface close_surface(TriangleMesh mesh, const SolidOptions& options, Repairs& repairs) {
    const auto note = [&](const char* step, std::int64_t count) {
        if (count > 0) repairs.emplace_back(step, count);
    };
    const RepeatCounts repeats = drop_repeats(mesh);
    note("repeated triangles dropped", repeats.copies);
    note("triangles of walls without thickness dropped", repeats.walls);
    // copies that face the other way hid the cracks beside them from the first welding
    if (repeats.copies > 0)
        note("near vertices beside repeated triangles merged", weld(mesh).near_vertices);
    // A half hull is mirrored before openings are capped: the one in the plane y = 0 needs no cap.
    if (is_open_half(mesh)) mirror(mesh, repairs);
    note("triangles turned to agree with their neighbours", orient_faces(mesh));

    ClosedSurface out;
    std::vector<Cap> caps = cap_openings(mesh);
    note("edges between several sheets separated", separate_sheets(mesh));
    note("loose parts without volume dropped", drop_scraps(mesh, caps));
    note("inside-out surfaces turned over", turn_parts_outward(mesh));
    out.caps = judge_caps(mesh, caps, !options.suspect.empty());
    for (std::size_t k = 0; k < caps.size(); ++k) {
        if (out.caps[k].kind == CapKind::deck) name_deck(mesh, caps[k]);
        if (out.caps[k].kind == CapKind::guess && caps[k].perimeter > 0.0)
            // 4 area / perimeter is the hydraulic diameter: the width of an opening of any shape
            out.widest = std::max(out.widest, 4.0 * out.caps[k].area / caps[k].perimeter);
    }
    const auto count = [&](CapKind kind) {
        return std::count_if(out.caps.begin(), out.caps.end(),
                             [&](const CapVerdict& cap) { return cap.kind == kind; });
    };
    note("deck closed by a cap", count(CapKind::deck));
    note("openings inside other parts closed", count(CapKind::hidden));
    note("openings in flat faces closed", count(CapKind::continued));
    note("small openings closed", count(CapKind::small));
    // the surface without any cap, and without guesses: for the second opinions on the volume
    out.open = without_caps(mesh, caps, [](std::size_t) { return true; });
    out.unsure =
        without_caps(mesh, caps, [&](std::size_t k) { return out.caps[k].kind == CapKind::guess; });
    for (const double part : part_volumes(mesh, find_parts(mesh))) out.volume += std::abs(part);
    for (const CapVerdict& cap : out.caps)
        // how much volume the caps leave in doubt; decks and hidden caps are certain
        if (cap.kind != CapKind::deck && cap.kind != CapKind::hidden)
            out.doubt += cap.doubt / out.volume;
    for (std::size_t t = 0; t < out.open.triangles.size(); ++t)
        out.surface += out.open.area_vector(t).norm();
    out.mesh = std::move(mesh);
    return out;
}

}  // namespace ice
