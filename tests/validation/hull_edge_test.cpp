// SPDX-License-Identifier: GPL-3.0-or-later
// The hull's own edges, corner and stem driven into ice that cannot move, and ice that turns while
// the hull crushes it: the force is the crushing pressure on the section, to a row of patches.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "common/base/units.hpp"
#include "tests/support/make_filled_sets.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

constexpr double kSpeed = 0.5;     // [m/s]
constexpr double kStep = 0.002;    // 1 mm of travel
const Vec3 kPlate(1.2, 2.4, 0.3);  // its face across x is hit in the middle
const Vec3 kBlock(1.2, 1.2, 1.2);  // for the corner: no edge of it is near
constexpr double kTop = 0.15;      // of the plate [m]
const double kRadii[][2] = {{0.1, 0.1}, {0.1, 0.025}, {0.05, 0.05}};  // of hull and ice
constexpr double kDepths[] = {0.06, 0.15, 0.29};

// What is driven: a box of the hull, turned, its foremost point or edge ahead.
struct Tip {
    std::string name;
    double rake = 0.0;    // dx / dz of a right-angled wedge's edge: it leans forward with height
    bool corner = false;  // of a cube, its diagonal along x

    TriangleMesh mesh() const {
        TriangleMesh m = test::make_box_mesh(corner ? Vec3(1.2, 1.2, 1.2) : Vec3(1.2, 1.2, 2.0));
        const Quaternion turn = corner ? Quaternion::FromTwoVectors(Vec3(1, 1, 1), Vec3::UnitX())
                                       : Quaternion(Eigen::AngleAxisd(45 * kDegree, Vec3::UnitZ()));
        for (Vec3& v : m.vertices) {
            v = turn * v;
            v.x() += rake * v.z();
        }
        return m;
    }
    // x of the point that meets the ice first, from the hull's origin
    double reach() const { return 0.6 * std::sqrt(corner ? 3.0 : 2.0) + rake * kTop; }
    // height of the plate that the edge has entered at a depth counted at the plate's top [m]
    double entered(double depth) const {
        return rake > 0.0 ? std::min(kPlate.z(), depth / rake) : kPlate.z();
    }
    // of the ice's section across x [m2]: a regular triangle; a right angle's width is 2 depth
    double section(double depth) const {
        if (corner) return 1.5 * std::sqrt(3.0) * depth * depth;
        const double h = entered(depth);
        return 2.0 * (depth * h - 0.5 * rake * h * h);
    }
    // a row of patches along the outline of the contact, of a side `spacing` each [m2]
    double row(double depth, double spacing) const {
        if (corner) return spacing * std::max(spacing, 1.5 * std::sqrt(6.0) * depth);
        return spacing * std::max(spacing, entered(depth));
    }
};

std::vector<Tip> tips() {
    return {{"edge"},
            {"corner", 0.0, true},
            {"stem that leans 20 degrees", std::tan(20 * kDegree)},
            {"edge across the plate's edge", std::tan(60 * kDegree)}};
}

Case driven_case(double pressure) {
    Case p = test::empty_space(kStep);
    p.contact.crushing_pressure = pressure;
    p.contact.friction_ship_ice = 0.0;
    p.speed_table = {{0.0, kSpeed}};
    p.floes[0].hold = Hold::always;
    return p;
}

World drive_into(const SphereSet& hull, double reach, const SphereSet& ice, double pressure) {
    World w;
    w.parameters = driven_case(pressure);
    const double length = ice.mesh.vertices[1].x() - ice.mesh.vertices[0].x();
    w.scene = make_scene(build_shape(hull, false), Vec3(-0.5 * length - reach - 1e-6, 0, 0),
                         Vec3(kSpeed, 0, 0));
    add_floe(w.scene, test::add_shape(w, ice), 900.0, Vec3::Zero(), Quaternion::Identity(), 0,
             true);
    return w;
}

World drive_into(const Tip& tip, double r_hull, double r_ice, double pressure) {
    return drive_into(test::fill_surface(tip.mesh(), r_hull, r_hull), tip.reach(),
                      test::fill_box(tip.corner ? kBlock : kPlate, r_ice, r_ice), pressure);
}

double force_at(World& w, double depth) {
    while (w.time * kSpeed < depth - 1e-9) step(w);
    return test::ship_on_ice(w).first.x();
}

}  // namespace

// validation_tests "[.sections]" prints the table of README.md beside this file.
TEST_CASE("force over pressure times section of the hull's tips", "[.sections]") {
    fmt::print(
        "| tip | hull's and ice's spheres | 0.06 m | 0.15 m | 0.29 m |\n"
        "|---|---|---|---|---|\n");
    for (const Tip& tip : tips())
        for (const auto& [r_hull, r_ice] : kRadii) {
            World w = drive_into(tip, r_hull, r_ice, 2e5);
            fmt::print("| {} | {:g}, {:g} m |", tip.name, r_hull, r_ice);
            for (const double depth : kDepths)
                fmt::print(" {:.2f} |", force_at(w, depth) / (2e5 * tip.section(depth)));
            fmt::print("\n");
        }
}

