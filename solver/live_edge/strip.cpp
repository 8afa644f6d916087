// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/live_edge/strip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/assert.hpp"

namespace ice {

namespace {

using Box = Eigen::AlignedBox2d;

// The strip uses the polygons of 3D: it is 1 m broad, so that areas are lengths and sums per metre
// of breadth need no factor. Cuts are wider than that, or a sliver would be left along the sides.
constexpr double kHalf = 0.5;  // half of the breadth of a section's solid [m]: 1 m, by definition
constexpr double kWide = 1.0;  // y of cuts [m]: any number above kHalf gives the same ice
// Cells of a tile at most [-]: it is two to three long, so that the ice under the moment of (30a)
// is one body. More gives more spheres to that body.
constexpr double kCells = 3.0;
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

// Copies the sign of y: the outline keeps its direction, and its two sides stay opposite.
Loop across_strip(Loop outline, double by) {
    for (Vec2& p : outline) p.y() = std::copysign(kHalf + by, p.y());
    return outline;
}

// Symmetric about the tip: ahead of the tip is water, which costs nothing to cut.
Loop strip_crack(double tip, double length) {
    return loop_of(Box(Vec2(tip - length, -kWide), Vec2(tip + length, kWide)));
}

std::vector<EdgeWindow> tip_window(const std::vector<EdgeLoad>& loads, double tip, double length) {
    EdgeWindow out{Vec2(tip, 0.0), Vec2::UnitX(), 0.0, 0.0, 0.0};
    double normal = 0.0, level = 0.0, closing = 0.0;
    for (const EdgeLoad& load : loads) {
        // The bending moment is largest at `length` from the tip: loads behind it bend the next
        // piece.
        if (load.at.x() > tip + length) continue;
        out.down += load.down;
        normal += load.normal;
        level += load.push.norm();
        closing += load.closing;
    }
    // Only a load downwards breaks ice over the water; upwards, the hull lifts the tip.
    if (out.down <= 0.0) return {};
    // load.closing is impulse times speed: the quotient is the mean speed, weighted with the normal
    // impulse, which is above 0 where a load is downwards.
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
    // The end is a corner of a fixed grid, at least two cells behind the tip: as the tip moves
    // within a cell the tile's end stays, and with it the spheres that are not cut off.
    const double to = origin + cell * (std::floor((from - origin) / cell) + kCells);
    return {loop_of(strip_extent(from, std::min(to, box.max().x())))};
}

std::vector<Loop> strip_bodies(const Loop& part, double gap, double least) {
    const Box box = box_of(part);
    const double from = box.min().x() + 0.5 * gap, to = box.max().x() - 0.5 * gap;
    // Written so that a part with no number as its length is left out, too.
    if (!(to - from >= least)) return {};
    return {loop_of(strip_extent(from, to))};
}

double strip_length(const Loop& part) { return box_of(part).sizes().x(); }

}  // namespace ice
