// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/cut_faces.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <exception>
#include <map>

#include "common/base/parallel.hpp"

namespace ice {

namespace {

// Exact constructions: a rounded intersection point would leave the plane of both triangles, and
// the pieces of neighbours would not fit.
using Kernel = CGAL::Epeck;
using Point = Kernel::Point_3;
using Flat = Kernel::Point_2;
using Triple = std::array<std::int32_t, 3>;
struct Number {
    bool known = false;
    std::int32_t of_vertex = 0;
};
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<Number, Kernel>;
using Face = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Plan = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>, CGAL::Exact_intersections_tag>;
using Place = std::array<double, 3>;

Point exact(const Vec3& v) { return Point(v.x(), v.y(), v.z()); }

// The common part of two triangles as a walk over its points: a point, a segment or, where they lie
// in one plane, a closed polygon.
struct Walk {
    std::vector<Point> operator()(const Point& p) const { return {p}; }
    std::vector<Point> operator()(const Kernel::Segment_3& s) const {
        return {s.source(), s.target()};
    }
    std::vector<Point> operator()(const Kernel::Triangle_3& t) const {
        return {t[0], t[1], t[2], t[0]};
    }
    std::vector<Point> operator()(const std::vector<Point>& polygon) const {
        std::vector<Point> out = polygon;
        out.push_back(polygon.front());
        return out;
    }
};

// A triangle seen along the axis nearest to its normal.
class Projection {
public:
    Projection(const Point& a, const Point& b, const Point& c)
        : origin_(a), normal_(CGAL::cross_product(b - a, c - a)) {
        const Vec3 n(CGAL::to_double(normal_.x()), CGAL::to_double(normal_.y()),
                     CGAL::to_double(normal_.z()));
        n.cwiseAbs().maxCoeff(&drop_);
        positive_ = CGAL::is_positive(normal_[drop_]);
    }
    bool flat() const { return CGAL::is_zero(normal_[drop_]); }
    bool positive() const { return positive_; }
    Flat down(const Point& p) const { return Flat(p[(drop_ + 1) % 3], p[(drop_ + 2) % 3]); }
    Place up(const Flat& p) const {
        const int u = (drop_ + 1) % 3, v = (drop_ + 2) % 3;
        const Kernel::FT w = origin_[drop_] - (normal_[u] * (p.x() - origin_[u]) +
                                               normal_[v] * (p.y() - origin_[v])) /
                                                  normal_[drop_];
        Place out{};
        // the exact value decides: however a point was made, equal points get equal bits
        out[static_cast<std::size_t>(u)] = CGAL::to_double(CGAL::exact(p.x()));
        out[static_cast<std::size_t>(v)] = CGAL::to_double(CGAL::exact(p.y()));
        out[static_cast<std::size_t>(drop_)] = CGAL::to_double(CGAL::exact(w));
        for (double& x : out) x += 0.0;  // no -0
        return out;
    }

private:
    Point origin_;
    Kernel::Vector_3 normal_;
    int drop_ = 0;
    bool positive_ = true;
};

// The parts of one cut triangle.
struct Pieces {
    std::vector<Place> fresh;       // corners that the triangle did not have
    std::vector<Triple> triangles;  // vertices of the mesh; -1, -2, ... are fresh ones
};

// CGAL's lazy numbers may be shared among threads, but are cheapest once their exact values are
// known: each pair's points are made by one thread, exactly, and only read from then on.
class Cutter {
public:
    Cutter(const TriangleMesh& mesh, const std::vector<std::pair<std::size_t, std::size_t>>& pairs)
        : mesh_(mesh), walks_(pairs.size()) {
        parallel_for(pairs.size(), 16, [&](std::size_t k) {
            const auto common =
                CGAL::intersection(triangle(pairs[k].first), triangle(pairs[k].second));
            if (common) walks_[k] = boost::apply_visitor(Walk(), *common);
            for (const Point& p : walks_[k]) CGAL::exact(p);
        });
        // triangle -> the pairs it is in: each triangle is cut once, by all of its pairs
        std::map<std::size_t, std::vector<std::size_t>> cuts;
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            if (walks_[k].empty()) continue;
            cuts[pairs[k].first].push_back(k);
            cuts[pairs[k].second].push_back(k);
        }
        cuts_.assign(cuts.begin(), cuts.end());
    }

