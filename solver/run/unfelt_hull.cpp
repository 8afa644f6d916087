// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/run/unfelt_hull.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ice {

namespace {

// Parts of a triangle's side at most [-], 5000 points. Fewer see less of a coarse mesh's large
// triangles; more only take time.
constexpr int kMostParts = 100;

// Seats and tips of the hull's spheres, by x.
std::vector<Vec3> places_felt(const Shape& hull) {
    // where a hull's sphere touches from inside, and the sharp tip of an edge or vertex
    std::vector<Vec3> out;
    for (std::size_t k = 0; k < hull.center.size(); ++k) {
        out.push_back(hull.center[k] + hull.radius[k] * hull.normal[k]);
        if (hull.cone[k].count > 0)
            out.push_back(hull.center[k] + hull.cone[k].apex_distance * hull.normal[k]);
    }
    std::sort(out.begin(), out.end(), [](const Vec3& l, const Vec3& r) { return l.x() < r.x(); });
    return out;
}

// From p's place along x both ways, as far as a nearer one may be.
double distance_to_nearest(const std::vector<Vec3>& places, const Vec3& p) {
    const auto middle = std::lower_bound(places.begin(), places.end(), p.x(),
                                         [](const Vec3& s, double x) { return s.x() < x; });
    double least = std::numeric_limits<double>::infinity();
    // Sorted by x: a place farther away along x alone than the best one ends the search.
    const auto is_nearer = [&](const Vec3& s) {
        const double dx = s.x() - p.x();
        if (dx * dx >= least) return false;
        least = std::min(least, (s - p).squaredNorm());
        return true;
    };
    for (auto s = middle; s != places.end() && is_nearer(*s);) ++s;
    for (auto s = middle; s != places.begin() && is_nearer(*(s - 1));) --s;
    return std::sqrt(least);
}

// Calls visit(p, area) for the middles of equal parts of a triangle, at most `apart` [m] long.
template <class Visit>
void for_each_part(const Vec3& a, const Vec3& b, const Vec3& c, double apart, const Visit& visit) {
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const int n = static_cast<int>(std::clamp(std::ceil(longest / apart), 1.0, 1.0 * kMostParts));
    const double area = 0.5 * (b - a).cross(c - a).norm() / (n * n);
    // n x n equal triangles: upright ones, and between them ones that are upside down
    const Vec3 u = (b - a) / n, v = (c - a) / n;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n - i; ++j) {
            visit(Vec3(a + (i + 1.0 / 3.0) * u + (j + 1.0 / 3.0) * v), area);
            if (i + j + 1 < n) visit(Vec3(a + (i + 2.0 / 3.0) * u + (j + 2.0 / 3.0) * v), area);
        }
}

}  // namespace

UnfeltHull measure_unfelt_hull(const Scene& scene, double low, double high) {
    const Shape& hull = scene.shapes[0];
    const std::vector<Vec3> places = places_felt(hull);
    const double rise = scene.bodies.position[kShip].z();
    UnfeltHull out;
    double unfelt = 0.0;
    for (const auto& t : hull.mesh.triangles) {
        const Vec3 &a = hull.mesh.vertices[static_cast<std::size_t>(t[0])],
                   &b = hull.mesh.vertices[static_cast<std::size_t>(t[1])],
                   &c = hull.mesh.vertices[static_cast<std::size_t>(t[2])];
        // triangles wholly above or below the band of heights where ice is
        if (std::min({a.z(), b.z(), c.z()}) + rise > high) continue;
        if (std::max({a.z(), b.z(), c.z()}) + rise < low) continue;
        for_each_part(a, b, c, 0.5 * hull.spacing, [&](const Vec3& p, double area) {
            if (p.z() + rise < low || p.z() + rise > high) return;
            out.area += area;
            const double distance = distance_to_nearest(places, p);
            // ice that touches here is felt by a sphere at most one spacing away
            if (distance <= hull.spacing) return;
            unfelt += area;
            if (distance <= out.distance) return;
            out.distance = distance;
            out.at = p;
        });
    }
    if (out.area > 0.0) out.share = unfelt / out.area;
    return out;
}

}  // namespace ice
