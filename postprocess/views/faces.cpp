// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/views/faces.hpp"

#include <meshoptimizer.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numeric>

namespace ice::views {

namespace {

using Edge = std::pair<std::int32_t, std::int32_t>;

// Triangles whose normals differ by less belong to one face [-]: the cosine of 0.5 degrees, far
// above the rounding of mesh files and below the angle of facets on a curved bow. Nearer to 1,
// faces of rounded files stay divided; smaller, curved surfaces lose their shading.
constexpr double kFlat = 0.99996;

// Union of triangles into groups, with path halving.
class Groups {
public:
    explicit Groups(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    std::size_t find(std::size_t k) {
        while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
        return k;
    }
    void join(std::size_t a, std::size_t b) { parent_[find(b)] = find(a); }

private:
    std::vector<std::size_t> parent_;
};

// The outline of some triangles as one loop of vertices; empty when it is not a single loop.
std::vector<std::int32_t> outline_loop(const TriangleMesh& mesh,
                                       const std::vector<std::size_t>& triangles) {
    std::map<std::int32_t, std::int32_t> next;
    std::map<Edge, int> used;
    for (const std::size_t t : triangles)
        for (std::size_t k = 0; k < 3; ++k)
            ++used[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}];
    // an edge without its reverse is outline; a vertex where two such edges begin has no single
    // loop
    for (const auto& [edge, count] : used) {
        if (used.count({edge.second, edge.first})) continue;
        if (count > 1 || !next.emplace(edge.first, edge.second).second) return {};
    }
    if (next.empty()) return {};
    std::vector<std::int32_t> loop;
    for (std::int32_t at = next.begin()->first; loop.size() <= next.size();) {
        loop.push_back(at);
        const auto found = next.find(at);
        if (found == next.end()) return {};
        at = found->second;
        if (at == loop.front()) break;
    }
    return loop.size() == next.size() ? loop : std::vector<std::int32_t>{};
}

// corners on a straight line between their neighbours are not needed
std::vector<Vec3> corners_of(const TriangleMesh& mesh, const std::vector<std::int32_t>& loop) {
    std::vector<Vec3> corners;
    const std::size_t n = loop.size();
    const auto at = [&](std::size_t k) {
        return mesh.vertices[static_cast<std::size_t>(loop[k % n])];
    };
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 in = at(k) - at(k + n - 1), out = at(k + 1) - at(k);
        // 1e-6 is the sine of the angle below which an edge counts as straight; an edge that turns
        // back is a corner, too
        if (in.cross(out).norm() > 1e-6 * in.norm() * out.norm() || in.dot(out) < 0.0)
            corners.push_back(at(k));
    }
    return corners;
}

}  // namespace

Vec3 Face::center() const {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& c : corners) sum += c;
    return sum / static_cast<double>(corners.size());
}

std::vector<Face> make_faces(const TriangleMesh& mesh) {
    const std::size_t count = mesh.triangles.size();
    std::vector<Vec3> normals(count);
    std::map<Edge, std::size_t> owner;
    for (std::size_t t = 0; t < count; ++t) {
        // directed edges: the neighbour has the same edge the other way round
        const Vec3 area = mesh.area_vector(t);
        normals[t] = area.norm() > 0.0 ? Vec3(area.normalized()) : Vec3(Vec3::Zero());
        for (std::size_t k = 0; k < 3; ++k)
            owner[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}] = t;
    }
    Groups groups(count);
    for (const auto& [edge, t] : owner) {
        const auto other = owner.find({edge.second, edge.first});
        // against the group's first triangle, so that a curved surface is not merged step by step
        if (other != owner.end() &&
            normals[groups.find(t)].dot(normals[groups.find(other->second)]) > kFlat)
            groups.join(t, other->second);
    }
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t t = 0; t < count; ++t)
        if (!normals[t].isZero()) members[groups.find(t)].push_back(t);

    std::vector<Face> faces;
    for (const auto& [first, triangles] : members) {
        // one polygon per flat face has no lines inside; where its outline is no single loop, its
        // triangles
        const auto loop = outline_loop(mesh, triangles);
        if (!loop.empty()) {
            faces.push_back({corners_of(mesh, loop), normals[triangles.front()]});
            if (faces.back().corners.size() >= 3) continue;
            faces.pop_back();
        }
        for (const std::size_t t : triangles)
            faces.push_back(
                {{mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}, normals[t]});
    }
    return faces;
}

