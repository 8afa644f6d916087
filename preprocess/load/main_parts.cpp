// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/load/main_parts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "common/geometry/find_equal.hpp"

namespace ice {

namespace {

// Share of the diagonal [-] by which a sheet may reach beyond the rest: a deck with a rail does, a
// sea plane reaches many times farther.
constexpr double kBeyond = 0.05;
// Volume of a box around a part over that of the part's own box [-], twice as large along each
// axis, from which it is the domain of a flow computation. A larger value keeps narrow domains, a
// smaller one leaves out boxes around the ship's own parts, such as a house around a funnel.
constexpr double kDomain = 8.0;

// A part of the mesh, by its measures.
struct Part {
    Eigen::AlignedBox3d box;
    double area = 0.0;
    bool on_box = true;  // all corners lie in faces of its box
    bool flat() const { return box.sizes().minCoeff() <= kFlatSheet * box.diagonal().norm(); }
};

// For each vertex the number of its part; parts are counted in the order of their first vertices.
// @param count  becomes the number of parts
std::vector<std::int32_t> part_of_vertices(const TriangleMesh& mesh, std::size_t& count) {
    std::vector<std::int32_t> parent(mesh.vertices.size());
    std::iota(parent.begin(), parent.end(), 0);
    // Union-find with path halving. The smallest vertex of a part is its root, so the numbers do
    // not depend on the order of joining.
    const auto root = [&](std::int32_t v) {
        while (parent[static_cast<std::size_t>(v)] != v) {
            auto& up = parent[static_cast<std::size_t>(v)];
            v = up = parent[static_cast<std::size_t>(up)];
        }
        return v;
    };
    const auto join = [&](std::int32_t a, std::int32_t b) {
        a = root(a);
        b = root(b);
        parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    };
    // Vertices in the same place are one: formats such as STL repeat each corner for each triangle.
    const std::vector<std::int32_t> first = find_equal_vertices(mesh.vertices);
    for (std::size_t v = 0; v < first.size(); ++v) join(static_cast<std::int32_t>(v), first[v]);
    for (const auto& t : mesh.triangles) {
        join(t[0], t[1]);
        join(t[0], t[2]);
    }
    std::vector<std::int32_t> out(parent.size());
    count = 0;
    for (std::size_t v = 0; v < out.size(); ++v) {
        const auto first_of_part = static_cast<std::size_t>(root(static_cast<std::int32_t>(v)));
        out[v] = first_of_part == v ? static_cast<std::int32_t>(count++) : out[first_of_part];
    }
    return out;
}

std::vector<Part> measure_parts(const TriangleMesh& mesh, const std::vector<std::int32_t>& part,
                                std::size_t count) {
    std::vector<Part> parts(count);  // a vertex without a triangle is an empty one
    const auto of = [&](std::size_t t) -> Part& {
        return parts[static_cast<std::size_t>(
            part[static_cast<std::size_t>(mesh.triangles[t][0])])];
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        of(t).area += mesh.area_vector(t).norm();
        for (int k = 0; k < 3; ++k) of(t).box.extend(mesh.corner(t, k));
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Vec3 p = mesh.corner(t, k);
            const Eigen::AlignedBox3d& box = of(t).box;
            const double in = std::min((p - box.min()).minCoeff(), (box.max() - p).minCoeff());
            if (in > kFlatSheet * box.diagonal().norm()) of(t).on_box = false;
        }
    return parts;
}

}  // namespace

std::optional<TriangleMesh> main_parts(const TriangleMesh& mesh, std::int64_t& left_out) {
    left_out = 0;
    std::size_t count = 0;
    const std::vector<std::int32_t> part = part_of_vertices(mesh, count);
    const std::vector<Part> parts = measure_parts(mesh, part, count);
    std::vector<std::size_t> present;
    for (std::size_t p = 0; p < parts.size(); ++p)
        if (!parts[p].box.isEmpty()) present.push_back(p);
    if (present.size() < 2) return std::nullopt;
    // a box around much smaller parts is the domain of a flow computation, no part of the ship
    const auto is_around = [&](std::size_t p) {
        return parts[p].on_box && std::any_of(present.begin(), present.end(), [&](std::size_t q) {
                   return q != p && !parts[q].flat() && parts[p].box.contains(parts[q].box) &&
                          parts[p].box.volume() > kDomain * parts[q].box.volume();
               });
    };
    std::vector<std::size_t> solid;
    for (const std::size_t p : present)
        if (!parts[p].flat() && !is_around(p)) solid.push_back(p);
    if (solid.empty()) return std::nullopt;
    const std::size_t largest = *std::max_element(
        solid.begin(), solid.end(),
        [&](std::size_t l, std::size_t r) { return parts[l].area < parts[r].area; });
    // solid parts stay within a length of the largest one, flat ones within the box of those
    const double length = parts[largest].box.sizes().maxCoeff();
    std::vector<std::uint8_t> keep(parts.size(), 0);
    Eigen::AlignedBox3d about;
    for (const std::size_t p : solid) {
        keep[p] = parts[p].box.exteriorDistance(parts[largest].box) <= length ? 1 : 0;
        if (keep[p] != 0) about.extend(parts[p].box);
    }
    const Vec3 margin = Vec3::Constant(kBeyond * about.diagonal().norm());
    const Eigen::AlignedBox3d wide(about.min() - margin, about.max() + margin);
    for (const std::size_t p : present) {
        if (parts[p].flat() && wide.contains(parts[p].box)) keep[p] = 1;
        left_out += keep[p] == 0 ? 1 : 0;
    }
    if (left_out == 0) return std::nullopt;
    TriangleMesh out;
    out.vertices = mesh.vertices;
    out.region_names = mesh.region_names;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto first = static_cast<std::size_t>(mesh.triangles[t][0]);
        if (keep[static_cast<std::size_t>(part[first])] == 0) continue;
        out.triangles.push_back(mesh.triangles[t]);
        out.region.push_back(mesh.region[t]);
    }
    return out;
}

}  // namespace ice
