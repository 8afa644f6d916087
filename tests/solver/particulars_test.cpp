// SPDX-License-Identifier: GPL-3.0-or-later
// Ship, ice and travel in a few numbers.
//
// Tolerances: 1e-12 m is rounding of the bisection for a height.
#include <catch2/catch.hpp>
#include <numbers>

#include "common/base/units.hpp"
#include "solver/record/measure_particulars.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// A pontoon of 12 x 2 x 1 m whose lower face is at `lower_face`.
World pontoon_world(double lower_face) {
    Case p = empty_space(0.01);
    p.water_density = 1025.0;
    p.speed_table = {{0.0, 2.0}};
    return plate_world(p, Vec3(12, 2, 1), 0.1, 0.2, lower_face);
}

// Bow raked by 40 degrees, half angle of the waterline 25 degrees, 2 m broad, z from -1 to 0.5.
TriangleMesh make_wedge() {
    const double rake = 1.0 / std::tan(40 * kDegree), run = 1.0 / std::tan(25 * kDegree);
    TriangleMesh mesh;
    for (const double z : {-1.0, 0.5}) {
        const double x = 10.0 + z * rake;
        mesh.vertices.insert(mesh.vertices.end(),
                             {Vec3(x, 0, z), Vec3(x - run, 1, z), Vec3(-20, 1, z), Vec3(-20, -1, z),
                              Vec3(x - run, -1, z)});
    }
    for (int k = 0; k < 5; ++k) {
        const int n = (k + 1) % 5;
        mesh.triangles.push_back({k, n, 5 + k});
        mesh.triangles.push_back({n, 5 + n, 5 + k});
    }
    for (int k = 1; k < 4; ++k) {  // floor and deck as fans
        mesh.triangles.push_back({0, k + 1, k});
        mesh.triangles.push_back({5, 5 + k, 5 + k + 1});
    }
    mesh.region.assign(mesh.triangles.size(), 0);
    return mesh;
}

// Its water plane: a rectangle and a triangle.
double wedge_plane_area(double x_stem) {
    const double run = 1.0 / std::tan(25 * kDegree);
    return 2.0 * (x_stem - run + 20.0) + run;
}

}  // namespace

TEST_CASE("a pontoon's draught, length, breadth and displacement are those of its box",
          "[record][analytic]") {
    const World w = pontoon_world(-0.4);
    const ShipParticulars ship = measure_ship(w.scene, w.parameters);
    CHECK(ship.draught == Near(0.4));
    CHECK(ship.length == Near(12.0));
    CHECK(ship.breadth == Near(2.0));
    CHECK(ship.displacement == Near(1025.0 * 12 * 2 * 0.4));
}

TEST_CASE("a hull's angles and displacement are measured from its mesh", "[record][analytic]") {
    World w = pontoon_world(-0.4);
    SphereSet hull = make_box_set(Vec3(12, 2, 1), 0.1, 0.2);
    hull.mesh = make_wedge();
    hull.solid = measure_mass(hull.mesh);
    w.scene.shapes[0] = build_shape(hull, false);
    w.scene.bodies.position[kShip] = Vec3(5.0, 0.0, 0.2);  // draught 0.8 m
    const ShipParticulars ship = measure_ship(w.scene, w.parameters);
    const double rake = 1.0 / std::tan(40 * kDegree);
    CHECK(ship.draught == Near(0.8));
    CHECK(ship.length == Near(30.0 - 0.2 * rake));
    CHECK(ship.stem_angle_deg == Near(40.0));
    CHECK(ship.entrance_angle_deg == Near(25.0));
    // the plane's area is linear in z: its middle one times the draught
    const double middle = wedge_plane_area(10.0 - 0.6 * rake);
    CHECK(ship.displacement == Near(1025.0 * 0.8 * middle));
}

TEST_CASE("a hull that does not cross the water has a draught alone", "[record][degenerate]") {
    const double lower_face = GENERATE(0.1, 0.0, -1.5);
    const World w = pontoon_world(lower_face);
    const ShipParticulars ship = measure_ship(w.scene, w.parameters);
    CHECK(ship.draught == Near(-lower_face).margin(1e-12));
    CHECK(std::isnan(ship.length));
    CHECK(std::isnan(ship.displacement));
    Summary summary;
    fill_particulars(w.scene, w.parameters, 1.0, summary);
    CHECK(summary.formulas.empty());
    CHECK_FALSE(summary.lindqvist_submersion);
}

