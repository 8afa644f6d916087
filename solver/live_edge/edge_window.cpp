// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/live_edge/edge_window.hpp"

#include <algorithm>
#include <cmath>

namespace ice {

namespace {

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
    while (!loads.empty()) {
        double most = 0.0;
        Vec2 middle = Vec2::Zero();
        for (const EdgeLoad& load : loads) {
            const double down = down_near(loads, load.at, radius);
            if (down <= most) continue;
            most = down;
            middle = load.at;
        }
        if (most <= 0.0) break;
        const EdgeWindow window = window_around(loads, middle, radius);
        if (!window.inwards.isZero(0.0)) out.push_back(window);
        std::erase_if(loads, [&](const EdgeLoad& load) {
            return (load.at - middle).squaredNorm() <= radius * radius;
        });
    }
    return out;
}

}  // namespace ice
