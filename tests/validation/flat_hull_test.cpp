// SPDX-License-Identifier: GPL-3.0-or-later
// A floe pressed against a flat hull by its buoyancy: the hull is flat whatever its spheres.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "common/base/units.hpp"
#include "tests/support/make_filled_sets.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/validation/table.hpp"

using namespace ice;

namespace {

const double kPress =
    (1000.0 - 900.0) * 9.81 * test::kPaperFloe.prod();  // what buoyancy exceeds weight by [N]

struct Pressed {
    Vec3 normal = Vec3::Zero(), friction = Vec3::Zero();  // mean forces of the ship on the floe [N]
};

// A floe under the lower face of a plate that turns the bow up by `slope`; the ship moves at 1 m/s.
// Convex solids meet as such in rigid ice, and by their spheres in ice that can be crushed.
Pressed press(double slope, double hull_radius, double hull_spacing, double floe_radius,
              ContactRule rule, double from, double to) {
    Case p = test::empty_space(0.01);
    if (rule.crushes) p.contact.crushing_pressure = 1e9;  // so high that it crushes nothing
    p.gravity = 9.81;
    p.buoyancy = BuoyancyModel::distributed;
    p.normal = rule.normal;
    p.contact.friction_ship_ice = 0.1;
    p.contact.restitution = 0.3;
    p.contact.iterations = 30;
    p.contact.tolerance = 1e-4;
    p.speed_table = {{0.0, 1.0}};
    const Quaternion turn(Eigen::AngleAxisd(-slope, Vec3::UnitY()));
    World w;
    w.parameters = p;
    // the plate's lower face goes through the hull's origin
    SphereSet plate = test::fill_box(Vec3(8, 1.6, 0.6), hull_radius, hull_spacing, turn);
    w.scene = make_scene(build_shape(plate, false), Vec3(0, 0, -6), Vec3(1, 0, 0));
    const auto shape =
        test::add_shape(w, test::fill_box(test::kPaperFloe, floe_radius, floe_radius));
    const Vec3 under = turn * Vec3(0, 0, -0.3 - 0.5 * test::kPaperFloe.z() - 1e-4);
    const std::size_t floe =
        add_floe(w.scene, shape, 900.0, Vec3(0, 0, -6) + under, turn, 0, false);
    // under a slope it starts with the ship and slides up along it
    // under a level hull it is dragged
    if (slope > 0.0) w.scene.bodies.momentum[floe] = w.scene.bodies.mass[floe] * Vec3(1, 0, 0);
    update_derived(w.scene.bodies, floe);
    Pressed out;
    int count = 0;
    while (w.time < to) {
        step(w);
        if (w.time <= from) continue;
        const auto [normal, friction] = test::ship_on_ice(w);
        out.normal += normal;
        out.friction += friction;
        ++count;
    }
    out.normal /= count;
    out.friction /= count;
    return out;
}

}  // namespace

TEST_CASE("a floe under a flat hull presses with its buoyancy and drags with mu of it",
          "[validation]") {
    const double slope = GENERATE(0.0, 20.0, 35.0, 60.0);  // degrees
    const auto [hull_radius, floe_radius] = GENERATE(std::pair(0.1, 0.05), std::pair(0.1, 0.025),
                                                     std::pair(0.05, 0.05), std::pair(0.05, 0.025));
    const double spacing = hull_radius * GENERATE(0.5, 1.0, 2.0);
    const bool by_spheres = GENERATE(true, false);
    CAPTURE(hull_radius, spacing, floe_radius, slope, by_spheres);
    const Pressed got = press(kDegree * slope, hull_radius, spacing, floe_radius,
                              {NormalRule::surface, by_spheres}, 0.3, 1.3);
    const Vec3 down = Eigen::AngleAxisd(-kDegree * slope, Vec3::UnitY()) * Vec3(0, 0, -1);
    test::validate({fmt::format("floe under a flat hull at {:g} degrees: normal force", slope), "N",
                    kPress * std::cos(kDegree * slope), got.normal.norm(),
                    test::within_percent(0.5), "(rho_w - rho_i) g V cos(slope)"});
    test::validate({"floe under a flat hull at any slope: friction over normal force", "", 0.1,
                    got.friction.norm() / got.normal.norm(), test::within_percent(1), "mu"});
    // the sine of the angles; nothing but rounding bends them
    test::validate({"floe under a flat hull at any slope: angle of the force to the hull's normal",
                    "rad", 0.0, got.normal.normalized().cross(down).norm(), test::within(1e-9),
                    "a flat hull pushes along its normal"});
    test::validate(
        {"floe under a flat hull at any slope: angle of the friction to the hull's plane", "rad",
         0.0, got.friction.normalized().dot(down), test::within(1e-9),
         "friction acts in the plane"});
}

