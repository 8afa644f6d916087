// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/edge_chains.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/geometry/edge_table.hpp"

namespace ice {

namespace {

// Cosine of the turn [-] at a vertex of a settled polyline, 20 degrees, above which it counts
// as straight. Lower values would lose corners, higher ones put a sphere into each knuckle of a
// curved edge.
constexpr double kStraightCos = 0.94;
// Sum of the unit normals of an edge's faces [-] below which it is a knife's, of less than 12
// degrees: no sphere fits, and the shift inwards has no bound. Larger leaves sharp edges without
// starts of their own, smaller puts starts far inside.
constexpr double kKnifeEdge = 0.2;

struct SharpEdge {
    std::int32_t a, b;  // vertices, a < b
    Vec3 inward;        // from the edge to where a sphere of unit radius would sit
    bool used = false;
};

std::vector<SharpEdge> find_sharp_edges(const SurfaceTree& tree, double sharp) {
    const TriangleMesh& mesh = tree.mesh();
    std::vector<SharpEdge> out;
    for (const MeshEdge& edge : edge_table(mesh)) {
        if (edge.count != 2) continue;
        const Vec3& n1 = tree.normal(edge.triangles[0]);
        const Vec3& n2 = tree.normal(edge.triangles[1]);
        if (n1.dot(n2) > sharp) continue;
        // convex: the second triangle's far corner lies behind the first's plane
        const Vec3 on = mesh.vertices[static_cast<std::size_t>(edge.a)];
        double far = 0.0;
        for (int k = 0; k < 3; ++k)
            far += n1.dot(mesh.corner(static_cast<std::size_t>(edge.triangles[1]), k) - on);
        const Vec3 sum = n1 + n2;
        if (far >= 0.0 || sum.norm() < kKnifeEdge) continue;
        // on both planes shifted inwards by 1: -2 (n1 + n2) / |n1 + n2|^2
        out.push_back({edge.a, edge.b, -2.0 / sum.squaredNorm() * sum});
    }
    return out;
}

// Follows edges from `vertex` on while one continues, turning by a cosine above `sharp`.
void follow(const TriangleMesh& mesh,
            const std::map<std::int32_t, std::vector<std::size_t>>& at_vertex,
            std::vector<SharpEdge>& edges, std::int32_t vertex, Vec3 heading, double sharp,
            std::vector<std::pair<std::size_t, std::int32_t>>& path) {
    while (true) {
        // of several continuations the last one listed; used edges are never walked again
        std::size_t next = edges.size();
        std::int32_t target = -1;
        for (const std::size_t e : at_vertex.at(vertex)) {
            if (edges[e].used) continue;
            const std::int32_t other = edges[e].a == vertex ? edges[e].b : edges[e].a;
            const Vec3 d = (mesh.vertices[static_cast<std::size_t>(other)] -
                            mesh.vertices[static_cast<std::size_t>(vertex)])
                               .normalized();
            if (d.dot(heading) < sharp) continue;
            next = e;
            target = other;
        }
        if (target < 0) return;
        edges[next].used = true;
        path.emplace_back(next, target);
        heading = (mesh.vertices[static_cast<std::size_t>(target)] -
                   mesh.vertices[static_cast<std::size_t>(vertex)])
                      .normalized();
        vertex = target;
    }
}

// An edge of the outline or of a chain, and by how much its points are moved inwards.
struct ChainPiece {
    Vec3 a, b, shift;
};

// From the middle of two moves to one that does both: that is where the moved edges meet.
Vec3 meeting_shift(const Vec3& one, const Vec3& other) {
    const Vec3 sum = one + other;
    return (one.squaredNorm() + other.squaredNorm()) / sum.squaredNorm() * sum;
}

// Start points along edges that follow one another. Where they turn, edges moved inwards each by
// its own shift overlap, or gape: points would go back and forth, and miss the corner in which a
// sphere touches both. They meet where both shifts are done, unless the corner is sharp.
std::vector<Vec3> walk(const std::vector<ChainPiece>& pieces, bool closed, double step) {
    // Cosine between shifts [-], 78 degrees: sharper corners are left to settling. A smaller value
    // moves the starts of sharp corners far inwards, a larger one leaves more corners to settling.
    constexpr double kSharpTurn = 0.2;
    std::vector<Vec3> out;
    const std::size_t count = pieces.size();
    const auto shift_between = [&](std::size_t k, std::size_t other, bool has_other) {
        const Vec3 &own = pieces[k].shift, &next = pieces[other % count].shift;
        const bool meets = has_other && own.dot(next) > kSharpTurn * own.norm() * next.norm();
        return meets ? meeting_shift(own, next) : own;
    };
    for (std::size_t k = 0; k < count; ++k) {
        const Vec3 a = pieces[k].a + shift_between(k, k + count - 1, closed || k > 0);
        const Vec3 b = pieces[k].b + shift_between(k, k + 1, closed || k + 1 < count);
        // an edge shorter than the corners at its ends take has no points of its own
        if ((b - a).dot(pieces[k].b - pieces[k].a) <= 0.0) continue;
        const int n = std::max(1, static_cast<int>(std::ceil((b - a).norm() / step)));
        for (int i = 0; i <= n; ++i) out.push_back(a + static_cast<double>(i) / n * (b - a));
    }
    return out;
}

}  // namespace

std::vector<std::vector<Vec3>> trace_sharp_edges(const SurfaceTree& tree, double radius,
                                                 double step, double sharp) {
    const TriangleMesh& mesh = tree.mesh();
    std::vector<SharpEdge> edges = find_sharp_edges(tree, sharp);
    std::map<std::int32_t, std::vector<std::size_t>> at_vertex;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        at_vertex[edges[e].a].push_back(e);
        at_vertex[edges[e].b].push_back(e);
    }
    const auto point = [&](std::int32_t v) { return mesh.vertices[static_cast<std::size_t>(v)]; };
    std::vector<std::vector<Vec3>> out;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        if (edges[e].used) continue;
        edges[e].used = true;
        // backwards from a, then forwards from b: one polyline through both
        std::vector<std::pair<std::size_t, std::int32_t>> back, forth;
        const Vec3 heading = (point(edges[e].b) - point(edges[e].a)).normalized();
        follow(mesh, at_vertex, edges, edges[e].b, heading, sharp, forth);
        follow(mesh, at_vertex, edges, edges[e].a, -heading, sharp, back);
        std::vector<ChainPiece> line;
        std::int32_t from = back.empty() ? edges[e].a : back.back().second;
        for (std::size_t k = back.size(); k-- > 0;) {
            const std::int32_t to = k == 0 ? edges[e].a : back[k - 1].second;
            line.push_back({point(from), point(to), radius * edges[back[k].first].inward});
            from = to;
        }
        line.push_back({point(edges[e].a), point(edges[e].b), radius * edges[e].inward});
        from = edges[e].b;
        for (const auto& [edge, to] : forth) {
            line.push_back({point(from), point(to), radius * edges[edge].inward});
            from = to;
        }
        const bool closed = line.size() > 2 && line.front().a == line.back().b;
        out.push_back(walk(line, closed, step));
    }
    return out;
}

