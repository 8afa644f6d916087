// SPDX-License-Identifier: GPL-3.0-or-later
/// Level ice in 2D and ships with a straight stem before it.
#pragma once

#include <cmath>
#include <numbers>

#include "tests/support/edge_checks.hpp"
#include "tests/support/make_filled_sets.hpp"
#include "tests/support/make_worlds.hpp"

namespace ice::test {

/// A hull with a straight stem at the angle `slope` [rad] from the horizontal, which at the height
/// `top` [m] is at x = 0 of its mesh.
inline SphereSet straight_stem(double slope, double depth, double top, double length, double radius,
                               double spacing) {
    const auto stem = [&](double z) { return (z - top) / std::tan(slope); };
    const double deck = top + 0.5 * depth;
    return fill_section({Vec3(stem(-depth) - length, 0, -depth), Vec3(stem(-depth), 0, -depth),
                         Vec3(stem(deck), 0, deck), Vec3(stem(-depth) - length, 0, deck)},
                        radius, spacing);
}

/// The ship `hull` in or before the strip of a case.
inline World strip_world(const Case& p, const SphereSet& hull) {
    World w;
    w.parameters = p;
    w.scene = make_scene(build_shape(hull, false), p.hull_position, Vec3(p.ship_speed(0.0), 0, 0));
    w.edge.begin(w.scene, w.parameters);
    return w;
}

/// Soft ice 0.3 m thick, which breaks 3.4 m from its tip, for a ship at that speed [m/s].
inline Case soft_case(double speed, double duration) {
    Case p;
    p.dimension = 2;
    p.time_step = 0.01;
    p.duration = duration;
    p.average_from = 0.5 * duration;
    p.speed_table = {{0.0, speed}};
    p.contact.restitution = 0.1;
    p.contact.crushing_pressure = 1e6;
    p.frames_every = 0.5;
    p.history_every = 0.1;
    lay_weak_ice(p, {0.0, 60.0, 0.0, 0.0}, 0.1);
    p.hull_position = Vec3(-0.02, 0, 0);
    p.resolved = "\n[simulation]\ndimension = 2\nduration = 1.2\n";
    return p;
}

/// A ship 12 m long, its stem at 40 degrees, before the ice of soft_case().
inline World soft_world(const Case& p) {
    static const SphereSet ship =
        straight_stem(40.0 / 180.0 * std::numbers::pi, 2.0, 0.03, 10.0, 0.1, 0.1);
    return strip_world(p, ship);
}

}  // namespace ice::test
