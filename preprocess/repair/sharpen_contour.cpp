// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/sharpen_contour.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "common/base/parallel.hpp"
#include "common/geometry/edge_table.hpp"
#include "preprocess/clean/find_self_intersections.hpp"

namespace ice {

namespace {

// Cosine of the angle between two faces [-] from which on they make a crease, 30 degrees. Lower
// angles would move vertices of smooth bilges, higher ones leave chines cut off.
constexpr double kCosine = 0.866;
// Distance over a cell [-] within which a place is on the source. A larger value sharpens edges
// where the contour has closed gaps of the source, a smaller one leaves edges cut off.
constexpr double kOnSurface = 0.05;
// Eigenvalue of the planes' normals over the largest [-] below which a direction is not determined
// by them: the vertex then keeps its place along it. A larger value leaves blunt corners cut off, a
// smaller one moves vertices far along planes that are almost parallel.
constexpr double kFlatPart = 0.05;
// Twice the area of the least triangle, over a cell's area [-]. Smaller triangles have no reliable
// normal. A larger value takes back more moves, a smaller one keeps slivers.
constexpr double kSliver = 0.02;
// Longest move [cells]; the longest edge of a contour has 1.7, so that a vertex stays beside its
// cell. A larger value folds more triangles, a smaller one leaves sharp edges cut off.
constexpr double kLongest = 1.5;
// Passes over the creases [-]: an edge that was turned makes room for further moves. Fewer leave
// more of the creases cut off, more take longer.
constexpr int kPasses = 2;
// Rounds of taking bad moves back [-]; where they do not end, all moves are taken back. Fewer leave
// more contours blunt, more take longer.
constexpr int kMostTakenBack = 4;

// The plane of the source at a vertex of the contour.
struct TangentPlane {
    Vec3 point, normal;
    bool near = false;  // the vertex lies on the source
};

// A vertex, the place it is moved to, and the length of that.
struct Move {
    std::int32_t vertex = -1;
    std::vector<std::int32_t> across;  // ends of the edge, corners of the triangle that is cut off
    Vec3 to = Vec3::Zero();
    double length = 0.0;
};

class Sharpener {
public:
    Sharpener(TriangleMesh& contour, const SurfaceTree& source, double cell)
        : mesh_(contour),
          source_(source),
          cell_(cell),
          before_(contour.vertices),
          triangles_before_(contour.triangles) {
        planes_.resize(mesh_.vertices.size());
        parallel_for(planes_.size(), 100, [&](std::size_t k) {
            const Foot foot = source_.closest(before_[k]);
            planes_[k] = {foot.point, source_.normal(foot.triangle),
                          foot.distance < kOnSurface * cell_};
        });
        moved_.assign(mesh_.vertices.size(), 0);
    }

    std::int64_t run() {
        find_triangles_around();
        // Corners first: an edge move would take away the crossing of three planes that a corner
        // needs.
        move_all(corner_moves());
        for (int pass = 0; pass < kPasses; ++pass) {
            find_triangles_around();
            move_all(crease_moves());
            turn_edges();
        }
        // A move taken back may expose another fault; if the faults do not end, the contour stays
        // as it was.
        for (int round = 0; round < kMostTakenBack; ++round)
            if (!take_back()) return std::count(moved_.begin(), moved_.end(), 1);
        mesh_.vertices = before_;
        mesh_.triangles = triangles_before_;
        return 0;
    }

private:
    void find_triangles_around() {
        turned_.assign(mesh_.triangles.size(), 0);
        around_.assign(mesh_.vertices.size(), {});
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
            for (const std::int32_t v : mesh_.triangles[t])
                around_[static_cast<std::size_t>(v)].push_back(t);
    }

    bool apart(std::int32_t a, std::int32_t b) const {
        const TangentPlane &p = plane(a), &q = plane(b);
        return p.near && q.near && p.normal.dot(q.normal) < kCosine;
    }
    const TangentPlane& plane(std::int32_t v) const { return planes_[static_cast<std::size_t>(v)]; }
    const Vec3& at(std::int32_t v) const { return before_[static_cast<std::size_t>(v)]; }

    // The point nearest to `from` in which the planes meet, as far as they differ.
    Vec3 meeting(const std::vector<std::int32_t>& planes, const Vec3& from) const {
        Mat3 products = Mat3::Zero();
        Vec3 right = Vec3::Zero();
        for (const std::int32_t v : planes) {
            const TangentPlane& p = plane(v);
            products += p.normal * p.normal.transpose();
            right += p.normal * p.normal.dot(p.point - from);
        }
        // Least squares over the planes; directions with small eigenvalues are left out, so that
        // two planes give the nearest point of their line and one plane the foot on it.
        const Eigen::SelfAdjointEigenSolver<Mat3> solver(products);
        Vec3 step = Vec3::Zero();
        for (int k = 0; k < 3; ++k)
            if (solver.eigenvalues()[k] > kFlatPart * solver.eigenvalues()[2])
                step += solver.eigenvectors().col(k) * solver.eigenvectors().col(k).dot(right) /
                        solver.eigenvalues()[k];
        return from + step;
    }

    // Each of the vertices to where their planes meet, if that is a place on the source.
    void propose(const std::vector<std::int32_t>& movable, const std::vector<std::int32_t>& planes,
                 std::vector<Move>& out) const {
        for (const std::int32_t v : movable) {
            const Vec3 to = meeting(planes, at(v));
            const double length = (to - at(v)).norm();
            if (length < kLongest * cell_ && source_.closest(to).distance < kOnSurface * cell_)
                out.push_back({v, planes, to, length});
        }
    }

