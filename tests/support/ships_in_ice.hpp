// SPDX-License-Identifier: GPL-3.0-or-later
/// Ships that answer the ice: a box among floes.
#pragma once

#include <limits>

#include "tests/support/make_worlds.hpp"

namespace ice::test {

// A box of 4 x breadth x 1 m without water, free as told, at 1 m/s.
inline World box_ship(double mass, double breadth, std::initializer_list<Freedom> free) {
    Case p = empty_space(0.01);
    p.contact.friction_ship_ice = 0.0;
    p.speed_table = {{0.0, 1.0}};
    for (const Freedom k : free) p.ship.free[k] = true;
    p.ship.mass = mass;
    p.ship.centre_of_gravity = Vec3::Zero();
    p.ship.gyration = Vec3(1.0, 1.5, 1.5);
    return plate_world(p, Vec3(4, breadth, 1), 0.1, 0.4, -0.5);
}

// Ice that a ship pushes and shears, with water: rows of 5 floes before a box, one of them held.
inline World rough_ride(double mass, std::initializer_list<Freedom> free, int rows = 6,
                        int held_row = 5) {
    Case p = empty_space(0.01);
    p.gravity = 9.81;
    p.buoyancy = BuoyancyModel::distributed;
    p.drag = DragModel::panel;
    p.speed_table = {{0.0, 1.0}};
    p.contact.crushing_pressure = 2e5;
    p.contact.iterations = 30;
    p.contact.tolerance = 1e-4;
    for (const Freedom k : free) p.ship.free[k] = true;
    p.ship.mass = mass;
    p.ship.centre_of_gravity = Vec3::Zero();
    World w = plate_world(p, Vec3(4, 2, 1), 0.1, 0.25, -0.5);
    const auto box = add_shape(w, make_box_set(Vec3(0.8, 0.6, 0.2), 0.05, 0.1));
    for (int row = 0; row < rows; ++row)
        for (int k = 0; k < 5; ++k)
            add_floe(w.scene, box, 900.0, Vec3(2.45 + 0.85 * row, -1.28 + 0.64 * k, -0.08),
                     Quaternion(Eigen::AngleAxisd(0.02 * (row - k), Vec3::UnitZ())), 0,
                     row == held_row && k == 2);
    w.parameters.floes[0].hold = Hold::until_hull_contact;
    return w;
}

// ... with thrust, a tow and a mooring
inline World hauled_ride(double pressure, std::initializer_list<Freedom> free) {
    World w = rough_ride(4000.0, free, 6, 0);
    Case& p = w.parameters;
    p.contact.crushing_pressure = pressure;
    p.floes[0].hold = Hold::always;  // the one before the bow
    p.propulsion.thrust = 8000.0;
    p.tow = {Vec3(2.0, 0.0, 0.3), 4000.0, 300.0};
    p.mooring.stiffness = {100.0, 4000.0, 0.0, 0.0, 0.0, 3000.0};
    p.mooring.pretension = {0.0, 150.0, 0.0, 0.0, 0.0, 40.0};
    p.ship.added_mass = {0.1, 0.6, 0.9, 0.2, 0.7, 0.3};
    p.ship.damping = {0.0, 0.1, 0.1, 0.05, 0.1, 0.1};
    return w;
}

// The same without held ice and crushing, solved as far as rounding lets it: two of these worlds
// that differ by rounding do so after a hundred steps, too. Ice that crushes in a jam multiplies
// it.
inline World smooth_ride(double mass, std::initializer_list<Freedom> free, int rows = 6) {
    World w = rough_ride(mass, free, rows);
    Case& p = w.parameters;
    p.contact.crushing_pressure = std::numeric_limits<double>::infinity();
    p.contact.friction_ice_ice = 0.1;
    p.contact.iterations = 2000;
    p.contact.tolerance = 1e-11;
    p.floes[0].hold = Hold::never;
    for (std::size_t i = 1; i < w.scene.bodies.size(); ++i)
        if (w.scene.bodies.held[i]) release(w.scene.bodies, i);
    return w;
}

}  // namespace ice::test