TEST_CASE("from centre to centre the same hull is rough: the paper's rule, beside the default",
          "[validation]") {
    // the floe is as heavy as before, but rides over bumps: the drag is no longer 0.1 of that
    const double spacing = GENERATE(0.05, 0.1, 0.2);
    const Pressed got = press(0.0, 0.1, spacing, 0.05, {NormalRule::centres, false}, 0.3, 1.3);
    const double drag = (got.normal + got.friction).x() / kPress;
    test::show({fmt::format("the same hull, level, `normal = \"centres\"`, spheres {:g} m apart: "
                            "drag over buoyancy",
                            spacing),
                "",
                0.1,
                drag,
                {},
                "mu; the paper's rule rides over the spheres"});
    CAPTURE(spacing, drag);
    CHECK(drag > 0.13);
    CHECK(drag < 1.0);
}

namespace {

// Means of the upper floe's forces on a lower one that has settled under it, `offset` from right
// below, and then is given 0.5 m/s: until shortly before friction has stopped it.
Pressed slide_under_another(double radius, double offset) {
    Case p = test::empty_space(0.01);
    p.gravity = 9.81;
    p.buoyancy = BuoyancyModel::distributed;
    p.normal = NormalRule::surface;
    p.contact.friction_ship_ice = 10.0;  // the upper floe stays where it is
    p.contact.friction_ice_ice = 0.3;
    p.contact.iterations = 30;
    p.contact.tolerance = 1e-4;
    World w;
    w.parameters = p;
    w.scene = make_scene(build_shape(test::fill_box(Vec3(4, 1.6, 0.6), 0.1, 0.1), false),
                         Vec3(0, 0, -6), Vec3::Zero());
    const auto shape = test::add_shape(w, test::fill_box(test::kPaperFloe, radius, radius));
    add_floe(w.scene, shape, 900.0, Vec3(0, 0, -6.4501), Quaternion::Identity(), 0, false);
    const std::size_t lower =
        add_floe(w.scene, shape, 900.0, Vec3(offset, 0, -6.7502), Quaternion::Identity(), 0, false);
    while (w.time < 2.0) step(w);
    w.scene.bodies.momentum[lower] += w.scene.bodies.mass[lower] * Vec3(0.5, 0, 0);
    update_derived(w.scene.bodies, lower);
    Pressed out;
    int count = 0;
    while (w.time < 3.2) {
        step(w);
        if (w.time <= 2.2) continue;
        ++count;
        for (const Constraint& c : w.constraints) {
            if (c.a == 0 || c.b == 0) continue;
            const double sign = static_cast<std::size_t>(c.b) == lower ? 1.0 : -1.0;
            out.normal += sign * c.total_normal() / p.time_step * c.normal;
            out.friction += sign * c.total_tangent() / p.time_step;
        }
    }
    out.normal /= count;
    out.friction /= count;
    return out;
}

}  // namespace

TEST_CASE("a floe that slides under another presses with its buoyancy and drags with mu of it",
          "[validation]") {
    // each place has its own pattern of spheres over spheres: a mean over three
    const double radius = GENERATE(0.05, 0.025);
    double mean = 0.0;
    for (const double offset : {0.0, 0.02, 0.04}) {
        const Pressed got = slide_under_another(radius, offset);
        CAPTURE(radius, offset, got.normal.norm());
        mean += got.normal.norm() / 3.0;
        test::validate({"floe sliding under another: friction over normal force", "", 0.3,
                        -got.friction.x() / got.normal.norm(), test::within_percent(1),
                        "mu between floes"});
    }
    test::validate({"floe sliding under another: normal force, mean over three places", "N", kPress,
                    mean, test::within_percent(0.5), "(rho_w - rho_i) g V"});
}
