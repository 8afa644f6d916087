// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/cut_faces.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <exception>
#include <map>

namespace ice {

namespace {

using Kernel = CGAL::Epeck;
using Point = Kernel::Point_3;
using Flat = Kernel::Point_2;
using Triple = std::array<std::int32_t, 3>;
struct Number {
    std::int32_t of_vertex = -1;  // in the mesh, where it is known
};
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<Number, Kernel>;
using Face = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Plan = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>, CGAL::Exact_intersections_tag>;
using Place = std::array<double, 3>;

// What others cut into a triangle: walks of one point and more, in its plane.
using Cuts = std::vector<std::vector<Point>>;

Point exact(const Vec3& v) { return Point(v.x(), v.y(), v.z()); }

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
        Place out;
        // the exact value decides: however a point was made, equal points get equal bits
        out[static_cast<std::size_t>(u)] = CGAL::to_double(CGAL::exact(p.x()));
        out[static_cast<std::size_t>(v)] = CGAL::to_double(CGAL::exact(p.y()));
        out[static_cast<std::size_t>(drop_)] = CGAL::to_double(CGAL::exact(w));
        return out;
    }

private:
    Point origin_;
    Kernel::Vector_3 normal_;
    int drop_ = 0;
    bool positive_ = true;
};

class Cutter {
public:
    Cutter(const TriangleMesh& mesh, const std::vector<std::pair<std::size_t, std::size_t>>& pairs)
        : mesh_(mesh) {
        for (const auto& [s, t] : pairs) {
            const auto common = CGAL::intersection(triangle(s), triangle(t));
            if (!common) continue;
            const std::vector<Point> walk = boost::apply_visitor(Walk(), *common);
            cuts_[s].push_back(walk);
            cuts_[t].push_back(walk);
        }
        for (const auto& [t, cuts] : cuts_)
            for (const std::int32_t v : mesh.triangles[t])
                known_.try_emplace(place(mesh.vertices[static_cast<std::size_t>(v)]), v);
    }

    CutMesh cut() {
        CutMesh out;
        out.mesh.vertices = mesh_.vertices;
        out.mesh.region_names = mesh_.region_names;
        const auto add = [&](const Triple& piece, std::size_t t) {
            out.mesh.triangles.push_back(piece);
            out.mesh.region.push_back(mesh_.region[t]);
            out.source.push_back(static_cast<std::int32_t>(t));
        };
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            const auto at = cuts_.find(t);
            if (at == cuts_.end()) {
                add(mesh_.triangles[t], t);
                continue;
            }
            for (const Triple& piece : pieces(t, at->second, out.mesh.vertices)) add(piece, t);
        }
        return out;
    }

private:
    Kernel::Triangle_3 triangle(std::size_t t) const {
        return {exact(mesh_.corner(t, 0)), exact(mesh_.corner(t, 1)), exact(mesh_.corner(t, 2))};
    }
    static Place place(const Vec3& v) { return {v.x() + 0.0, v.y() + 0.0, v.z() + 0.0}; }

    std::vector<Triple> pieces(std::size_t t, const Cuts& cuts, std::vector<Vec3>& vertices) {
        const Kernel::Triangle_3 whole = triangle(t);
        const Projection look(whole[0], whole[1], whole[2]);
        if (look.flat()) return {mesh_.triangles[t]};
        Plan plan;
        for (int k = 0; k < 3; ++k)
            plan.insert(look.down(whole[k]))->info().of_vertex =
                mesh_.triangles[t][static_cast<std::size_t>(k)];
        const auto insert = [&](const Point& p) { return plan.insert(look.down(p)); };
        for (const std::vector<Point>& walk : cuts) {
            auto last = insert(walk.front());
            for (std::size_t k = 1; k < walk.size(); ++k) {
                const auto next = insert(walk[k]);
                if (next != last) plan.insert_constraint(last, next);
                last = next;
            }
        }
        for (const auto v : plan.finite_vertex_handles()) {
            if (v->info().of_vertex >= 0) continue;
            const Place at = look.up(v->point());
            const auto [known, fresh] =
                known_.try_emplace({at[0] + 0.0, at[1] + 0.0, at[2] + 0.0},
                                   static_cast<std::int32_t>(vertices.size()));
            if (fresh) vertices.emplace_back(at[0], at[1], at[2]);
            v->info().of_vertex = known->second;
        }
        std::vector<Triple> out;
        for (const auto f : plan.finite_face_handles()) {
            Triple piece;
            for (int k = 0; k < 3; ++k)
                piece[static_cast<std::size_t>(k)] = f->vertex(k)->info().of_vertex;
            if (!look.positive()) std::swap(piece[1], piece[2]);
            if (piece[0] != piece[1] && piece[1] != piece[2] && piece[2] != piece[0])
                out.push_back(piece);
        }
        return out;
    }

    const TriangleMesh& mesh_;
    std::map<std::size_t, Cuts> cuts_;
    std::map<Place, std::int32_t> known_;  // vertices of triangles that are cut, by their place
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
