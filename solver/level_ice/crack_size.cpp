// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/level_ice/crack_size.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/counter_random.hpp"

namespace ice {

namespace {

// Sides of the arc [-], 20 degrees each. More give pieces more corners, each with a sphere: with 18
// a step takes 1.4 times as long. Fewer make their edges coarse.
constexpr int kSides = 9;
// Breadth of the strip seawards of the load, in radii [-]: ice that stands out beside a notch
// breaks off, too. Less leaves teeth between two notches; more takes ice that no crack reaches.
constexpr double kStrip = 0.5;
// Least factor 1 + C_v v_n of the radius [-], reached at 5.6 m/s with the usual C_v: it keeps the
// radius above 0. Larger stops the radius from falling sooner, smaller gives fast hulls crumbs.
constexpr double kLeast = 0.2;

}  // namespace

double crack_size(const CrackLaw& law, double length, double normal_speed,
                  std::uint64_t crack_number) {
    // (30). C_v is below 0: a fast load breaks shorter pieces. The bound of a fifth keeps the
    // radius positive at any speed.
    const double rest = law.length_factor * length;
    return rest * std::max(kLeast, 1.0 + law.speed_factor * normal_speed) *
           (1.0 + law.scatter * random_offset(law.seed, crack_number));
}

Loop crack_outline(const Vec2& at, const Vec2& inwards, double radius) {
    // The chord lies half a radius seawards of the load, so that ice in front of a notch breaks
    // off with the piece.
    const Vec2 along(inwards.y(), -inwards.x());  // to the right when facing the ice
    const auto place = [&](double x, double y) -> Vec2 { return at + x * along + y * inwards; };
    // The polygon has the half disc's area, on which the opening angle depends: its corners lie 1 %
    // outside of the arc.
    const double side = std::numbers::pi / kSides,
                 reach = radius * std::sqrt(side / std::sin(side));
    Loop out{place(-reach, -kStrip * radius), place(reach, -kStrip * radius)};
    for (int k = 0; k <= kSides; ++k)  // from right to left
        out.push_back(place(reach * std::cos(side * k), reach * std::sin(side * k)));
    return out;
}

}  // namespace ice
