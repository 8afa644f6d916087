// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/live_edge/edge_window.hpp"

#include <algorithm>
#include <cmath>

namespace ice {

namespace {

// Loads this near to a window's middle [radii] may have lost a part of their sum: its loads are
// within one radius of the middle, and within one more of them; a thousandth is for rounding. A
// larger value only sums more of them again, a smaller one keeps sums of loads that are gone.
constexpr double kSumsAround = 2.001;

double down_near(const std::vector<EdgeLoad>& loads, const Vec2& at, double radius) {
    double sum = 0.0;
    for (const EdgeLoad& load : loads)
        if ((load.at - at).squaredNorm() <= radius * radius) sum += load.down;
    return sum;
}

// Of the loads within a radius of `middle`.
EdgeWindow window_around(const std::vector<EdgeLoad>& loads, const Vec2& middle, double radius) {
    EdgeWindow out{Vec2::Zero(), Vec2::Zero(), 0.0, 0.0, 0.0};
    Vec2 push = Vec2::Zero();
    double weight = 0.0, normal = 0.0, level = 0.0, closing = 0.0;
    for (const EdgeLoad& load : loads) {
        // (26) and the closing speed of one window; a load upwards reduces the sum, but has no
        // part in the centre
        if ((load.at - middle).squaredNorm() > radius * radius) continue;
        out.down += load.down;
        out.at += std::max(load.down, 0.0) * (load.at - middle);
        weight += std::max(load.down, 0.0);
        push += load.push;
        normal += load.normal;
        level += load.push.norm();
        closing += load.closing;
    }
    out.at = middle + out.at / weight;
    if (push.norm() > 0.0) out.inwards = push.normalized();
    out.closing = closing / normal;
    if (level > 0.0) out.normal_speed = closing / level;
    return out;
}

}  // namespace

std::vector<EdgeWindow> edge_windows(std::vector<EdgeLoad> loads, double radius) {
    std::vector<EdgeWindow> out;
    std::vector<double> down;  // of all loads near each
    for (const EdgeLoad& load : loads) down.push_back(down_near(loads, load.at, radius));
    // Greedily: the largest sum within a radius first, its loads are taken out, and so on.
    while (!loads.empty()) {
        const auto most = std::max_element(down.begin(), down.end());  // the first of equal ones
        if (*most <= 0.0) break;
        // The largest sum belongs to one load; the window's centre is then the mean of those
        // around it.
        const Vec2 middle = loads[static_cast<std::size_t>(most - down.begin())].at;
        const EdgeWindow window = window_around(loads, middle, radius);
        if (!window.inwards.isZero(0.0)) out.push_back(window);
        const auto is_within = [&](const EdgeLoad& load, double distance) {
            return (load.at - middle).squaredNorm() <= distance * distance;
        };
        std::size_t left = 0;
        for (std::size_t k = 0; k < loads.size(); ++k) {
            if (is_within(loads[k], radius)) continue;
            down[left] = down[k];
            loads[left++] = loads[k];
        }
        loads.resize(left);
        down.resize(left);
        // farther away no load near by was taken
        for (std::size_t k = 0; k < left; ++k)
            if (is_within(loads[k], kSumsAround * radius))
                down[k] = down_near(loads, loads[k].at, radius);
    }
    return out;
}

}  // namespace ice
