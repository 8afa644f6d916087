// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/offset_surface.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace ice {

namespace {

constexpr int kMostSteps = 40;
constexpr double kExact = 1e-10;              // of the radius: when a distance counts as reached
constexpr double kSameDirection = 0.9999995;  // cosine of 1e-3 rad: conditions that are one

// g . move >= need
struct Condition {
    Vec3 g;
    double need;
};

// Conditions of all faces nearer than the radius, the worst first, equal directions once.
void collect(const SurfaceTree& tree, const Vec3& c, double radius, std::vector<Foot>& feet,
             std::vector<Condition>& out) {
    tree.within(c, radius, feet);
    std::stable_sort(feet.begin(), feet.end(),
                     [](const Foot& l, const Foot& r) { return l.distance < r.distance; });
    out.clear();
    for (const Foot& foot : feet) {
        // a centre on the surface itself has no direction but the face's
        const Vec3 g = foot.distance > 1e-12 * radius ? Vec3((c - foot.point) / foot.distance)
                                                      : Vec3(-tree.normal(foot.triangle));
        const bool seen = std::any_of(out.begin(), out.end(), [&](const Condition& other) {
            return other.g.dot(g) > kSameDirection;
        });
        if (!seen) out.push_back({g, radius - foot.distance});
    }
}

// Smallest move that meets up to three of the conditions exactly: the worst, then those it leaves.
Vec3 smallest_move(const std::vector<Condition>& conditions) {
    std::vector<const Condition*> active{&conditions.front()};
    Vec3 move = conditions.front().need * conditions.front().g;
    while (active.size() < 3) {
        const Condition* worst = nullptr;
        double lack = 1e-14;
        for (const Condition& c : conditions) {
            const double now = c.need - c.g.dot(move);
            if (now <= lack) continue;
            lack = now;
            worst = &c;
        }
        if (worst == nullptr) break;
        active.push_back(worst);
        const auto n = static_cast<Eigen::Index>(active.size());
        Eigen::MatrixXd g(n, 3);
        Eigen::VectorXd need(n);
        for (Eigen::Index k = 0; k < n; ++k) {
            g.row(k) = active[static_cast<std::size_t>(k)]->g.transpose();
            need[k] = active[static_cast<std::size_t>(k)]->need;
        }
        move = g.completeOrthogonalDecomposition().solve(need);
    }
    return move;
}

}  // namespace

std::optional<Vec3> settle(const SurfaceTree& tree, const Vec3& start, double radius) {
    Vec3 c = start;
    std::vector<Foot> feet;
    std::vector<Condition> conditions;
    for (int step = 0; step < kMostSteps; ++step) {
        const Foot foot = tree.closest(c);
        if (!foot.inside) return std::nullopt;
        if (std::abs(foot.distance - radius) <= kExact * radius) return c;
        if (foot.distance > radius) {
            c += (foot.distance - radius) / foot.distance * (foot.point - c);
            continue;
        }
        collect(tree, c, radius, feet, conditions);
        const Vec3 move = smallest_move(conditions);
        if (!(move.norm() < 4.0 * radius)) return std::nullopt;  // a wedge too sharp to fit in
        c += move;
    }
    return std::nullopt;
}

std::vector<Vec3> touch_directions(const SurfaceTree& tree, const Vec3& center, double radius) {
    constexpr double kTouch = 1e-5;         // of the radius
    constexpr double kSameTouch = 0.99995;  // cosine of 0.01 rad
    std::vector<Foot> feet;
    tree.within(center, radius * (1.0 + kTouch), feet);
    // the nearest first: the other triangles of a face have their feet a little aside
    std::stable_sort(feet.begin(), feet.end(),
                     [](const Foot& l, const Foot& r) { return l.distance < r.distance; });
    std::vector<Vec3> directions;
    for (const Foot& foot : feet) {
        const Vec3 u = (foot.point - center).normalized();
        const bool seen = std::any_of(directions.begin(), directions.end(),
                                      [&](const Vec3& d) { return d.dot(u) > kSameTouch; });
        if (!seen) directions.push_back(u);
    }
    return directions;
}

}  // namespace ice
