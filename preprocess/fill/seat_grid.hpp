// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "preprocess/fill/offset_surface.hpp"

namespace ice {

/// The seats in a box of space, growing one by one, found by where they are: a dense array of
/// cells, so that the dozens of neighbour searches per sphere stay in the cache.
class SeatGrid {
public:
    /// @param box   not empty [m]; seats outside it are found more slowly
    /// @param cell  edge of a cell [m]
    SeatGrid(const Eigen::AlignedBox3d& box, double cell)
        : low_(box.min()), per_metre_(1.0 / cell) {
        for (int d = 0; d < 3; ++d) {
            count_[d] = static_cast<int>(std::ceil(box.sizes()[d] / cell)) + 1;
            least_[d] = count_[d];
            most_[d] = -1;
        }
        head_.assign(index(0, 0, count_[2]), -1);
    }

    void add(const Seat& seat) {
        const auto index = static_cast<std::int32_t>(seats_.size());
        std::size_t at = 0;
        for (int d = 2; d >= 0; --d) {
            const int cell = axis_cell(seat.center[d], d);
            at = at * static_cast<std::size_t>(count_[d]) + static_cast<std::size_t>(cell);
            least_[d] = std::min(least_[d], cell);
            most_[d] = std::max(most_[d], cell);
        }
        seats_.push_back(seat);
        links_.push_back({seat.center, head_[at]});
        head_[at] = index;
    }

    const std::vector<Seat>& seats() const { return seats_; }

    /// Calls visit(index, squared distance [m2]) for the seats within `range` [m] of p until it
    /// returns true, in no order that matters: callers sort or take minima.
    template <class Visit>
    void visit(const Vec3& p, double range, const Visit& visit) const {
        int from[3], to[3];
        for (int d = 0; d < 3; ++d) {
            from[d] = std::max(axis_cell(p[d] - range, d), least_[d]);
            to[d] = std::min(axis_cell(p[d] + range, d), most_[d]);
        }
        const double range_sq = range * range;
        for (int z = from[2]; z <= to[2]; ++z)
            for (int y = from[1]; y <= to[1]; ++y)
                for (int x = from[0]; x <= to[0]; ++x)
                    for (std::int32_t k = head_[index(x, y, z)]; k >= 0;) {
                        const Link& link = links_[static_cast<std::size_t>(k)];
                        const double sq = (link.center - p).squaredNorm();
                        if (sq < range_sq && visit(k, sq)) return;
                        k = link.next;
                    }
    }

    /// True if a seat within `range` represents surface of this normal (these normals).
    template <class Normal>
    bool any_within(const Vec3& p, double range, const Normal& normal) const {
        bool found = false;
        visit(p, range, [&](std::int32_t k, double) {
            return found = seats_[static_cast<std::size_t>(k)].agrees(normal);
        });
        return found;
    }

private:
    std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(count_[1]) +
                static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(count_[0]) +
               static_cast<std::size_t>(x);
    }
    int axis_cell(double x, int d) const {
        // truncation rounds down, as values below zero are clamped
        return std::clamp(static_cast<int>((x - low_[d]) * per_metre_), 0, count_[d] - 1);
    }

    struct Link {
        Vec3 center;        // once more: a search reads no more of most seats
        std::int32_t next;  // in the cell; -1: none
    };

    Vec3 low_;
    double per_metre_;  // cells
    int count_[3];
    int least_[3], most_[3];  // cells that hold seats
    std::vector<std::int32_t> head_;
    std::vector<Link> links_;
    std::vector<Seat> seats_;
};

}  // namespace ice
