// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// "Which point is nearest?" for points that no longer change (PointGrid is for growing ones): a
/// k-d tree. Thread-safe once built.
class NearestPoints {
public:
    /// @param points  copied; not empty
    explicit NearestPoints(std::span<const Vec3> points);

    struct Nearest {
        std::int32_t index;
        double distance;  ///< [m]
    };

    /// The nearest point, however far; of equally near ones that with the lowest index.
    /// Cost O(log n).
    Nearest nearest(const Vec3& p) const;

private:
    struct Node {
        double split = 0.0;                 ///< coordinate that parts the two halves
        std::int32_t first = 0, count = 0;  ///< leaf: range of points_; inner node: count 0
        std::int32_t right = 0;             ///< second half; the first is the next node
        int axis = 0;
    };
    struct Point {
        Vec3 at;
        std::int32_t index;
    };

    std::int32_t build(std::int32_t first, std::int32_t count);
    void search(std::int32_t node, const Vec3& p, double& best_sq, std::int32_t& best) const;

    std::vector<Node> nodes_;
    std::vector<Point> points_;
};

}  // namespace ice