TEST_CASE(
    "the hull's edge, corner and stem in held ice meet the pressure on their section at every "
    "depth, to a row and a half of patches",
    "[validation][crushing]") {
    const Tip tip = GENERATE(from_range(tips()));
    const auto& [r_hull, r_ice] = kRadii[GENERATE(0, 1, 2)];
    const double pressure = GENERATE(2e5, 1e6);
    World w = drive_into(tip, r_hull, r_ice, pressure);
    for (const double depth : kDepths) {
        const double got = force_at(w, depth) / pressure, section = tip.section(depth);
        const double row = tip.row(depth, std::max(r_hull, r_ice));
        CAPTURE(tip.name, r_hull, r_ice, pressure, depth, got / section, row / section);
        // a row along the outline, half of one at either side
        CHECK(got <= section + row);
        // and half a row where the ice's spheres under the patches of the hull's edge replace them:
        // they lie between those of the hull
        CHECK(got >= section - 1.5 * row);
    }
}

TEST_CASE("a face of the hull on half a face of the ice meets the pressure on that half",
          "[validation][crushing]") {
    // three rows of patches in the ice's face at least
    const auto& [r_hull, r_ice] =
        GENERATE(table<double, double>({{0.1, 0.05}, {0.05, 0.05}, {0.05, 0.025}}));
    const double pressure = GENERATE(2e5, 1e6);
    TriangleMesh mesh = test::make_box_mesh(Vec3(0.4, 2.0, 1.0));
    for (Vec3& v : mesh.vertices) v.y() += 1.0;  // from the middle of the ice's face on
    World w = drive_into(test::fill_surface(mesh, r_hull, r_hull), 0.2,
                         test::fill_box(kPlate, r_ice, r_ice), pressure);
    for (const double depth : {0.01, 0.05, 0.1}) {
        const double got = force_at(w, depth) / pressure, half = 0.5 * kPlate.y() * kPlate.z();
        CAPTURE(r_hull, r_ice, pressure, depth, got / half);
        // the row at the hull's edge: its spheres stand one radius in, its patches half a spacing
        // farther
        CHECK(got == Near(half).margin(1.5 * std::max(r_hull, r_ice) * kPlate.z()));
    }
}

namespace {

// A convex outline in the level plane.
using Outline = std::vector<Eigen::Vector2d>;

// The part of an outline with n . p <= c.
Outline cut(const Outline& from, const Eigen::Vector2d& n, double c) {
    Outline out;
    for (std::size_t k = 0; k < from.size(); ++k) {
        const Eigen::Vector2d &p = from[k], &q = from[(k + 1) % from.size()];
        const double hp = n.dot(p) - c, hq = n.dot(q) - c;
        if (hp <= 0.0) out.push_back(p);
        if ((hp <= 0.0) != (hq <= 0.0)) out.push_back(p + hp / (hp - hq) * (q - p));
    }
    return out;
}

double area(const Outline& o) {
    double twice = 0.0;
    for (std::size_t k = 0; k < o.size(); ++k) {
        const Eigen::Vector2d &p = o[k], &q = o[(k + 1) % o.size()];
        twice += p.x() * q.y() - p.y() * q.x();
    }
    return 0.5 * twice;
}

}  // namespace

TEST_CASE("a corner of ice that turns while it is crushed takes the pressure times what is crushed",
          "[validation][crushing]") {
    const auto& [r_hull, r_ice] = kRadii[GENERATE(0, 1, 2)];
    const double pressure = GENERATE(2e5, 1e6);
    const double turning = GENERATE(-0.8, 0.0, 0.8);  // [rad/s]: 0.32 rad over the test
    World w;
    w.parameters = driven_case(pressure);
    w.parameters.floes[0].hold = Hold::never;
    const Vec3 floe(1.0, 1.0, 0.3);
    const double reach = std::sqrt(0.5);
    w.scene = make_scene(build_shape(test::fill_box(Vec3(0.4, 4, 1), r_hull, r_hull), false),
                         Vec3(-reach - 0.2 - 1e-6, 0, 0), Vec3(kSpeed, 0, 0));
    // so heavy that it turns on as if nothing met it
    add_floe(w.scene, test::add_shape(w, test::fill_box(floe, r_ice, r_ice)), 1e12, Vec3::Zero(),
             Quaternion(Eigen::AngleAxisd(45 * kDegree, Vec3::UnitZ())), 0, false);
    Bodies& b = w.scene.bodies;
    b.angular_velocity[1] = Vec3(0, 0, turning);
    b.angular_momentum[1] = b.inverse_inertia_world[1].inverse() * b.angular_velocity[1];
    Outline whole = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}, left = whole;
    double work = 0.0;
    while (w.time < 0.4 - 1e-9) {
        step(w);
        // the floe's own axes; what lies behind the hull's face is gone
        const Mat3 turn = b.rotation[1].transpose();
        const Vec3 n = turn * -Vec3::UnitX();
        left = cut(left, n.head<2>(), reach + 1e-6 - kSpeed * w.time);
        for (const Constraint& c : w.constraints)
            if (c.a == 0) work -= c.total_normal() * c.approach;
    }
    const double crushed = (area(whole) - area(left)) * floe.z();
    CAPTURE(r_hull, r_ice, pressure, turning, work / (pressure * crushed));
    // half a row of patches more or less all along the way of 0.2 m, 0.4 m broad at its end
    CHECK(
        work ==
        Near(pressure * crushed).margin(pressure * floe.z() * 0.5 * std::max(r_hull, r_ice) * 0.2));
}
