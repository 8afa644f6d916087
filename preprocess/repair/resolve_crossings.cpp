// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/resolve_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/parallel.hpp"
#include "common/geometry/edge_table.hpp"
#include "common/geometry/find_equal.hpp"
#include "common/geometry/winding_number.hpp"
#include "preprocess/clean/keep_triangles.hpp"
#include "preprocess/repair/cut_faces.hpp"
#include "preprocess/repair/separate_sheets.hpp"

namespace ice {

namespace {

using Triple = std::array<std::int32_t, 3>;

// One number per place, no triangle without three corners.
void merge_equal(TriangleMesh& mesh) {
    const auto first = find_equal_vertices(mesh.vertices);
    std::vector<std::uint8_t> keep(mesh.triangles.size());
    for (std::size_t t = 0; t < keep.size(); ++t) {
        Triple& c = mesh.triangles[t];
        for (std::int32_t& v : c) v = first[static_cast<std::size_t>(v)];
        keep[t] = c[0] != c[1] && c[1] != c[2] && c[2] != c[0];
    }
    keep_triangles(mesh, keep);
}

// Of triangles on the same three corners one stays, facing as most of them do, with the number of
// those less the others.
std::vector<int> merge_copies(TriangleMesh& mesh) {
    const auto first = find_first(mesh.triangles.size(), [&](std::size_t t) -> Key {
        Triple c = mesh.triangles[t];
        std::sort(c.begin(), c.end());
        Key key;
        std::transform(c.begin(), c.end(), key.begin(),
                       [](std::int32_t v) { return static_cast<std::uint64_t>(v); });
        return key;
    });
    const auto even = [](const Triple& c) {  // an even permutation of the sorted corners
        return (c[0] < c[1]) == ((c[1] < c[2]) == (c[0] < c[2]));
    };
    std::vector<int> all(first.size(), 0), times;
    for (std::size_t t = 0; t < first.size(); ++t) {
        const auto at = static_cast<std::size_t>(first[t]);
        // a copy that faces as the first one counts for it, one that faces the other way
        // against it
        all[at] += even(mesh.triangles[t]) == even(mesh.triangles[at]) ? 1 : -1;
    }
    std::vector<std::uint8_t> keep(first.size());
    for (std::size_t t = 0; t < keep.size(); ++t) {
        // as many one way as the other: two sides of nothing
        keep[t] = all[t] != 0;
        if (all[t] < 0) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
        if (keep[t]) times.push_back(std::abs(all[t]));
    }
    keep_triangles(mesh, keep);
    return times;
}

// Patches that no edge of several sheets divides: on each side of one the winding number is the
// same everywhere.
std::vector<std::int32_t> find_patches(const std::vector<MeshEdge>& edges,
                                       const std::vector<int>& times) {
    std::vector<std::int32_t> patch(times.size());
    std::iota(patch.begin(), patch.end(), 0);
    // Union with path halving; the smaller number is the root, so the result does not depend on the
    // order of the edges.
    const auto root = [&](std::int32_t t) {
        while (patch[static_cast<std::size_t>(t)] != t) {
            auto& up = patch[static_cast<std::size_t>(t)];
            t = up = patch[static_cast<std::size_t>(up)];
        }
        return t;
    };
    for (const MeshEdge& edge : edges) {
        if (!edge.regular()) continue;
        const auto [s, t] = edge.triangles;
        if (times[static_cast<std::size_t>(s)] != times[static_cast<std::size_t>(t)]) continue;
        const std::int32_t a = root(s), b = root(t);
        patch[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
    for (std::size_t t = 0; t < patch.size(); ++t) patch[t] = root(static_cast<std::int32_t>(t));
    return patch;
}

// Radius of the inscribed circle: how far its middle is from other patches.
double width(const TriangleMesh& mesh, std::size_t t) {
    double around = 0.0;
    for (int k = 0; k < 3; ++k) around += (mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k)).norm();
    return 2.0 * mesh.area_vector(t).norm() / std::max(around, 1e-300);
}

enum class Role : std::uint8_t { inner, boundary, turned };

// The role of a triangle, from the winding numbers on its two sides: that of all others at its
// middle, half of its own more behind it and less before it.
Role role_of(const TriangleMesh& mesh, const WindingNumber& all, std::size_t t, int times) {
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    const Vec3 middle = (a + b + c) / 3.0;
    // the winding number jumps by `times` at the triangle: half of it to either side of the
    // middle
    const double others = all.at(middle) - times * solid_angle(middle, a, b, c);
    const bool behind = others + 0.5 * times > 0.5, before = others - 0.5 * times > 0.5;
    return behind == before ? Role::inner : behind ? Role::boundary : Role::turned;
}

// Keeps the triangles that bound the places of positive winding number, facing away from them.
void keep_boundary(TriangleMesh& mesh, const std::vector<int>& times) {
    TriangleMesh counted = mesh;
    for (std::size_t t = 0; t < times.size(); ++t)
        for (int more = 1; more < times[t]; ++more) counted.triangles.push_back(mesh.triangles[t]);
    // Sheets that lie on each other count as often as they occur: the winding number jumps by that
    // at them.
    const WindingNumber all(counted);
    const auto patch = find_patches(edge_table(mesh), times);
    std::vector<std::int32_t> widest(patch.size(), -1);  // of the patch with that number
    for (std::size_t t = 0; t < patch.size(); ++t) {
        auto& at = widest[static_cast<std::size_t>(patch[t])];
        // The winding number is evaluated at the widest triangle of each patch: far from other
        // patches, where it is certain.
        if (at < 0 || width(mesh, t) > width(mesh, static_cast<std::size_t>(at)))
            at = static_cast<std::int32_t>(t);
    }
    std::vector<Role> role(patch.size(), Role::inner);
    parallel_for(patch.size(), 100, [&](std::size_t p) {
        if (patch[p] != static_cast<std::int32_t>(p)) return;
        const auto t = static_cast<std::size_t>(widest[p]);
        role[p] = role_of(mesh, all, t, times[t]);
    });
    std::vector<std::uint8_t> keep(patch.size());
    for (std::size_t t = 0; t < patch.size(); ++t) {
        const Role is = role[static_cast<std::size_t>(patch[t])];
        keep[t] = is != Role::inner;
        if (is == Role::turned) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    }
    keep_triangles(mesh, keep);
}

}  // namespace

std::optional<TriangleMesh> resolve_crossings(
    // cut all faces where they cross, merge equal places and copies, keep the solid's boundary
    const TriangleMesh& mesh, const std::vector<std::pair<std::size_t, std::size_t>>& pairs) {
    auto cut = cut_faces(mesh, pairs);
    if (!cut) return std::nullopt;
    merge_equal(cut->mesh);
    const std::vector<int> times = merge_copies(cut->mesh);
    keep_boundary(cut->mesh, times);
    const auto edges = edge_table(cut->mesh);
    if (std::any_of(edges.begin(), edges.end(),
                    // A boundary has as many triangles one way as the other at each edge; else the
                    // cut failed, and a later repair is tried.
                    [](const MeshEdge& edge) { return 2 * edge.forwards != edge.count; }))
        return std::nullopt;
    separate_sheets(cut->mesh);
    return std::move(cut->mesh);
}

}  // namespace ice
