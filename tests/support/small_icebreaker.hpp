// SPDX-License-Identifier: GPL-3.0-or-later
/// A small icebreaker that goes into a sheet of level ice.
#pragma once

#include "solver/scene/set_added_mass.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/edge_checks.hpp"
#include "tests/support/make_filled_sets.hpp"
#include "tests/support/make_prisms.hpp"
#include "tests/support/make_worlds.hpp"

namespace ice::test {

// A wedge of a bow that leans forward, 12 m long and 4 m broad on deck.
inline SphereSet wedge_ship() {
    const std::vector<Vec3> low{
        {-6, -1.4, -0.8}, {0.5, -1.4, -0.8}, {3.2, 0, -0.8}, {0.5, 1.4, -0.8}, {-6, 1.4, -0.8}},
        high{{-6, -2, 0.6}, {2, -2, 0.6}, {6, 0, 0.6}, {2, 2, 0.6}, {-6, 2, 0.6}};
    return fill_surface(make_ring_mesh(low, high), 0.15, 0.22);
}

// Soft ice 0.3 m thick whose cracks are about 1 m from the load.
inline Case sheet_case(double speed, double duration) {
    Case p;
    p.time_step = 0.02;
    p.duration = duration;
    p.average_from = 0.5 * duration;
    p.speed_table = {{0.0, speed}};
    p.contact.restitution = 0.1;
    p.contact.crushing_pressure = 1e6;
    p.frames_every = 0.5;
    p.history_every = 0.1;
    lay_weak_ice(p, {0.0, 40.0, -8.0, 8.0}, 0.2);
    p.hull_position = Vec3(-5.8, 0, 0);
    p.resolved = "\n[simulation]\nduration = 1.2\n";
    return p;
}

inline World make_world(const Case& p) {
    static const Shape ship = build_shape(wedge_ship(), false);
    World w;
    w.parameters = p;
    w.scene = make_scene(ship, p.hull_position, Vec3(p.ship_speed(0.0), 0, 0));
    w.edge.begin(w.scene, w.parameters);
    if (p.floes_move_water) set_added_mass(w.scene, w.parameters);
    return w;
}

}  // namespace ice::test