    CutMesh cut() {
        std::vector<Pieces> pieces(cuts_.size());
        parallel_for(cuts_.size(), 16,
                     [&](std::size_t k) { pieces[k] = cut_one(cuts_[k].first, cuts_[k].second); });
        CutMesh out;
        out.mesh.vertices = mesh_.vertices;
        out.mesh.region_names = mesh_.region_names;
        const auto add = [&](const Triple& piece, std::size_t t) {
            // a piece without area
            if (piece[0] == piece[1] || piece[1] == piece[2] || piece[2] == piece[0]) return;
            out.mesh.triangles.push_back(piece);
            out.mesh.region.push_back(mesh_.region[t]);
            out.source.push_back(static_cast<std::int32_t>(t));
        };
        std::map<Place, std::int32_t> known;  // corners of triangles that are cut, by their place
        for (const auto& [t, cuts] : cuts_)
            for (const std::int32_t v : mesh_.triangles[t])
                known.try_emplace(place(mesh_.vertices[static_cast<std::size_t>(v)]), v);
        std::size_t next = 0;
        // both lists are in the order of the triangles
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            if (next == cuts_.size() || cuts_[next].first != t) {
                add(mesh_.triangles[t], t);
                continue;
            }
            const Pieces& of = pieces[next++];
            std::vector<std::int32_t> number;
            for (const Place& at : of.fresh) {
                const auto vertex = static_cast<std::int32_t>(out.mesh.vertices.size());
                const auto [found, is_new] = known.try_emplace(at, vertex);
                if (is_new) out.mesh.vertices.emplace_back(at[0], at[1], at[2]);
                number.push_back(found->second);
            }
            for (Triple piece : of.triangles) {
                // new corners have numbers below 0 until all are known
                for (std::int32_t& v : piece)
                    if (v < 0) v = number[static_cast<std::size_t>(-1 - v)];
                add(piece, t);
            }
        }
        return out;
    }

private:
    Kernel::Triangle_3 triangle(std::size_t t) const {
        return {exact(mesh_.corner(t, 0)), exact(mesh_.corner(t, 1)), exact(mesh_.corner(t, 2))};
    }
    static Place place(const Vec3& v) { return {v.x() + 0.0, v.y() + 0.0, v.z() + 0.0}; }

    Pieces cut_one(std::size_t t, const std::vector<std::size_t>& cuts) const {
        const Kernel::Triangle_3 whole = triangle(t);
        const Projection look(whole[0], whole[1], whole[2]);
        // In the plane of the triangle, without the coordinate along its largest normal component:
        // exact, no point is rounded.
        if (look.flat()) return {{}, {mesh_.triangles[t]}};
        Plan plan;
        for (int k = 0; k < 3; ++k)
            plan.insert(look.down(whole[k]))->info() = {
                true, mesh_.triangles[t][static_cast<std::size_t>(k)]};
        // the common part of each pair is a constraint: the pieces have it as edges
        for (const std::size_t cut : cuts) {
            const std::vector<Point>& walk = walks_[cut];
            auto last = plan.insert(look.down(walk.front()));
            for (std::size_t k = 1; k < walk.size(); ++k) {
                const auto next = plan.insert(look.down(walk[k]));
                if (next != last) plan.insert_constraint(last, next);
                last = next;
            }
        }
        Pieces out;
        for (const auto v : plan.finite_vertex_handles()) {
            // Vertices on a cut are shared by both triangles of the pair: places are compared
            // exactly later and merged.
            if (v->info().known) continue;
            out.fresh.push_back(look.up(v->point()));
            v->info() = {true, -static_cast<std::int32_t>(out.fresh.size())};
        }
        for (const auto f : plan.finite_face_handles()) {
            Triple piece;
            for (int k = 0; k < 3; ++k)
                piece[static_cast<std::size_t>(k)] = f->vertex(k)->info().of_vertex;
            // The projection may mirror; pieces keep the triangle's side.
            if (!look.positive()) std::swap(piece[1], piece[2]);
            out.triangles.push_back(piece);
        }
        return out;
    }

    const TriangleMesh& mesh_;
    std::vector<std::vector<Point>> walks_;  // of each pair: one point and more, in both planes
    std::vector<std::pair<std::size_t, std::vector<std::size_t>>> cuts_;  // triangle, pairs
};

}  // namespace

std::optional<CutMesh> cut_faces(const TriangleMesh& mesh,
                                 const std::vector<std::pair<std::size_t, std::size_t>>& pairs) {
    try {
        return Cutter(mesh, pairs).cut();
    } catch (const std::exception&) {  // CGAL gives up: the caller tries another way
        return std::nullopt;
    }
}

}  // namespace ice
