// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Points hashed into cubes, growing one by one; answers "how far is the nearest one?".
class PointGrid {
public:
    explicit PointGrid(double cell) : cell_(cell) {}

    void add(const Vec3& p) {
        cells_[key(cell_of(p))].push_back(static_cast<std::int32_t>(points_.size()));
        points_.push_back(p);
    }
    const std::vector<Vec3>& points() const { return points_; }

    struct Nearest {
        std::int32_t index = -1;  ///< -1 when there is none within the limit
        double distance = 0.0;
    };

    /// The nearest point within `limit` of p; the first added wins ties.
    /// Looks at cubes ring by ring, so a small limit is cheap.
    Nearest nearest(const Vec3& p, double limit) const {
        Nearest best{-1, limit};
        const Cell at = cell_of(p);
        const auto rings = static_cast<std::int64_t>(std::ceil(limit / cell_));
        for (std::int64_t ring = 0; ring <= rings; ++ring) {
            if (best.index >= 0 && best.distance <= static_cast<double>(ring - 1) * cell_) break;
            visit_ring(at, ring, p, best);
        }
        return best;
    }

    /// True where a point within `range` of p has accept(index).
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

    void visit_ring(const Cell& at, std::int64_t ring, const Vec3& p, Nearest& best) const {
        for (std::int64_t x = -ring; x <= ring; ++x)
            for (std::int64_t y = -ring; y <= ring; ++y) {
                // inside the ring's shell only the two end cubes along z are new
                const bool shell = std::abs(x) == ring || std::abs(y) == ring;
                const std::int64_t stride = shell || ring == 0 ? 1 : 2 * ring;
                for (std::int64_t z = -ring; z <= ring; z += stride)
                    visit_cell({at[0] + x, at[1] + y, at[2] + z}, p, best);
            }
    }

    void visit_cell(const Cell& cell, const Vec3& p, Nearest& best) const {
        const auto found = cells_.find(key(cell));
        if (found == cells_.end()) return;
        for (const std::int32_t k : found->second) {
            const double distance = (points_[static_cast<std::size_t>(k)] - p).norm();
            if (distance < best.distance ||
                (distance == best.distance && (best.index < 0 || k < best.index)))
                best = {k, distance};
        }
    }

    double cell_;
    std::vector<Vec3> points_;
    std::unordered_map<std::uint64_t, std::vector<std::int32_t>> cells_;
};

}  // namespace ice
