// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/point_cells.hpp"

#include <bit>

namespace ice {

namespace {

// Cubes over points [-] up to which cubes are numbered; where there are more, they are hashed. A
// higher bound takes more memory for empty cubes; the answers are the same.
constexpr double kMostCubes = 2.0;

}  // namespace

PointCells::PointCells(std::span<const Vec3> points, double cell)
    : cell_(cell), per_metre_(2.0 / cell) {
    low_ = high_ = points.front();
    for (const Vec3& p : points) {
        low_ = low_.cwiseMin(p);
        high_ = high_.cwiseMax(p);
    }
    // few empty cubes: number them all; many: a hash table of the used ones
    const Vec3 cubes = ((high_ - low_) * per_metre_).array().floor() + 1.0;
    if (cubes.prod() <= kMostCubes * static_cast<double>(points.size())) {
        for (int d = 0; d < 3; ++d)
            count_[static_cast<std::size_t>(d)] = static_cast<std::int32_t>(cubes[d]);
        number_cubes(points);
    } else {
        hash_cubes(points);
    }
}

// Counts, then places: points of a cube end up side by side, in their own order.
void PointCells::number_cubes(std::span<const Vec3> points) {
    std::vector<std::size_t> cube;
    begin_.assign(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]) + 1, 0);
    for (const Vec3& p : points) {
        const std::int32_t row = number_along(p.x(), 0) * count_[1] + number_along(p.y(), 1);
        cube.push_back(static_cast<std::size_t>(row * count_[2] + number_along(p.z(), 2)));
        ++begin_[cube.back() + 1];
    }
    for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
    std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
    points_.resize(points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
        points_[static_cast<std::size_t>(next[cube[k]]++)] = {points[k],
                                                              static_cast<std::int32_t>(k)};
}

void PointCells::hash_cubes(std::span<const Vec3> points) {
    // count, place, fill: points of a cube end up side by side, in their own order
    std::vector<std::size_t> slot(points.size());
    const auto insert = [&](std::size_t k) {
        const Cell at = cell_of(points[k]);
        Slot& s = slots_[slot[k] = slot_of(at)];
        s.cell = at;
        return s.count++ == 0;
    };
    slots_.resize(std::bit_ceil(points.size() + points.size() / 4 + 1));
    std::size_t cubes = 0;
    for (std::size_t k = 0; k < points.size(); ++k) cubes += insert(k) ? 1 : 0;
    // once more into a table that fits the cubes, not the points: it stays in the cache
    slots_.assign(std::bit_ceil(2 * cubes + 1), Slot{});
    std::vector<std::size_t> used;
    for (std::size_t k = 0; k < points.size(); ++k)
        if (insert(k)) used.push_back(slot[k]);
    std::int32_t first = 0;
    for (const std::size_t s : used) {
        slots_[s].first = first;
        first += slots_[s].count;
    }
    std::vector<std::int32_t> filled(slots_.size(), 0);
    points_.resize(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
        const auto at = static_cast<std::size_t>(slots_[slot[k]].first + filled[slot[k]]++);
        points_[at] = {points[k], static_cast<std::int32_t>(k)};
    }
    for (std::size_t k = 0; k < points_.size(); k += kBlock) {
        Block block{{}, k, std::min(k + kBlock, points_.size())};
        for (std::size_t i = block.first; i < block.last; ++i) block.box.extend(points_[i].at);
        blocks_.push_back(block);
    }
}

PointCells::Cell PointCells::cell_of(const Vec3& p) const {
    Cell out;
    for (int d = 0; d < 3; ++d)
        out[static_cast<std::size_t>(d)] =
            static_cast<std::int32_t>(std::floor((p[d] - low_[d]) / cell_));
    return out;
}

namespace {

// The nearest of the searched points, of equally near ones the lowest index.
struct Closest {
    PointCells::Nearest known;
    double best_sq;
    std::int32_t best = -1;