TEST_CASE("sizes of floes are diameters of circles with their plan area, however they lie",
          "[record][analytic]") {
    World w = pontoon_world(-0.4);
    const auto small = add_shape(w, make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    const auto large = add_shape(w, make_box_set(Vec3(2, 1.5, 0.3), 0.05, 0.1));
    w.parameters.floes.resize(2);
    w.parameters.floes[1].hold = Hold::always;
    const Quaternion turned(Eigen::AngleAxisd(0.7, Vec3::UnitZ()));
    add_floe(w.scene, small, 900.0, Vec3(9, 0, 0), turned, 0, false);
    add_floe(w.scene, large, 900.0, Vec3(12, 0, 0), turned, 0, false);
    add_floe(w.scene, large, 900.0, Vec3(12, 9, 0), turned, 1, true);  // unbroken: not counted
    const IceParticulars ice = measure_ice(w.scene, w.parameters);
    const auto size = [](double area) { return 2.0 * std::sqrt(area / std::numbers::pi); };
    CHECK(ice.floes == 2);
    CHECK(ice.thickness == Near(0.3));
    CHECK(ice.floe_size_min == Near(size(0.8)));
    CHECK(ice.floe_size_max == Near(size(3.0)));
    CHECK(ice.floe_size_mean == Near(0.5 * (size(0.8) + size(3.0))));
    CHECK(ice.hold == std::vector<std::string>{"never", "always"});
    CHECK(std::isnan(ice.concentration));
    CHECK(std::isinf(ice.crushing_pressure));

    // standing on its side: 0.3 m by 0.8 m seen from above, and 1 m thick
    w.parameters.floes[0].orientation =
        Quaternion(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitY()));
    const IceParticulars upright = measure_ice(w.scene, w.parameters);
    CHECK(upright.thickness == Near(1.0));
    CHECK(upright.floe_size_min == Near(size(0.24)));
}

TEST_CASE("travel is the integral of the speed table, in metres and ship lengths",
          "[record][analytic]") {
    World w = pontoon_world(-0.4);
    Case& p = w.parameters;
    // 0 to 10 s: 1 to 3 m/s, then 3 m/s: 20 m and 3 m/s
    p.speed_table = {{0.0, 1.0}, {10.0, 3.0}};
    p.average_from = 5.0;
    CHECK(p.ship_travel(0.0, 10.0) == Near(20.0));
    CHECK(p.ship_travel(0.0, 14.0) == Near(32.0));
    CHECK(p.ship_travel(11.0, 12.0) == Near(3.0));
    CHECK(p.ship_travel(2.0, 2.0) == 0.0);
    Summary summary;
    fill_particulars(w.scene, p, 14.0, summary);
    CHECK(summary.travel.distance == Near(32.0));
    CHECK(summary.travel.lengths == Near(32.0 / 12.0));
    CHECK(summary.travel.averaged_lengths == Near((32.0 - 7.5) / 12.0));
    CHECK(summary.ship.speed_mean == Near((32.0 - 7.5) / 9.0));
    // a run that was interrupted before the averages began
    fill_particulars(w.scene, p, 4.0, summary);
    CHECK(summary.travel.averaged_lengths == 0.0);
    CHECK(summary.ship.speed_mean == Near(5.6 / 4.0));
}

TEST_CASE("in 2D floes have a length and the ship no breadth", "[record]") {
    Case p = empty_space(0.01);
    p.dimension = 2;
    World w;
    w.parameters = p;
    w.scene = make_scene(build_shape(make_box_set(Vec3(8, 1, 1), 0.1, 0.2, 2), false),
                         Vec3(0, 0, 0.1), Vec3::Zero());
    const auto row = add_shape(w, make_box_set(Vec3(1.5, 1, 0.3), 0.05, 0.1, 2));
    add_floe(w.scene, row, 900.0, Vec3(9, 0, 0), Quaternion::Identity(), 0, false);
    const ShipParticulars ship = measure_ship(w.scene, p);
    CHECK(ship.draught == Near(0.4));
    CHECK(ship.length == Near(8.0));
    CHECK(std::isnan(ship.breadth));
    CHECK(std::isnan(ship.displacement));
    CHECK(measure_ice(w.scene, p).floe_size_mean == Near(1.5));
}
