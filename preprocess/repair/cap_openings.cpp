// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/cap_openings.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "common/geometry/edge_table.hpp"
#include "preprocess/repair/fill_loop.hpp"
#include "preprocess/repair/opening_loops.hpp"

namespace ice {

namespace {

using Key = std::pair<std::int32_t, std::int32_t>;
using Triple = std::array<std::int32_t, 3>;

// Corners of an opening [-] from which the triangulation in plan is tried, too: a deck has dozens.
// Smaller openings give the same patch by both, and the second would cost time only. A larger value
// may miss decks of few corners.
constexpr std::size_t kDeckCorners = 8;

Key edge_key(std::int32_t a, std::int32_t b) { return std::minmax(a, b); }

// The far corners of the triangles around the loop.
std::vector<Vec3> points_across(const TriangleMesh& mesh, const OpeningLoop& loop) {
    std::vector<Vec3> across;
    const std::size_t n = loop.vertices.size();
    for (std::size_t k = 0; k < n; ++k) {
        const std::int32_t a = loop.vertices[k], b = loop.vertices[(k + 1) % n];
        // the corner of the triangle across the edge: the patch continues its slope
        Vec3 far = mesh.vertices[static_cast<std::size_t>(a)];
        if (loop.neighbours[k] >= 0)
            for (const std::int32_t v :
                 mesh.triangles[static_cast<std::size_t>(loop.neighbours[k])])
                if (v != a && v != b) far = mesh.vertices[static_cast<std::size_t>(v)];
        across.push_back(far);
    }
    return across;
}

// Every edge of the patch that is not on the loop must be new to the mesh.
bool is_new(const std::vector<Triple>& patch, const OpeningLoop& loop, const std::set<Key>& known) {
    const auto n = static_cast<std::int32_t>(loop.vertices.size());
    for (const Triple& t : patch)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t i = t[k], j = t[(k + 1) % 3];
            if ((i + 1) % n == j || (j + 1) % n == i) continue;
            if (known.contains(edge_key(loop.vertices[static_cast<std::size_t>(i)],
                                        loop.vertices[static_cast<std::size_t>(j)])))
                return false;
        }
    return !patch.empty();
}

std::vector<Triple> fan(TriangleMesh& mesh, const OpeningLoop& loop) {
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t v : loop.vertices) middle += mesh.vertices[static_cast<std::size_t>(v)];
    const auto center = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.push_back(middle / static_cast<double>(loop.vertices.size()));
    std::vector<Triple> out;
    for (std::size_t k = 0; k < loop.vertices.size(); ++k)
        out.push_back({loop.vertices[k], loop.vertices[(k + 1) % loop.vertices.size()], center});
    return out;
}

double area_of(const std::vector<Vec3>& points, const std::vector<Triple>& patch) {
    double area = 0.0;
    for (const Triple& t : patch) {
        const auto at = [&](std::size_t k) { return points[static_cast<std::size_t>(t[k])]; };
        area += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
    }
    return area;
}

std::vector<Triple> patch_of(TriangleMesh& mesh, const OpeningLoop& loop,
                             const std::set<Key>& known) {
    std::vector<Vec3> points;
    for (const std::int32_t v : loop.vertices)
        points.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
    auto local = fill_loop(points, points_across(mesh, loop));
    if (points.size() >= kDeckCorners) {
        // Of both patches the smaller one: a deck is plated across, from side to side.
        // the smoothest surface over a sheer line is a dome from stem to stern
        auto plan = fill_loop_in_plan(points);
        if (!plan.empty() && (local.empty() || area_of(points, plan) < area_of(points, local)))
            local = std::move(plan);
    }
    // A patch that repeats an edge of the mesh would give it three triangles: a new vertex in the
    // middle cannot.
    if (!is_new(local, loop, known)) return fan(mesh, loop);
    std::vector<Triple> out;
    for (const Triple& t : local)
        out.push_back({loop.vertices[static_cast<std::size_t>(t[0])],
                       loop.vertices[static_cast<std::size_t>(t[1])],
                       loop.vertices[static_cast<std::size_t>(t[2])]});
    return out;
}

Cap append(TriangleMesh& mesh, const OpeningLoop& loop, const std::vector<Triple>& patch) {
    Cap cap;
    cap.first = static_cast<std::int32_t>(mesh.triangles.size());
    cap.count = static_cast<std::int32_t>(patch.size());
    std::map<Key, std::int32_t> owner;
    for (std::size_t p = 0; p < patch.size(); ++p)
        for (std::size_t k = 0; k < 3; ++k)
            owner[{patch[p][k], patch[p][(k + 1) % 3]}] = cap.first + static_cast<std::int32_t>(p);
    // triangles of the patch by their directed edges: the neighbour across the rim has the edge
    // reversed
    std::map<std::int32_t, double> region_length;
    const std::size_t n = loop.vertices.size();
    for (std::size_t k = 0; k < n; ++k) {
        const std::int32_t a = loop.vertices[k], b = loop.vertices[(k + 1) % n];
        const Vec3 along =
            mesh.vertices[static_cast<std::size_t>(b)] - mesh.vertices[static_cast<std::size_t>(a)];
        const double length = along.norm();
        cap.perimeter += length;
        const auto at = owner.find({a, b});
        if (loop.neighbours[k] < 0 || at == owner.end()) continue;
        cap.rim.push_back({at->second, loop.neighbours[k], along, length});
        region_length[mesh.region[static_cast<std::size_t>(loop.neighbours[k])]] += length;
    }
    // A cap belongs to the region with most of its rim.
    const auto longest =
        std::max_element(region_length.begin(), region_length.end(),
                         [](const auto& l, const auto& r) { return l.second < r.second; });
    mesh.triangles.insert(mesh.triangles.end(), patch.begin(), patch.end());
    mesh.region.resize(mesh.triangles.size(), longest == region_length.end() ? 0 : longest->first);
    return cap;
}

}  // namespace

std::vector<Cap> cap_openings(TriangleMesh& mesh) {
    const auto loops = opening_loops(mesh);
    std::vector<Cap> caps;
    if (loops.empty()) return caps;
    std::set<Key> known;  // edges between the vertices of loops
    std::vector<std::uint8_t> on_loop(mesh.vertices.size(), 0);
    for (const OpeningLoop& loop : loops)
        for (const std::int32_t v : loop.vertices) on_loop[static_cast<std::size_t>(v)] = 1;
    // Only edges between loop vertices can be repeated by a patch: the set stays small.
    for (const MeshEdge& edge : edge_table(mesh))
        if (on_loop[static_cast<std::size_t>(edge.a)] && on_loop[static_cast<std::size_t>(edge.b)])
            known.insert({edge.a, edge.b});
    for (const OpeningLoop& loop : loops) {
        const auto patch = patch_of(mesh, loop, known);
        caps.push_back(append(mesh, loop, patch));
        for (const Triple& t : patch)
            for (std::size_t k = 0; k < 3; ++k) known.insert(edge_key(t[k], t[(k + 1) % 3]));
    }
    return caps;
}

}  // namespace ice
