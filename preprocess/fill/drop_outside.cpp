// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/drop_outside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "common/base/parallel.hpp"
#include "common/geometry/winding_number.hpp"

namespace ice {

namespace {

constexpr double kOverlap = 2.0 * (1.0 - 1e-6);  // radii between centres whose balls overlap

// Heaps of overlapping spheres: for each the first of its heap.
class Heaps {
public:
    explicit Heaps(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    std::size_t first_of(std::size_t k) {
        while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
        return k;
    }
    void join(std::size_t a, std::size_t b) {
        a = first_of(a);
        b = first_of(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::size_t> parent_;
};

using Cube = std::array<std::int32_t, 3>;

// Points sorted by the cubes they lie in; all points of a cube overlap each other.
class Cubes {
public:
    Cubes(const std::vector<Vec3>& centers, double range) : centers_(centers), range_(range) {
        const double edge = 0.999 * range / std::sqrt(3.0);
        order_.resize(centers.size());
        parallel_for(order_.size(), 4096, [&](std::size_t k) {
            Cube cube{};
            for (int d = 0; d < 3; ++d)
                cube[static_cast<std::size_t>(d)] =
                    static_cast<std::int32_t>(std::floor(centers[k][d] / edge));
            order_[k] = {cube, static_cast<std::int32_t>(k)};
        });
        std::sort(order_.begin(), order_.end());
        for (std::size_t k = 0; k < order_.size(); ++k)
            if (k == 0 || order_[k].first != order_[k - 1].first) {
                begin_.push_back(k);
                cubes_.push_back(order_[k].first);
            }
        begin_.push_back(order_.size());
    }

    void join_within(Heaps& heaps) const {
        for (std::size_t c = 0; c < cubes_.size(); ++c)
            for (std::size_t k = begin_[c] + 1; k < begin_[c + 1]; ++k)
                heaps.join(point(k - 1), point(k));
    }

    // Joins the cubes that are `step` apart. Both run through the sorted cubes side by side.
    void join_across(const Cube& step, Heaps& heaps) const {
        std::size_t other = 0;
        for (std::size_t c = 0; c < cubes_.size(); ++c) {
            Cube wanted = cubes_[c];
            for (std::size_t d = 0; d < 3; ++d) wanted[d] += step[d];
            while (other < cubes_.size() && cubes_[other] < wanted) ++other;
            if (other == cubes_.size()) return;
            const std::size_t a = point(begin_[c]), b = point(begin_[other]);
            if (cubes_[other] != wanted || heaps.first_of(a) == heaps.first_of(b)) continue;
            if (overlap(c, other)) heaps.join(a, b);
        }
    }

private:
    std::size_t point(std::size_t k) const { return static_cast<std::size_t>(order_[k].second); }

    bool overlap(std::size_t one, std::size_t other) const {
        for (std::size_t a = begin_[one]; a < begin_[one + 1]; ++a)
            for (std::size_t b = begin_[other]; b < begin_[other + 1]; ++b)
                if ((centers_[point(a)] - centers_[point(b)]).norm() < range_) return true;
        return false;
    }

    const std::vector<Vec3>& centers_;
    double range_;
    std::vector<std::pair<Cube, std::int32_t>> order_;
    std::vector<std::size_t> begin_;  // of order_ by cube, and the end
    std::vector<Cube> cubes_;
};

Heaps find_heaps(const std::vector<Vec3>& centers, double radius) {
    Heaps heaps(centers.size());
    const Cubes cubes(centers, kOverlap * radius);
    cubes.join_within(heaps);
    for (std::int32_t x = 0; x <= 2; ++x)
        for (std::int32_t y = -2; y <= 2; ++y)
            for (std::int32_t z = -2; z <= 2; ++z)
                if (Cube{0, 0, 0} < Cube{x, y, z}) cubes.join_across({x, y, z}, heaps);
    return heaps;
}

// Winding numbers of a half or more at a few points, or at many.
std::vector<std::uint8_t> are_inside(const TriangleMesh& solid, const std::vector<Vec3>& points) {
    constexpr std::size_t kFew = 20;  // for which adding up all solid angles costs less than a tree
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
    Heaps heaps = find_heaps(centers, radius);
    std::vector<Vec3> asked;
    std::vector<std::size_t> number(centers.size(), 0);  // of a heap's first centre among `asked`
    for (std::size_t k = 0; k < centers.size(); ++k) {
        if (heaps.first_of(k) != k) continue;
        number[k] = asked.size();
        asked.push_back(centers[k]);
    }
    const std::vector<std::uint8_t> inside = are_inside(solid, asked);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < centers.size(); ++k)
        if (inside[number[heaps.first_of(k)]] != 0) centers[kept++] = centers[k];
    const auto dropped = static_cast<std::int64_t>(centers.size() - kept);
    centers.resize(kept);
    return dropped;
}

}  // namespace ice
