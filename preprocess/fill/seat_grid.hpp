// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "preprocess/fill/offset_surface.hpp"

namespace ice {

/// The seats in and around one cube of space, growing one by one, found by where they are: a dense
/// array of cells, so that the dozens of neighbour searches per sphere stay in the cache.
class SeatGrid {
public:
    /// @param low   corner of the cube [m]
    /// @param size  its edge [m]; @param cell  edge of a cell [m]
    /// Seats outside the cube must not be added.
    SeatGrid(const Vec3& low, double size, double cell)
        : low_(low),
          cell_(cell),
          count_(static_cast<int>(std::ceil(size / cell)) + 1),
          head_(static_cast<std::size_t>(count_) * static_cast<std::size_t>(count_) *
                    static_cast<std::size_t>(count_),
                -1) {}

    void add(const Seat& seat) {
        const auto index = static_cast<std::int32_t>(seats_.size());
        std::size_t at = 0;
        for (int d = 2; d >= 0; --d)
            at = at * static_cast<std::size_t>(count_) +
                 static_cast<std::size_t>(axis_cell(seat.center[d], d));
        seats_.push_back(seat);
        next_.push_back(head_[at]);
        head_[at] = index;
    }

    const std::vector<Seat>& seats() const { return seats_; }

    /// Calls visit(index, squared distance) for the seats within `range` of p until it returns
    /// true, in no order that matters: callers sort or take minima.
    template <class Visit>
    void visit(const Vec3& p, double range, const Visit& visit) const {
        int from[3], to[3];
        for (int d = 0; d < 3; ++d) {
            from[d] = axis_cell(p[d] - range, d);
            to[d] = axis_cell(p[d] + range, d);
        }
        const double range_sq = range * range;
        for (int z = from[2]; z <= to[2]; ++z)
            for (int y = from[1]; y <= to[1]; ++y)
                for (int x = from[0]; x <= to[0]; ++x)
                    for (std::int32_t k = head_[index(x, y, z)]; k >= 0;
                         k = next_[static_cast<std::size_t>(k)]) {
                        const double sq =
                            (seats_[static_cast<std::size_t>(k)].center - p).squaredNorm();
                        if (sq < range_sq && visit(k, sq)) return;
                    }
    }

    /// True where a seat is within `range` that stands for surface of this normal (these normals).
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
        const auto n = static_cast<std::size_t>(count_);
        return (static_cast<std::size_t>(z) * n + static_cast<std::size_t>(y)) * n +
               static_cast<std::size_t>(x);
    }
    int axis_cell(double x, int d) const {
        return std::clamp(static_cast<int>(std::floor((x - low_[d]) / cell_)), 0, count_ - 1);
    }

    Vec3 low_;
    double cell_;
    int count_;
    std::vector<std::int32_t> head_, next_;
    std::vector<Seat> seats_;
};

}  // namespace ice
