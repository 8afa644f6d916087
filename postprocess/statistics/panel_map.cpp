// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/statistics/panel_map.hpp"

#include <algorithm>
#include <numeric>

namespace ice::statistics {

namespace {

// Finds the nearest of many points: they are in order of x, and those beyond the best in x alone
// are ignored.
class NearestPoint {
public:
    NearestPoint(const std::vector<Vec3>& points, std::size_t count) : points_(points) {
        order_.resize(count);
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
            return points[a].x() < points[b].x();
        });
    }
    std::size_t operator()(const Vec3& at) const {
        const auto middle =
            std::lower_bound(order_.begin(), order_.end(), at.x(),
                             [&](std::size_t k, double x) { return points_[k].x() < x; });
        std::size_t best = order_.front();
        double least = (points_[best] - at).squaredNorm();
        const auto try_one = [&](std::size_t k) {
            // points are in order of x: beyond this one all are farther away in x alone
            const double dx = points_[k].x() - at.x();
            if (dx * dx > least) return false;
            const double distance = (points_[k] - at).squaredNorm();
            if (distance < least) {
                least = distance;
                best = k;
            }
            return true;
        };
        for (auto k = middle; k != order_.end() && try_one(*k); ++k) {
        }
        for (auto k = middle; k != order_.begin() && try_one(*(k - 1)); --k) {
        }
        return best;
    }

private:
    const std::vector<Vec3>& points_;
    std::vector<std::size_t> order_;
};

}  // namespace

LoadMap make_panel_map(const RunData& run, const TriangleMesh& mesh) {
    LoadMap map;
    const HullPanels& hull = run.panels;
    if (hull.panels.empty() || run.header.shapes.empty()) return map;
    const std::vector<Vec3>& centers = run.header.shapes[0].centers;
    const std::size_t count = std::min(centers.size(), hull.of_sphere.size());
    if (count == 0) return map;
    const NearestPoint nearest(centers, count);
    map.mesh = mesh;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Vec3 at = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
        // The discs of a section lie in y = 0, its mesh is a metre broad.
        if (run.header.dimension == 2) at.y() = 0.0;
        const auto panel = static_cast<std::size_t>(hull.of_sphere[nearest(at)]);
        // Largest force of a window over the panel's area: panels differ in size.
        map.load.push_back(hull.panels[panel].max / hull.panels[panel].area);
    }
    return map;
}

}  // namespace ice::statistics
