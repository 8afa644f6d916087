// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/statistics/load_map.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "common/base/time_rounding.hpp"
#include "postprocess/views/faces.hpp"

namespace ice::statistics {

namespace {

// Triangles of the load map [-]; the refined mesh may have twice as many. A picture shows no more,
// and the report stays small: each triangle adds about 10 bytes before compression.
constexpr std::size_t kMostTriangles = 12000;

using Edge = std::pair<std::int32_t, std::int32_t>;

// (1 - x^2)^2 within the radius, x being the distance over the radius [-]: smooth at its end, so no
// edge of a contact's circle shows on the map.
double squared_kernel(double x_sq) { return x_sq < 1.0 ? (1.0 - x_sq) * (1.0 - x_sq) : 0.0; }

double surface_area(const TriangleMesh& mesh) {
    double area = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += mesh.area_vector(t).norm();
    return area;
}

// Triangles of a mesh by the cells of a grid, to find those near a point.
class Neighbours {
public:
    Neighbours(const std::vector<Vec3>& points, double cell) : cell_(cell) {
        for (std::size_t k = 0; k < points.size(); ++k) cells_[key(points[k])].push_back(k);
    }
    template <class Work>
    void for_near(const Vec3& p, const Work& work) const {
        const auto at = key(p);
        for (long i = -1; i <= 1; ++i)
            for (long j = -1; j <= 1; ++j)
                for (long k = -1; k <= 1; ++k) {
                    const auto found = cells_.find({at[0] + i, at[1] + j, at[2] + k});
                    if (found == cells_.end()) continue;
                    for (const std::size_t t : found->second) work(t);
                }
    }

private:
    std::array<long, 3> key(const Vec3& p) const {
        return {std::lround(p.x() / cell_), std::lround(p.y() / cell_), std::lround(p.z() / cell_)};
    }
    double cell_;
    std::map<std::array<long, 3>, std::vector<std::size_t>> cells_;
};

// The mesh's data for spreading a force.
struct Surface {
    std::vector<Vec3> center, normal;  // normal: unit
    std::vector<double> area;
    bool flat = false;  // 2D: y does not count

    Surface(const TriangleMesh& mesh, bool is_flat) : flat(is_flat) {
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const Vec3 vector = mesh.area_vector(t);
            area.push_back(vector.norm());
            normal.push_back(area.back() > 0.0 ? Vec3(vector / area.back()) : Vec3(Vec3::Zero()));
            center.push_back(
                place((mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0));
        }
    }
    Vec3 place(const Vec3& p) const { return flat ? Vec3(p.x(), 0.0, p.z()) : p; }
    // the surface's own sharp corners are rounded by its spheres: half of all directions may press
    bool faces(std::size_t t, const Vec3& push) const { return normal[t].dot(push) < 0.0; }
};

void spread(const Surface& surface, const Neighbours& near, double radius, const Vec3& point,
            const Vec3& push, std::vector<double>& load) {
    const Vec3 p = surface.place(point);
    const double force = push.norm();
    std::vector<std::pair<std::size_t, double>> weights;
    double sum = 0.0;
    near.for_near(p, [&](std::size_t t) {
        // A smooth kernel with the weights normalised by area: the map's integral is the force,
        // whatever the mesh.
        const double weight =
            squared_kernel((surface.center[t] - p).squaredNorm() / (radius * radius));
        if (weight <= 0.0 || !surface.faces(t, push)) return;
        weights.emplace_back(t, weight);
        sum += surface.area[t] * weight;
    });
    // Without a triangle that faces the push within the radius the nearest one takes the whole
    // force: none is lost.
    if (sum > 0.0) {
        for (const auto& [t, weight] : weights) load[t] += force * weight / sum;
        return;
    }
    std::size_t nearest = load.size();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < load.size(); ++t) {
        const double distance = (surface.center[t] - p).squaredNorm();
        if (surface.area[t] > 0.0 && distance < least) {
            least = distance;
            nearest = t;
        }
    }
    if (nearest < load.size()) load[nearest] += force / surface.area[nearest];
}

// Distance of neighbouring spheres on the surface, were they spread evenly in hexagons.
double sphere_spacing(const RunShape& hull, double area) {
    if (hull.centers.empty()) return 0.0;
    return std::sqrt(2.0 / std::sqrt(3.0) * area / static_cast<double>(hull.centers.size()));
}

// Cuts each edge longer than `longest` [m] in two; false where none is.
bool split_once(const TriangleMesh& fine, double longest, TriangleMesh& next) {
    next.vertices = fine.vertices;
    next.region_names = fine.region_names;
    std::map<Edge, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
        const auto row = static_cast<std::int32_t>(next.vertices.size());
        const auto [place, is_new] = middles.emplace(Edge(std::min(a, b), std::max(a, b)), row);
        if (is_new)
            next.vertices.emplace_back(0.5 * (fine.vertices[static_cast<std::size_t>(a)] +
                                              fine.vertices[static_cast<std::size_t>(b)]));
        return place->second;
    };
    bool changed = false;
    for (std::size_t t = 0; t < fine.triangles.size(); ++t) {
        std::array<double, 3> length{};
        for (int k = 0; k < 3; ++k)
            length[static_cast<std::size_t>(k)] =
                (fine.corner(t, (k + 1) % 3) - fine.corner(t, k)).norm();
        // the longest edge a-b first: the cuts from its middle leave no needles
        const std::size_t first = static_cast<std::size_t>(
            std::max_element(length.begin(), length.end()) - length.begin());
        if (length[first] <= longest) {
            next.triangles.push_back(fine.triangles[t]);
            next.region.push_back(fine.region[t]);
            continue;
        }
        changed = true;
        const auto corner = [&](std::size_t k) { return fine.triangles[t][(first + k) % 3]; };
        const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
            next.triangles.push_back({a, b, c});
            next.region.push_back(fine.region[t]);
        };
        const std::int32_t a = corner(0), b = corner(1), c = corner(2), ab = middle(a, b);
        // Edges are cut by their length alone, which both neighbours see alike: no vertex lies
        // within a neighbour's edge.
        const bool long_bc = length[(first + 1) % 3] > longest;
        const bool long_ca = length[(first + 2) % 3] > longest;
        const auto add_side = [&](std::int32_t from, std::int32_t to, bool is_long) {
            if (!is_long) return add(ab, from, to);
            const std::int32_t half_way = middle(from, to);
            add(ab, from, half_way);
            add(ab, half_way, to);
        };
        add_side(b, c, long_bc);
        add_side(c, a, long_ca);
    }
    return changed;
}

}  // namespace