CutMesh cut_mesh(const TriangleMesh& mesh, double level) {
    CutMesh cut;
    cut.below.vertices = mesh.vertices;
    std::map<Edge, std::int32_t> crossings;  // new vertex on an edge, shared by its two triangles
    const auto height = [&](std::int32_t v) {
        return mesh.vertices[static_cast<std::size_t>(v)].z() - level;
    };
    const auto crossing = [&](std::int32_t a, std::int32_t b) {
        if (a > b) std::swap(a, b);
        const auto [place, is_new] =
            crossings.emplace(Edge{a, b}, static_cast<std::int32_t>(cut.below.vertices.size()));
        if (is_new) {
            const double part = height(a) / (height(a) - height(b));
            const Vec3 p = mesh.vertices[static_cast<std::size_t>(a)];
            const Vec3 q = mesh.vertices[static_cast<std::size_t>(b)];
            cut.below.vertices.push_back(p + part * (q - p));
        }
        return place->second;
    };
    for (const auto& t : mesh.triangles) {
        // Corners in the plane belong to both parts. A triangle then gives each part a polygon of
        // at most four corners, and the section the piece of its line.
        std::vector<std::int32_t> low, high, on;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t a = t[k], b = t[(k + 1) % 3];
            if (height(a) <= 0.0) low.push_back(a);
            if (height(a) >= 0.0) high.push_back(a);
            if (height(a) == 0.0) on.push_back(a);
            if (height(a) * height(b) < 0.0) {
                const std::int32_t c = crossing(a, b);
                for (auto* part : {&low, &high, &on}) part->push_back(c);
            }
        }
        const auto fan = [](TriangleMesh& part, const std::vector<std::int32_t>& loop) {
            for (std::size_t k = 2; k < loop.size(); ++k)
                part.triangles.push_back({loop[0], loop[k - 1], loop[k]});
        };
        fan(cut.below, low);
        if (on.size() < 3) fan(cut.above, high);  // a triangle in the plane belongs below
        if (on.size() == 2)
            cut.section.emplace_back(cut.below.vertices[static_cast<std::size_t>(on[0])],
                                     cut.below.vertices[static_cast<std::size_t>(on[1])]);
    }
    cut.above.vertices = cut.below.vertices;
    return cut;
}

TriangleMesh simplify_mesh(const TriangleMesh& mesh, std::size_t most) {
    if (mesh.triangles.size() <= most) return mesh;
    std::vector<float> points;
    for (const Vec3& v : mesh.vertices)
        for (int k = 0; k < 3; ++k) points.push_back(static_cast<float>(v[k]));
    std::vector<unsigned> corners, kept;
    for (const auto& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
    kept.resize(corners.size());
    // Error that the simplification may make, relative to the mesh's size [-]: without a bound,
    // since the number of triangles alone decides. A real bound would leave more of them than the
    // page has room for.
    constexpr float kAnyError = 1e6f;
    std::size_t count =
        meshopt_simplify(kept.data(), corners.data(), corners.size(), points.data(),
                         mesh.vertices.size(), 3 * sizeof(float), 3 * most, kAnyError, 0, nullptr);
    // edges that may not collapse (seams of a surface that is not closed) can stop it too early
    if (count > 3 * most)
        count = meshopt_simplifySloppy(kept.data(), corners.data(), corners.size(), points.data(),
                                       mesh.vertices.size(), 3 * sizeof(float), 3 * most, kAnyError,
                                       nullptr);
    // the corners left are corners of the mesh: a triangle has the region most of them had
    std::vector<std::int32_t> vertex_region(mesh.vertices.size(), 0);
    for (std::size_t t = 0; t < mesh.region.size(); ++t)
        for (const std::int32_t v : mesh.triangles[t])
            vertex_region[static_cast<std::size_t>(v)] = mesh.region[t];
    TriangleMesh result;
    result.region_names = mesh.region_names;
    std::map<unsigned, std::int32_t> row;
    for (std::size_t k = 0; k + 2 < count; k += 3) {
        std::array<std::int32_t, 3> triangle{}, region{};
        for (std::size_t c = 0; c < 3; ++c) {
            const auto [place, is_new] =
                row.emplace(kept[k + c], static_cast<std::int32_t>(result.vertices.size()));
            if (is_new) result.vertices.push_back(mesh.vertices[kept[k + c]]);
            triangle[c] = place->second;
            region[c] = vertex_region[kept[k + c]];
        }
        result.triangles.push_back(triangle);
        result.region.push_back(region[1] == region[2] ? region[1] : region[0]);
    }
    return result;
}

}  // namespace ice::views
