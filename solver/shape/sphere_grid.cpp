// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shape/sphere_grid.hpp"

#include <algorithm>
#include <cmath>

namespace ice {

void SphereGrid::build(std::span<const Vec3> points, double cell) {
    items_.clear();
    if (points.empty()) return;
    Eigen::AlignedBox3d box;
    for (const Vec3& p : points) box.extend(p);
    origin_ = box.min();
    cell_ = cell;
    // Cells are enlarged where a few points far apart would need too many of them.
    const double most_cells = 4.0 * static_cast<double>(points.size()) + 1000.0;
    double cells = 0.0;
    do {
        cells = 1.0;
        for (int d = 0; d < 3; ++d) cells *= std::floor(box.sizes()[d] / cell_) + 1.0;
        if (cells > most_cells) cell_ *= 1.26;  // twice the volume
    } while (cells > most_cells);
    for (int d = 0; d < 3; ++d)
        count_[d] = static_cast<int>(std::floor(box.sizes()[d] / cell_)) + 1;

    // counting sort by cell keeps the points of a cell in ascending order
    const auto cell_index = [&](const Vec3& p) {
        std::size_t at[3];
        for (int d = 0; d < 3; ++d)
            at[d] = static_cast<std::size_t>(std::clamp(cell_of(p[d], d), 0, count_[d] - 1));
        return (at[2] * count_[1] + at[1]) * count_[0] + at[0];
    };
    begin_.assign(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2] + 1, 0);
    for (const Vec3& p : points) ++begin_[cell_index(p)];
    for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
    items_.resize(points.size());
    for (std::size_t k = points.size(); k-- > 0;)
        items_[--begin_[cell_index(points[k])]] = static_cast<std::int32_t>(k);
}

}  // namespace ice
