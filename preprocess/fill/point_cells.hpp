// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// The point nearest to a place, among points that no longer change (PointGrid is for growing
/// ones): points sorted into cubes, cubes found by their number where they fill their box, as those
/// of a floe do, and by hashing elsewhere. Thread-safe once built.
class PointCells {
public:
    /// @param points  copied; not empty
    /// @param cell    edge of a hashed cube [m], about the distance between neighbouring points;
    ///                numbered ones cost less to search and are half as wide
    PointCells(std::span<const Vec3> points, double cell);

    struct Nearest {
        std::int32_t index;
        double distance;  ///< [m]
    };

    /// The nearest point, however far; of equally near ones that with the lowest index. Cost O(1)
    /// where one is near.
    Nearest nearest(const Vec3& p) const { return nearest(p, {-1, kFar}); }

    /// The nearest point when one and its distance are known already: only nearer ones are looked
    /// for.
    Nearest nearest(const Vec3& p, Nearest known) const;

    /// Calls visit(index, distance [m]) for all points within `range` [m] of p, in no particular
    /// order.
    template <class Visit>
    void visit(const Vec3& p, double range, const Visit& visit) const;

private:
    using Cell = std::array<std::int32_t, 3>;
    struct Slot {
        Cell cell{};
        std::int32_t first = 0, count = 0;     ///< range of points_; count 0: an empty slot
        bool holds(const Cell& other) const {  // member by member: no call of memcmp
            return cell[0] == other[0] && cell[1] == other[1] && cell[2] == other[2];
        }
    };
    struct Point {
        Vec3 at;
        std::int32_t index;
    };

    struct Block {  ///< kBlock points that follow each other in points_
        Eigen::AlignedBox3d box;
        std::size_t first, last;
    };

    static constexpr double kFar = std::numeric_limits<double>::infinity();
    // Points of a block, and rings of cubes that are searched before blocks are [-]: they set the
    // time, not the results. Larger blocks measure more points without need, smaller ones are more
    // boxes to test; more rings visit more empty cubes, fewer test all blocks for nearer points.
    static constexpr std::size_t kBlock = 64;
    static constexpr int kMostRings = 12;

    void number_cubes(std::span<const Vec3> points);
    void hash_cubes(std::span<const Vec3> points);
    Nearest nearest_numbered(const Vec3& p, Nearest known) const;
    Nearest nearest_hashed(const Vec3& p, Nearest known) const;
    Cell cell_of(const Vec3& p) const;
    // By number: the cube along an axis that a coordinate lies in or, outside the box, is next to.
    std::int32_t number_along(double x, int d) const {
        const double at = std::min((x - low_[d]) * per_metre_, count_[d] - 1.0);
        return static_cast<std::int32_t>(std::max(at, 0.0));  // cut off: not below any number
    }
    // By number: calls look_at(point) for all points in the cubes around p as far as `range`.
    template <class LookAt>
    void for_each_near(const Vec3& p, double range, const LookAt& look_at) const {
        std::int32_t from[3], to[3];
        for (int d = 0; d < 3; ++d) {
            from[d] = number_along(p[d] - range, d);
            to[d] = number_along(p[d] + range, d);
        }
        for (std::int32_t x = from[0]; x <= to[0]; ++x)
            for (std::int32_t y = from[1]; y <= to[1]; ++y) {
                // cubes side by side along z hold their points side by side
                const std::int32_t row = (x * count_[1] + y) * count_[2];
                const auto last = begin_[static_cast<std::size_t>(row + to[2] + 1)];
                for (auto k = begin_[static_cast<std::size_t>(row + from[2])]; k < last; ++k)
                    look_at(points_[static_cast<std::size_t>(k)]);
            }
    }
    // The slot of a cube, or the empty one where it would be.
    std::size_t slot_of(const Cell& cell) const {
        std::uint64_t hash = 0;
        for (const std::int32_t c : cell)
            hash = (hash ^ static_cast<std::uint32_t>(c)) * 0x9e3779b97f4a7c15ull;
        const std::size_t mask = slots_.size() - 1;
        for (std::size_t at = (hash ^ hash >> 29) >> 7 & mask;; at = (at + 1) & mask)
            if (slots_[at].count == 0 || slots_[at].holds(cell)) return at;
    }

    double cell_;
    Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();
    double per_metre_ = 0.0;               ///< cubes
    std::array<std::int32_t, 3> count_{};  ///< of cubes by number
    std::vector<std::int32_t> begin_;      ///< of points_ by cube's number, and the end; or empty
    std::vector<Slot> slots_;              ///< open addressing, a power of two; or empty
    std::vector<Point> points_;
    std::vector<Block> blocks_;
};

template <class Visit>
void PointCells::visit(const Vec3& p, double range, const Visit& visit) const {
    const auto look_at = [&](const Point& point) {
        const double distance = (point.at - p).norm();
        if (distance <= range) visit(point.index, distance);
    };
    if (!begin_.empty()) return for_each_near(p, range, look_at);
    // a wide range has more cubes than there are blocks
    if (range > kMostRings * cell_) {
        for (const Block& block : blocks_)
            if (block.box.squaredExteriorDistance(p) <= range * range * (1.0 + 1e-12))
                for (std::size_t k = block.first; k < block.last; ++k) look_at(points_[k]);
        return;
    }
    const Cell from = cell_of(p - Vec3::Constant(range)), to = cell_of(p + Vec3::Constant(range));
    for (std::int32_t x = from[0]; x <= to[0]; ++x)
        for (std::int32_t y = from[1]; y <= to[1]; ++y)
            for (std::int32_t z = from[2]; z <= to[2]; ++z) {
                const Slot& slot = slots_[slot_of({x, y, z})];
                for (std::int32_t k = slot.first; k < slot.first + slot.count; ++k)
                    look_at(points_[static_cast<std::size_t>(k)]);
            }
}

}  // namespace ice