std::vector<std::vector<Vec3>> trace_section(const SurfaceTree& tree, double radius, double step) {
    const TriangleMesh& mesh = tree.mesh();
    // sides of the prism by the vertex they start from: the two of a loop's corners with low y
    std::map<std::int32_t, std::pair<std::int32_t, Vec3>> next;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3& n = tree.normal(static_cast<std::int32_t>(t));
        if (std::abs(n.y()) > 0.5) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
            const Vec3 &pa = mesh.vertices[static_cast<std::size_t>(a)],
                       &pb = mesh.vertices[static_cast<std::size_t>(b)];
            if (pa.y() > 0.0 || pb.y() > 0.0) continue;
            // with the outward normal to the right: the loop's own direction
            const bool along = n.cross(pb - pa).y() > 0.0;
            next[along ? b : a] = {along ? a : b, n};
        }
    }
    std::vector<std::vector<Vec3>> out;
    while (!next.empty()) {
        std::vector<ChainPiece> line;
        for (auto at = next.begin(); at != next.end();) {
            const auto [to, n] = at->second;
            Vec3 a = mesh.vertices[static_cast<std::size_t>(at->first)],
                 b = mesh.vertices[static_cast<std::size_t>(to)];
            a.y() = b.y() = 0.0;
            line.push_back({a, b, -radius * n});
            next.erase(at);
            at = next.find(to);
        }
        std::vector<Vec3> starts = walk(line, true, step);
        // a closed line ends where it begins
        if (!starts.empty()) starts.push_back(starts.front());
        out.push_back(std::move(starts));
    }
    return out;
}

std::vector<Vec3> resample(const std::vector<Vec3>& polyline, double spacing) {
    std::vector<Vec3> out;
    std::size_t begin = 0;
    while (begin + 1 < polyline.size()) {
        // a run ends where the line turns, or at its end
        std::size_t end = begin + 1;
        double length = (polyline[end] - polyline[begin]).norm();
        while (end + 1 < polyline.size()) {
            const Vec3 in = (polyline[end] - polyline[end - 1]).normalized();
            const Vec3 next = polyline[end + 1] - polyline[end];
            if (in.dot(next.normalized()) < kStraightCos) break;
            length += next.norm();
            ++end;
        }
        // pieces of equal length, none longer than the spacing; corners stay points
        const int n = std::max(1, static_cast<int>(std::ceil(length / spacing - 1e-6)));
        double walked = 0.0;
        std::size_t at = begin;
        // the end of the run before is its beginning
        for (int k = out.empty() ? 0 : 1; k < n; ++k) {
            const double target = length * k / n;
            while (walked + (polyline[at + 1] - polyline[at]).norm() < target && at + 2 <= end) {
                walked += (polyline[at + 1] - polyline[at]).norm();
                ++at;
            }
            const Vec3 piece = polyline[at + 1] - polyline[at];
            out.push_back(polyline[at] + (target - walked) / piece.norm() * piece);
        }
        out.push_back(polyline[end]);
        begin = end;
    }
    if (out.empty()) out = polyline;
    return out;
}

}  // namespace ice
