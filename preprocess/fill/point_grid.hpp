// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Points hashed into cubes, growing one by one; tests whether one is near.
class PointGrid {
public:
    /// @param cell  edge of a cube [m], about the range of the queries
    explicit PointGrid(double cell) : cell_(cell) {}

    void add(const Vec3& p) {
        cells_[key(cell_of(p))].push_back(static_cast<std::int32_t>(points_.size()));
        points_.push_back(p);
    }

    /// True where a point within `range` [m] of p has accept(index); the index counts add() calls
    /// from 0.
    template <class Accept>
    bool any_within(const Vec3& p, double range, const Accept& accept) const {
        const Cell from = cell_of(p - Vec3::Constant(range));
        const Cell to = cell_of(p + Vec3::Constant(range));
        for (std::int64_t x = from[0]; x <= to[0]; ++x)
            for (std::int64_t y = from[1]; y <= to[1]; ++y)
                for (std::int64_t z = from[2]; z <= to[2]; ++z) {
                    const auto found = cells_.find(key({x, y, z}));
                    if (found == cells_.end()) continue;
                    for (const std::int32_t k : found->second)
                        if ((points_[static_cast<std::size_t>(k)] - p).norm() < range && accept(k))
                            return true;
                }
        return false;
    }

private:
    using Cell = std::array<std::int64_t, 3>;

    Cell cell_of(const Vec3& p) const {
        return {static_cast<std::int64_t>(std::floor(p.x() / cell_)),
                static_cast<std::int64_t>(std::floor(p.y() / cell_)),
                static_cast<std::int64_t>(std::floor(p.z() / cell_))};
    }
    // 21 bits a coordinate: a kilometre in half millimetres
    static std::uint64_t key(const Cell& c) {
        constexpr std::uint64_t kMask = (1u << 21) - 1;
        return (static_cast<std::uint64_t>(c[0]) & kMask) |
               (static_cast<std::uint64_t>(c[1]) & kMask) << 21 |
               (static_cast<std::uint64_t>(c[2]) & kMask) << 42;
    }

    double cell_;
    std::vector<Vec3> points_;
    std::unordered_map<std::uint64_t, std::vector<std::int32_t>> cells_;
};

}  // namespace ice
