// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/near_edges.hpp"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <tuple>

namespace ice {

namespace {

using EdgeBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;

EdgeBox box_around(const Vec3& a, const Vec3& b, double margin, std::size_t row) {
    const Vec3 low = a.cwiseMin(b) - Vec3::Constant(margin);
    const Vec3 high = a.cwiseMax(b) + Vec3::Constant(margin);
    return EdgeBox(CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()), row);
}

}  // namespace

std::vector<NearEdge> find_near_edges(const std::vector<Vec3>& points,
                                      const std::vector<std::pair<Vec3, Vec3>>& edges,
                                      const std::vector<double>& reach) {
    std::vector<EdgeBox> of_points, of_edges;
    // Boxes that meet, found in O(n log n): the edges' boxes are wider by the reach, the points' by
    // nothing, so every near pair is among them.
    for (std::size_t k = 0; k < points.size(); ++k)
        of_points.push_back(box_around(points[k], points[k], 0.0, k));
    for (std::size_t k = 0; k < edges.size(); ++k)
        of_edges.push_back(box_around(edges[k].first, edges[k].second, reach[k], k));
    std::vector<NearEdge> out;
    CGAL::box_intersection_d(of_points.begin(), of_points.end(), of_edges.begin(), of_edges.end(),
                             [&](const EdgeBox& point, const EdgeBox& edge) {
                                 // the foot of the point on the edge's line, which must lie
                                 // between its ends
                                 const auto& [a, b] = edges[edge.info()];
                                 const Vec3 along = b - a, to = points[point.info()] - a;
                                 const double part = along.dot(to) / along.squaredNorm();
                                 const double distance = (to - part * along).norm();
                                 if (part > 0.0 && part < 1.0 && distance <= reach[edge.info()])
                                     out.push_back({point.info(), edge.info(), part, distance});
                             });
    // CGAL's order depends on its splitting; sorted, equal meshes give equal repairs.
    std::sort(out.begin(), out.end(), [](const NearEdge& l, const NearEdge& r) {
        return std::tie(l.point, l.distance, l.edge) < std::tie(r.point, r.distance, r.edge);
    });
    return out;
}

}  // namespace ice
