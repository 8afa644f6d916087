// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Points sorted into equal cells of a box, for "which spheres are near here?".
///
/// Cells are stored row by row (x fastest) as ranges of `items`, so a query over neighbouring cells
/// along x reads one run of memory.
class SphereGrid {
public:
    SphereGrid() = default;
    /// @param points  sphere centres [m]; empty gives a grid that finds nothing
    /// @param cell    wanted edge of a cell [m], > 0; enlarged where the box would need more than
    ///                four cells per point
    SphereGrid(std::span<const Vec3> points, double cell) { build(points, cell); }
    /// Makes it anew, in the memory it has where that is enough. Arguments as of the constructor;
    /// points must be finite.
    void build(std::span<const Vec3> points, double cell);

    /// Calls visit(k) for every point k in the cells that the cube of half edge `range` [m] around
    /// `center` touches: all points within `range`, and some beyond. Ascending by cell, then k.
    template <class Visit>
    void for_each_near(const Vec3& center, double range, const Visit& visit) const {
        if (items_.empty()) return;
        int low[3], high[3];
        for (int d = 0; d < 3; ++d) {
            low[d] = cell_of(center[d] - range, d);
            high[d] = cell_of(center[d] + range, d);
            if (high[d] < 0 || low[d] >= count_[d]) return;
            low[d] = std::max(low[d], 0);
            high[d] = std::min(high[d], count_[d] - 1);
        }
        for (int z = low[2]; z <= high[2]; ++z)
            for (int y = low[1]; y <= high[1]; ++y) {
                const std::size_t row = (static_cast<std::size_t>(z) * count_[1] + y) * count_[0];
                const std::int32_t end = begin_[row + high[0] + 1];
                for (std::int32_t k = begin_[row + low[0]]; k < end; ++k) visit(items_[k]);
            }
    }

private:
    int cell_of(double x, int axis) const {
        // far away points would overflow the int: clamp first
        const double cell = (x - origin_[axis]) / cell_;
        return static_cast<int>(std::floor(std::clamp(cell, -2.0, count_[axis] + 1.0)));
    }

    Vec3 origin_ = Vec3::Zero();       ///< lowest corner of the box [m]
    double cell_ = 1.0;                ///< edge of a cell [m]
    int count_[3] = {0, 0, 0};         ///< cells along x, y, z
    std::vector<std::int32_t> begin_;  ///< cells + 1
    std::vector<std::int32_t> items_;  ///< numbers of points, by cell
};

}  // namespace ice