TriangleMesh refine_mesh(const TriangleMesh& mesh, double longest, std::size_t most) {
    TriangleMesh fine = mesh;
    if (fine.region.size() != fine.triangles.size()) fine.region.assign(fine.triangles.size(), 0);
    while (true) {
        TriangleMesh next;
        // The last mesh within the bound: a half-refined mesh would show panels of two sizes.
        if (!split_once(fine, longest, next) || next.triangles.size() > most) return fine;
        fine = std::move(next);
    }
}

LoadMap make_load_map(const RunData& run, double from) {
    LoadMap map;
    if (run.header.shapes.empty() || run.header.shapes[0].mesh.triangles.empty()) return map;
    const RunShape& hull = run.header.shapes[0];
    const double area = surface_area(hull.mesh);
    Eigen::AlignedBox3d box;
    for (const Vec3& v : hull.mesh.vertices) box.extend(v);
    // Radius [m]: 1.5 times the spheres' distance, or 1 % of the ship's length where spheres are
    // finer. A larger one blurs the map, a smaller one shows single spheres; the integral stays the
    // same.
    // A force is recorded for a sphere: spread over less than the spheres' distance the map would
    // show the spheres.
    map.radius = std::max(1.5 * sphere_spacing(hull, area), 0.01 * box.sizes().x());
    map.mesh = refine_mesh(views::simplify_mesh(hull.mesh, kMostTriangles), map.radius,
                           2 * kMostTriangles);
    const bool flat = run.header.dimension == 2;
    const double breadth = flat ? box.sizes().y() : 1.0;
    const Surface surface(map.mesh, flat);
    // cells of two radii: all that is nearer than a radius is in the cells around
    const Neighbours near(surface.center, 2.0 * map.radius);
    map.load.assign(map.mesh.triangles.size(), 0.0);
    double time = 0.0;
    for (std::size_t f = 1; f < run.frames.size(); ++f) {
        const double begin = run.frames[f - 1].time, end = run.frames[f].time;
        if (begin < from - kTimeRounding) continue;
        if (time == 0.0) map.from = begin;
        map.to = end;
        time += end - begin;
        for (const HullContact& c : run.frames[f].hull_contacts)
            if (c.normal_force.squaredNorm() > 0.0)
                spread(surface, near, map.radius, c.point, breadth * (end - begin) * c.normal_force,
                       map.load);
    }
    for (std::size_t t = 0; t < map.load.size(); ++t) {
        if (time > 0.0) map.load[t] /= time;
        map.force += map.load[t] * surface.area[t];
    }
    return map;
}

namespace {

// two digits, so that legends need no more
double round_up(double value) {
    const double digit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
    return std::ceil(value / digit * (1.0 - 1e-12)) * digit;
}

}  // namespace

double scale_end(const LoadMap& map) {
    std::vector<std::pair<double, double>> loaded;  // load, area
    double area = 0.0;
    for (std::size_t t = 0; t < map.load.size(); ++t)
        if (map.load[t] > 0.0) {
            loaded.emplace_back(map.load[t], map.mesh.area_vector(t).norm());
            area += loaded.back().second;
        }
    std::sort(loaded.begin(), loaded.end());
    double below = 0.0;
    for (const auto& [load, part] : loaded) {
        below += part;
        if (below >= 0.99 * area) return round_up(load);
    }
    return 0.0;
}

}  // namespace ice::statistics
