// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/drop_outside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "common/base/parallel.hpp"
#include "common/geometry/winding_number.hpp"

namespace ice {

namespace {

// Distance between centres [radii] within which their balls overlap. A millionth less than 2: balls
// that touch may have the surface between them.
constexpr double kOverlap = 2.0 * (1.0 - 1e-6);

// Heaps of overlapping spheres, made of cubes: for each cube the first of its heap.
class Heaps {
public:
    explicit Heaps(std::size_t count) : parent_(count), left_(count) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    std::size_t first_of(std::size_t k) {
        while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
        return k;
    }
    void join(std::size_t a, std::size_t b) {
        a = first_of(a);
        b = first_of(b);
        if (a == b) return;
        parent_[std::max(a, b)] = std::min(a, b);
        --left_;
    }
    std::size_t left() const { return left_; }

private:
    std::vector<std::size_t> parent_;
    std::size_t left_;
};

using Step = std::array<int, 3>;

// Points sorted by the cubes they lie in; all points of a cube overlap each other.
class Cubes {
public:
    Cubes(const std::vector<Vec3>& centers, double range)
        : centers_(centers), range_(range), of_point_(centers.size()) {
        // a cube with a diagonal below the range: all its points overlap each other
        const double edge = 0.999 * range / std::sqrt(3.0);
        Eigen::AlignedBox3d box;
        for (const Vec3& c : centers) box.extend(c);
        order_.resize(centers.size());
        parallel_for(order_.size(), 4096, [&](std::size_t k) {
            std::uint64_t key = 0;  // two cubes of margin, so that steps stay in their digits
            for (int d = 0; d < 3; ++d)
                key = key << kDigits |
                      static_cast<std::uint64_t>((centers[k][d] - box.min()[d]) / edge + 2.0);
            order_[k] = {key, static_cast<std::int32_t>(k)};
        });
        std::sort(order_.begin(), order_.end());
        for (std::size_t k = 0; k < order_.size(); ++k) {
            if (k == 0 || order_[k].first != order_[k - 1].first) {
                begin_.push_back(k);
                keys_.push_back(order_[k].first);
            }
            of_point_[point(k)] = static_cast<std::int32_t>(keys_.size() - 1);
        }
        begin_.push_back(order_.size());
    }

    std::size_t count() const { return keys_.size(); }
    std::size_t of_point(std::size_t k) const { return static_cast<std::size_t>(of_point_[k]); }

    // Joins the cubes that are `step` apart. Both run through the sorted cubes side by side.
    void join_across(const Step& step, Heaps& heaps) const {
        std::uint64_t ahead = 0;  // modulo 2^64, so that steps back are right too
        // A key has one digit per axis: a step in space is a fixed difference of keys.
        for (const int digit : step)
            ahead = (ahead << kDigits) + static_cast<std::uint64_t>(std::int64_t{digit});
        std::size_t other = 0;
        for (std::size_t c = 0; c < keys_.size(); ++c) {
            const std::uint64_t wanted = keys_[c] + ahead;
            while (other < keys_.size() && keys_[other] < wanted) ++other;
            if (other == keys_.size()) return;
            // Cubes of one heap need no comparison of their points: most are joined after the first
            // steps.
            if (keys_[other] != wanted || heaps.first_of(c) == heaps.first_of(other)) continue;
            if (overlap(c, other)) heaps.join(c, other);
        }
    }

private:
    // Bits of a cube's number along an axis, 2 million cubes [-]: three of them fit into 64 bits,
    // so that no larger value is possible; a smaller one would give far cubes one number.
    static constexpr int kDigits = 21;

    std::size_t point(std::size_t k) const { return static_cast<std::size_t>(order_[k].second); }

    bool overlap(std::size_t one, std::size_t other) const {
        for (std::size_t a = begin_[one]; a < begin_[one + 1]; ++a)
            for (std::size_t b = begin_[other]; b < begin_[other + 1]; ++b)
                if ((centers_[point(a)] - centers_[point(b)]).norm() < range_) return true;
        return false;
    }

    const std::vector<Vec3>& centers_;
    double range_;
    std::vector<std::pair<std::uint64_t, std::int32_t>> order_;
    std::vector<std::size_t> begin_;  // of order_ by cube, and the end
    std::vector<std::uint64_t> keys_;
    std::vector<std::int32_t> of_point_;
};

// Steps to the cubes within reach, half of all, the shortest first.
std::vector<Step> steps_within_reach() {
    // The other half is the same pairs seen from the other cube. Two cubes each way: their edge is
    // 0.58 of the range.
    std::vector<Step> steps;
    for (int x = 0; x <= 2; ++x)
        for (int y = -2; y <= 2; ++y)
            for (int z = -2; z <= 2; ++z)
                if (Step{0, 0, 0} < Step{x, y, z}) steps.push_back({x, y, z});
    const auto length = [](const Step& s) { return s[0] * s[0] + s[1] * s[1] + s[2] * s[2]; };
    std::stable_sort(steps.begin(), steps.end(),
                     [&](const Step& a, const Step& b) { return length(a) < length(b); });
    return steps;
}

Heaps find_heaps(const Cubes& cubes) {
    Heaps heaps(cubes.count());
    for (const Step& step : steps_within_reach()) {
        if (heaps.left() <= 1) break;  // most solids, after a few steps
        cubes.join_across(step, heaps);
    }
    return heaps;
}

// Winding numbers of a half or more at a few points, or at many.
std::vector<std::uint8_t> are_inside(const TriangleMesh& solid, const std::vector<Vec3>& points) {
    // Points [-] up to which adding up all solid angles costs less than a tree. It changes the time
    // alone.
    constexpr std::size_t kFew = 20;
    std::vector<std::uint8_t> inside(points.size(), 0);
    if (points.size() <= kFew) {
        parallel_tasks(points.size(), true, [&](std::size_t k) {
            double sum = 0.0;
            for (std::size_t t = 0; t < solid.triangles.size(); ++t)
                sum += solid_angle(points[k], solid.corner(t, 0), solid.corner(t, 1),
                                   solid.corner(t, 2));
            inside[k] = sum > 0.5;
        });
        return inside;
    }
    const WindingNumber winding(solid);
    parallel_for(points.size(), 64, [&](std::size_t k) {
        inside[k] = winding.contains(points[k]) && winding.at(points[k]) > 0.0;
    });
    return inside;
}

}  // namespace

std::int64_t drop_outside(const TriangleMesh& solid, double radius, std::vector<Vec3>& centers) {
    // Spheres that overlap lie on the same side of the surface: one winding number per heap
    // will do.
    const Cubes cubes(centers, kOverlap * radius);
    Heaps heaps = find_heaps(cubes);
    constexpr std::size_t kUnknown = std::numeric_limits<std::size_t>::max();
    std::vector<Vec3> asked;                                   // the first centre of each heap
    std::vector<std::size_t> number(cubes.count(), kUnknown);  // of a heap among `asked`
    for (std::size_t k = 0; k < centers.size(); ++k) {
        std::size_t& heap = number[heaps.first_of(cubes.of_point(k))];
        if (heap != kUnknown) continue;
        heap = asked.size();
        asked.push_back(centers[k]);
    }
    const std::vector<std::uint8_t> inside = are_inside(solid, asked);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < centers.size(); ++k)
        if (inside[number[heaps.first_of(cubes.of_point(k))]] != 0) centers[kept++] = centers[k];
    const auto dropped = static_cast<std::int64_t>(centers.size() - kept);
    centers.resize(kept);
    return dropped;
}

}  // namespace ice