    std::vector<Move> corner_moves() const {
        std::vector<Move> out;
        for (std::size_t k = 0; k < around_.size(); ++k) {
            const auto v = static_cast<std::int32_t>(k);
            // Three vertices with planes that differ pairwise are a corner; the ring is of
            // neighbours beyond a crease from v.
            std::vector<std::int32_t> ring;
            for (const std::size_t t : around_[k])
                for (const std::int32_t other : mesh_.triangles[t])
                    if (apart(v, other)) ring.push_back(other);
            for (const std::int32_t other : ring)
                if (apart(ring.front(), other)) {
                    propose({v}, {v, ring.front(), other}, out);
                    break;
                }
        }
        return out;
    }

    std::vector<Move> crease_moves() const {
        std::vector<Move> out;
        for (const MeshEdge& e : edge_table(mesh_))
            if (apart(e.a, e.b)) propose({e.a, e.b}, {e.a, e.b}, out);
        return out;
    }

    // The shortest first: where one end of a cut edge has moved, the others may stay.
    void move_all(std::vector<Move> moves) {
        std::stable_sort(moves.begin(), moves.end(),
                         [](const Move& l, const Move& r) { return l.length < r.length; });
        for (const Move& move : moves) {
            const auto done = [&](std::int32_t v) { return moved_[static_cast<std::size_t>(v)]; };
            if (std::any_of(move.across.begin(), move.across.end(), done)) continue;
            const auto v = static_cast<std::size_t>(move.vertex);
            mesh_.vertices[v] = move.to;
            moved_[v] = 1;
            const auto& around = around_[v];
            // a contour with a blunt edge is better than one that is folded
            if (std::any_of(around.begin(), around.end(), [&](std::size_t t) { return is_bad(t); }))
                mesh_.vertices[v] = before_[v], moved_[v] = 0;
        }
    }

    // Edges that still cut a crease, where the corners beside them lie on it: turned along it.
    void turn_edges() {
        for (const MeshEdge& e : edge_table(mesh_)) {
            if (!apart(e.a, e.b) || moved(e.a) || moved(e.b)) continue;
            const auto s = static_cast<std::size_t>(e.triangles[0]);
            const auto t = static_cast<std::size_t>(e.triangles[1]);
            const std::int32_t c = opposite(s, e), d = opposite(t, e);
            if (turned_[s] || turned_[t] || !moved(c) || !moved(d) || are_joined(c, d)) continue;
            const auto of_s = mesh_.triangles[s], of_t = mesh_.triangles[t];
            std::replace(mesh_.triangles[s].begin(), mesh_.triangles[s].end(), e.b, d);
            std::replace(mesh_.triangles[t].begin(), mesh_.triangles[t].end(), e.a, c);
            // turned back where the new pair is worse
            if (is_bad(s) || is_bad(t))
                mesh_.triangles[s] = of_s, mesh_.triangles[t] = of_t;
            else
                turned_[s] = turned_[t] = 1;
        }
    }

    std::int32_t opposite(std::size_t t, const MeshEdge& e) const {
        const auto& [a, b, c] = mesh_.triangles[t];
        return a + b + c - e.a - e.b;
    }
    bool moved(std::int32_t v) const { return moved_[static_cast<std::size_t>(v)] != 0; }
    bool are_joined(std::int32_t c, std::int32_t d) const {
        const auto& around = around_[static_cast<std::size_t>(c)];
        return std::any_of(around.begin(), around.end(), [&](std::size_t t) {
            const auto& corners = mesh_.triangles[t];
            return std::find(corners.begin(), corners.end(), d) != corners.end();
        });
    }

    // Moves after which a triangle is a sliver, folded over or crosses another. @returns any
    bool take_back() {
        std::vector<std::size_t> bad;
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
            if (is_bad(t)) bad.push_back(t);
        // once for all moves: a search after each would take most of the time
        for (const auto& [s, t] : find_self_intersections(mesh_)) bad.insert(bad.end(), {s, t});
        bool any = false;
        for (const std::size_t t : bad)
            for (const std::int32_t corner : mesh_.triangles[t]) {
                const auto v = static_cast<std::size_t>(corner);
                any = any || moved_[v];
                mesh_.vertices[v] = before_[v];
                moved_[v] = 0;
            }
        return any;
    }

    bool is_bad(std::size_t t) const {
        const auto& [a, b, c] = mesh_.triangles[t];
        if (!moved(a) && !moved(b) && !moved(c)) return false;
        const auto twice_area = [](const Vec3& p, const Vec3& q, const Vec3& r) {
            return (q - p).cross(r - p);
        };
        const Vec3 was = twice_area(at(a), at(b), at(c));
        const Vec3 is = twice_area(mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2));
        // A triangle folds over if it faces against the source's surface at its corners.
        const Vec3 outward = plane(a).normal + plane(b).normal + plane(c).normal;
        return is.dot(outward) <= 0.0 ||
               is.norm() < std::min(kSliver * cell_ * cell_, 0.5 * was.norm());
    }

    TriangleMesh& mesh_;
    const SurfaceTree& source_;
    double cell_;
    std::vector<Vec3> before_;
    std::vector<std::array<std::int32_t, 3>> triangles_before_;
    std::vector<TangentPlane> planes_;
    std::vector<std::uint8_t> moved_;
    std::vector<std::uint8_t> turned_;              // triangles of edges that were turned
    std::vector<std::vector<std::size_t>> around_;  // triangles at each vertex
};

}  // namespace

std::int64_t sharpen_contour(TriangleMesh& contour, const SurfaceTree& source, double cell) {
    return Sharpener(contour, source, cell).run();
}

}  // namespace ice
