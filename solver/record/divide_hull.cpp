// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/divide_hull.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace ice {

namespace {

// Panels below this share of size^2 [-] join others, or count as that large where none is near: a
// line load or pressure on a sliver would be large without meaning. Larger makes fewer, more uneven
// panels.
constexpr double kSmall = 0.5;

// Panels that a small panel may join: their normals are within 60 degrees (cosine [-]), their
// centres within two sizes [-]. Grid cells side by side have centres one size apart, or 1.4 across
// a corner. Looser limits join panels round an edge or far apart; stricter ones leave slivers by
// themselves.
constexpr double kSameSide = 0.5, kNeighbours = 2.0;

// Least area of a sphere's share, of a panel: spheres without area have a place, too, and no mean
// is divided by 0.
constexpr double kLeastPanelShare = 1e-9;

// region; axis that the normal points along most; its sign; cell along the other two axes
using Key = std::tuple<std::int32_t, int, bool, long, long>;

struct Sum {
    double area = 0.0, projected = 0.0;
    Vec3 center = Vec3::Zero(), normal = Vec3::Zero();  // times area
    std::int32_t region = 0;

    void add(const Sum& other) {
        area += other.area;
        projected += other.projected;
        center += other.center;
        normal += other.normal;
    }
};

struct Grid {
    double size, waterline, bow;
    int dimension;

    Key key_of(const Vec3& at, const Vec3& normal, std::int32_t region) const {
        const Vec3 n = dimension == 2 ? Vec3(normal.x(), 0.0, normal.z()) : normal;
        // Panels are cells of a grid seen along the axis that the normal is nearest to: flat parts
        // have cells of the full size, whatever their slope.
        int axis = 0;
        for (int d = 1; d < 3; ++d)
            if (std::abs(n[d]) > std::abs(n[axis])) axis = d;
        // counted from the bow and from the waterline: the same cells whatever the mesh's
        // origin
        const long x = static_cast<long>(std::floor((bow - at.x()) / size));
        const long y = dimension == 2 ? 0 : std::lround(at.y() / size);
        const long z = std::lround((at.z() - waterline) / size);
        const bool positive = n[axis] > 0.0;
        if (axis == 0) return {region, axis, positive, y, z};
        if (axis == 1) return {region, axis, positive, x, z};
        return {region, axis, positive, x, y};
    }
};

// Where the small ones go: per panel the row of the one that takes it, or its own.
std::vector<std::size_t> join_small(const std::vector<Sum>& sums, double enough, double reach) {
    std::vector<std::size_t> taker(sums.size());
    for (std::size_t k = 0; k < sums.size(); ++k) {
        taker[k] = k;
        if (sums[k].area >= enough) continue;
        double least = reach;
        for (std::size_t other = 0; other < sums.size(); ++other) {
            // only a panel that is large enough, of the same region and facing the same way
            const Sum& s = sums[other];
            if (s.area < enough || s.region != sums[k].region) continue;
            if (s.normal.normalized().dot(sums[k].normal.normalized()) < kSameSide) continue;
            const double distance = (s.center / s.area - sums[k].center / sums[k].area).norm();
            if (distance >= least) continue;
            least = distance;
            taker[k] = other;
        }
    }
    return taker;
}

}  // namespace

double panel_size(const Scene& scene) {
    double thickness = 0.0;
    for (std::size_t s = 1; s < scene.shapes.size(); ++s) {
        Eigen::AlignedBox3d box;
        for (const Vec3& v : scene.shapes[s].mesh.vertices) box.extend(v);
        if (box.isEmpty()) continue;
        Vec3 edges = box.sizes();
        if (scene.dimension == 2) edges.y() = std::numeric_limits<double>::infinity();
        // the thinnest extent of a floe, of the thickest one
        thickness = std::max(thickness, edges.minCoeff());
    }
    return std::max(thickness, 2.0 * scene.shapes[kShip].spacing);
}

HullPanels divide_hull(const Shape& hull, double size, double waterline) {
    HullPanels out;
    out.size = size;
    if (!(size > 0.0)) return out;
    const bool flat = hull.dimension == 2;
    const double whole = flat ? size : size * size;
    const Grid grid{size, waterline, hull.box.max().x(), hull.dimension};
    // spheres of one cell of the grid, facing one way, are one panel
    std::map<Key, std::size_t> rows;
    std::vector<Sum> sums;
    std::vector<std::size_t> row_of;
    for (std::size_t k = 0; k < hull.center.size(); ++k) {
        const Vec3& n = hull.normal[k];
        const std::int32_t region = hull.region.of_spheres()[k];
        const Key key = grid.key_of(hull.center[k], n, region);
        const auto [place, is_new] = rows.emplace(key, sums.size());
        if (is_new) sums.emplace_back();
        // A line load is force per length: horizontal length for a panel of the bottom (axis 2),
        // height for one of a side or an end. `across` is the factor of that projection.
        const double across = std::get<1>(key) == 2 ? std::abs(n.z()) : std::hypot(n.x(), n.y());
        const double area = std::max(hull.area[k], kLeastPanelShare * whole);
        sums[place->second].region = region;
        sums[place->second].add({area, across * area, area * hull.center[k], area * n, region});
        row_of.push_back(place->second);
    }
    // panels too small for a load of their own join a neighbour
    const std::vector<std::size_t> taker = join_small(sums, kSmall * whole, kNeighbours * size);
    for (std::size_t k = 0; k < sums.size(); ++k)
        if (taker[k] != k) sums[taker[k]].add(sums[k]);
    std::vector<std::int32_t> panel_of(sums.size(), -1);
    for (std::size_t k = 0; k < sums.size(); ++k) {
        if (taker[k] != k) continue;
        panel_of[k] = static_cast<std::int32_t>(out.panels.size());
        PanelLoad panel;
        panel.region = sums[k].region;
        // sums are weighted by area: the quotient is the centroid, the direction of the sum the
        // mean normal
        panel.center = sums[k].center / sums[k].area;
        panel.normal = sums[k].normal.normalized();
        // a sliver that found no neighbour counts as half a panel, or its line load would be
        // too large
        panel.area = std::max(sums[k].area, kSmall * whole);
        panel.length = flat ? 1.0 : std::max(sums[k].projected / size, kSmall * size);
        out.panels.push_back(panel);
    }
    for (const std::size_t row : row_of) out.of_sphere.push_back(panel_of[taker[row]]);
    return out;
}

}  // namespace ice
