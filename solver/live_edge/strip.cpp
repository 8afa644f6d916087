// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/live_edge/strip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/assert.hpp"

namespace ice {

namespace {

using Box = Eigen::AlignedBox2d;

constexpr double kHalf = 0.5;   // of the breadth of a section's solid [m]
constexpr double kWide = 1.0;   // y of cuts, beyond its sides [m]
constexpr double kCells = 3.0;  // of a tile
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Box box_of(const Loop& loop) {
    Box box;
    for (const Vec2& p : loop) box.extend(p);
    return box;
}

}  // namespace

Box strip_extent(double from, double to) { return {Vec2(from, -kHalf), Vec2(to, kHalf)}; }

double tip_of(const IceSheet& strip) {
    ICE_ASSERT(strip.loops().size() <= 1);
    return strip.loops().empty() ? kInfinity : box_of(strip.loops()[0]).min().x();
}

Loop across_strip(Loop outline, double by) {
    for (Vec2& p : outline) p.y() = std::copysign(kHalf + by, p.y());
    return outline;
}

Loop strip_crack(double tip, double length) {
    return loop_of(Box(Vec2(tip - length, -kWide), Vec2(tip + length, kWide)));
}

std::vector<EdgeWindow> tip_window(const std::vector<EdgeLoad>& loads, double tip, double length) {
    EdgeWindow out{Vec2(tip, 0.0), Vec2::UnitX(), 0.0, 0.0, 0.0};
    double normal = 0.0, level = 0.0, closing = 0.0;
    for (const EdgeLoad& load : loads) {
        if (load.at.x() > tip + length) continue;
        out.down += load.down;
        normal += load.normal;
        level += load.push.norm();
        closing += load.closing;
    }
    if (out.down <= 0.0) return {};
    out.closing = closing / normal;
    // a flat bottom that settles on the tip pushes straight down: no speed along its outline
    if (level > 0.0) out.normal_speed = closing / level;
    return {out};
}

std::vector<Loop> strip_tiles(const IceSheet& strip, double origin, double cell) {
    ICE_ASSERT(strip.loops().size() <= 1);
    if (strip.loops().empty()) return {};
    const Box box = box_of(strip.loops()[0]);
    const double from = box.min().x();
    const double to = origin + cell * (std::floor((from - origin) / cell) + kCells);
    return {loop_of(strip_extent(from, std::min(to, box.max().x())))};
}

std::vector<Loop> strip_bodies(const Loop& part, double gap, double least) {
    const Box box = box_of(part);
    const double from = box.min().x() + 0.5 * gap, to = box.max().x() - 0.5 * gap;
    if (!(to - from >= least)) return {};
    return {loop_of(strip_extent(from, to))};
}

double strip_length(const Loop& part) { return box_of(part).sizes().x(); }

}  // namespace ice