    // a hair above: the known point and its equals are found again with their own squared distance
    explicit Closest(PointCells::Nearest k)
        : known(k), best_sq(k.distance * k.distance * (1.0 + 1e-15)) {}
    void look_at(double sq, std::int32_t index) {
        if (sq > best_sq || (sq == best_sq && index > best)) return;
        best_sq = sq;
        best = index;
    }
    PointCells::Nearest found() const {
        return best < 0 ? known : PointCells::Nearest{best, std::sqrt(best_sq)};
    }
};

}  // namespace

PointCells::Nearest PointCells::nearest(const Vec3& p, Nearest known) const {
    return begin_.empty() ? nearest_hashed(p, known) : nearest_numbered(p, known);
}

PointCells::Nearest PointCells::nearest_numbered(const Vec3& p, Nearest known) const {
    Closest closest(known);
    const auto look_at = [&](const Point& point) {
        closest.look_at((point.at - p).squaredNorm(), point.index);
    };
    const double most = (p - low_).cwiseMax(high_ - p).norm();  // no point is farther away
    double range = known.distance;
    if (!std::isfinite(range))
        // without a known point the search begins with a cube, and doubles until one is found
        range = cell_ + std::max((p - high_).cwiseMax(low_ - p).maxCoeff(), 0.0);
    for (;; range *= 2.0) {
        for_each_near(p, range * (1.0 + 1e-12), look_at);
        if (closest.best_sq <= range * range * (1.0 + 1e-12) || range > most) break;
    }
    return closest.found();
}

PointCells::Nearest PointCells::nearest_hashed(const Vec3& p, Nearest known) const {
    Closest closest(known);
    const double& best_sq = closest.best_sq;
    const auto look_at = [&](const Point& point) {
        closest.look_at((point.at - p).squaredNorm(), point.index);
    };
    const auto look_at_blocks = [&] {
        for (const Block& block : blocks_)
            // a hair below: of equally near points the lowest index may be in any block
            if (block.box.squaredExteriorDistance(p) * (1.0 - 1e-12) <= best_sq)
                for (std::size_t k = block.first; k < block.last; ++k) look_at(points_[k]);
        return closest.found();
    };
    // beyond, the cubes are more than the points, and their numbers may not fit
    const Vec3 past = (p - high_).cwiseMax(low_ - p);
    if (past.maxCoeff() > kMostRings * cell_ ||
        (std::isfinite(known.distance) && known.distance > kMostRings * cell_))
        return look_at_blocks();
    const Cell at = cell_of(p);
    const Vec3 within = (p - low_) - cell_ * Vec3(at[0], at[1], at[2]);
    // squared distance along an axis to the cube that is `step` cubes away
    const auto gap_sq = [&](int axis, int step) {
        const double gap = step > 0   ? step * cell_ - within[axis]
                           : step < 0 ? within[axis] - (step + 1) * cell_
                                      : 0.0;
        return gap * gap;
    };
    for (int ring = 0; ring <= kMostRings; ++ring) {
        const double reach = (ring - 1) * cell_;
        if (reach > 0.0 && reach * reach > best_sq) break;
        // beyond some rings the cubes are mostly empty: blocks of points instead
        if (ring == kMostRings) return look_at_blocks();
        for (int x = -ring; x <= ring; ++x)
            for (int y = -ring; y <= ring; ++y) {
                const double side_sq = gap_sq(0, x) + gap_sq(1, y);
                if (side_sq > best_sq) continue;
                // inside the ring's walls only the two end cubes along z are new
                const bool wall = std::abs(x) == ring || std::abs(y) == ring;
                const int stride = wall || ring == 0 ? 1 : 2 * ring;
                for (int z = -ring; z <= ring; z += stride) {
                    if (side_sq + gap_sq(2, z) > best_sq) continue;
                    const Slot& slot = slots_[slot_of({at[0] + x, at[1] + y, at[2] + z})];
                    for (std::int32_t k = slot.first; k < slot.first + slot.count; ++k)
                        look_at(points_[static_cast<std::size_t>(k)]);
                }
            }
    }
    return closest.found();
}

}  // namespace ice
