// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/unite_parts.hpp"

#include <algorithm>
#include <numeric>

#include "preprocess/clean/find_parts.hpp"
#include "preprocess/clean/keep_triangles.hpp"
#include "preprocess/repair/winding_solid.hpp"

namespace ice {

namespace {

constexpr std::int64_t kMostParts = 40;  // each union costs about its triangles

void append(TriangleMesh& mesh, const TriangleMesh& more) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (const auto& t : more.triangles)
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    mesh.region.insert(mesh.region.end(), more.region.begin(), more.region.end());
}

// Groups parts that cross, directly or through others: the lowest part number of each group.
std::vector<std::int32_t> group_parts(
    const Parts& parts, const std::vector<std::pair<std::size_t, std::size_t>>& pairs) {
    std::vector<std::int32_t> group(static_cast<std::size_t>(parts.count));
    std::iota(group.begin(), group.end(), 0);
    const auto root = [&](std::int32_t p) {
        while (group[static_cast<std::size_t>(p)] != p) p = group[static_cast<std::size_t>(p)];
        return p;
    };
    for (const auto& [s, t] : pairs) {
        const std::int32_t a = root(parts.of_triangle[s]), b = root(parts.of_triangle[t]);
        group[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
    for (std::size_t p = 0; p < group.size(); ++p) group[p] = root(static_cast<std::int32_t>(p));
    return group;
}

}  // namespace

std::optional<TriangleMesh> unite_parts(
    const TriangleMesh& mesh, const std::vector<std::pair<std::size_t, std::size_t>>& pairs,
    std::int64_t* united) {
    const Parts parts = find_parts(mesh);
    for (const auto& [s, t] : pairs)
        if (parts.of_triangle[s] == parts.of_triangle[t]) return std::nullopt;
    const std::vector<std::int32_t> group = group_parts(parts, pairs);
    std::vector<std::vector<std::int32_t>> members(group.size());
    for (std::size_t p = 0; p < group.size(); ++p)
        members[static_cast<std::size_t>(group[p])].push_back(static_cast<std::int32_t>(p));
    std::vector<std::uint8_t> crossing(group.size(), 0);
    *united = 0;
    for (const auto& list : members) {
        if (list.size() < 2) continue;
        *united += static_cast<std::int64_t>(list.size());
        for (const std::int32_t p : list) crossing[static_cast<std::size_t>(p)] = 1;
    }
    if (*united > kMostParts) return std::nullopt;

    std::vector<std::uint8_t> keep(mesh.triangles.size());
    for (std::size_t t = 0; t < keep.size(); ++t)
        keep[t] = !crossing[static_cast<std::size_t>(parts.of_triangle[t])];
    TriangleMesh out = mesh;
    keep_triangles(out, keep);
    for (const auto& list : members) {
        if (list.size() < 2) continue;
        std::vector<TriangleMesh> bodies;
        TriangleMesh source;
        for (const std::int32_t p : list) {
            bodies.push_back(take_part(mesh, parts, p));
            append(source, bodies.back());
        }
        source.region_names = mesh.region_names;
        auto sum = unite_bodies(bodies);
        if (!sum) return std::nullopt;
        copy_regions(source, *sum);
        append(out, *sum);
    }
    return out;
}

}  // namespace ice
