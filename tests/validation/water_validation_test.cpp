// SPDX-License-Identifier: GPL-3.0-or-later
// A floe in water against hydrostatics: draught, periods, righting moment, rise, smoothness.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <numbers>

#include "solver/water/hydrostatics.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/validation/table.hpp"

using namespace ice;

namespace {

constexpr double kWater = 1000.0, kIce = 900.0, kGravity = 9.81, kPi = std::numbers::pi;
const double kDraught = test::kPaperFloe.z() * kIce / kWater;

World floating(double dt, DragModel drag) {
    Case p = test::empty_space(dt);
    p.gravity = kGravity;
    p.buoyancy = BuoyancyModel::distributed;
    p.drag = drag;
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    test::add_shape(w, test::make_box_set(test::kPaperFloe, 0.05, 0.1));
    return w;
}

std::size_t place(World& w, double height, const Quaternion& turn = Quaternion::Identity()) {
    return add_floe(w.scene, 1, kIce, Vec3(0, 0, height), turn, 0, false);
}

// Mean period of a signal of the world [s] from its upward zeros, interpolated, over ten of them.
template <class Signal>
double period(World& w, const Signal& signal) {
    std::vector<double> zeros;
    double last = signal();
    while (zeros.size() < 11) {
        step(w);
        const double now = signal();
        if (last < 0.0 && now >= 0.0)
            zeros.push_back(w.time - w.parameters.time_step * now / (now - last));
        last = now;
        REQUIRE(w.time < 100.0);
    }
    return (zeros.back() - zeros.front()) / 10.0;
}

// Metacentric height of the floating box about an axis along which it is `length` long, with
// `breadth` across: KB + BM - KG.
double metacentric_height(double breadth) {
    return 0.5 * kDraught + breadth * breadth / (12.0 * kDraught) - 0.5 * test::kPaperFloe.z();
}

WaterLoad load_on(World& w) {
    update_derived(w.scene.bodies, 1);
    measure_loads(w.scene, w.parameters, w.loads);
    return w.loads[0];
}

// Largest horizontal section of the turned box: it cannot be larger than one pair of faces seen
// along the vertical allows.
double largest_section(const Mat3& r) {
    double area = 1e300;
    for (int k = 0; k < 3; ++k)
        area = std::min(area, test::kPaperFloe.prod() / test::kPaperFloe[k] / std::abs(r(2, k)));
    return area;
}

}  // namespace

TEST_CASE("a floe comes to float with the draught of its weight", "[validation][water]") {
    World w = floating(0.01, DragModel::panel);
    const std::size_t i = place(w, 0.05);
    // the square law of drag lets small heaving go on for long: its mean over 20 s counts
    double mean = 0.0, count = 0.0;
    while (w.time < 60.0) {
        step(w);
        if (w.time > 40.0) mean += w.scene.bodies.position[i].z(), count += 1.0;
    }
    test::validate({"floe left to float: draught", "m", kDraught,
                    0.5 * test::kPaperFloe.z() - mean / count, test::within_percent(1),
                    "h rho_i / rho_w"});
}

TEST_CASE("heave, roll and pitch have the periods of linear hydrostatics", "[validation][water]") {
    {
        World w = floating(0.01, DragModel::none);
        const double rest = floating_height(w.scene.shapes[1], Mat3::Identity(), kIce / kWater);
        const std::size_t i = place(w, rest - 0.01);
        test::validate({"floating floe: heave period", "s",
                        2.0 * kPi * std::sqrt(kDraught / kGravity),
                        period(w, [&] { return w.scene.bodies.position[i].z() - rest; }),
                        test::within_percent(2), "2 pi sqrt(draught / g); no added mass"});
    }
    for (const int axis : {0, 1}) {
        World w = floating(0.01, DragModel::none);
        const Vec3 about = Vec3::Unit(axis);
        const Quaternion tilt(Eigen::AngleAxisd(-0.02, about));
        const double rest =
            floating_height(w.scene.shapes[1], tilt.toRotationMatrix(), kIce / kWater);
        const std::size_t i = place(w, rest, tilt);
        const double breadth = test::kPaperFloe[1 - axis];
        const double inertia =
            (breadth * breadth + test::kPaperFloe.z() * test::kPaperFloe.z()) / 12.0;  // per mass
        const double expected =
            2.0 * kPi * std::sqrt(inertia / (kGravity * metacentric_height(breadth)));
        // the third component of the upright axis across the tilt
        const auto angle = [&] {
            const Mat3& r = w.scene.bodies.rotation[i];
            return axis == 0 ? r(2, 1) : -r(2, 0);
        };
        test::validate({axis == 0 ? "floating floe: roll period" : "floating floe: pitch period",
                        "s", expected, period(w, angle), test::within_percent(2),
                        "2 pi sqrt(I / (m g GM)), GM = KB + BM - KG"});
    }
}

TEST_CASE("a tilted floe is righted by the moment of the wall-sided formula",
          "[validation][water]") {
    const double degrees = GENERATE(1.0, 2.0, 3.0);  // the deck stays dry: to 3.4 degrees
    const double angle = degrees * kPi / 180.0;
    const int axis = GENERATE(0, 1);
    World w = floating(0.01, DragModel::none);
    const Quaternion tilt(Eigen::AngleAxisd(angle, Vec3::Unit(axis)));
    const double rest = floating_height(w.scene.shapes[1], tilt.toRotationMatrix(), kIce / kWater);
    place(w, rest, tilt);
    const double breadth = test::kPaperFloe[1 - axis];
    const double metacentre = breadth * breadth / (12.0 * kDraught);
    const double arm = std::sin(angle) * (metacentric_height(breadth) +
                                          0.5 * metacentre * std::tan(angle) * std::tan(angle));
    const double expected = kIce * test::kPaperFloe.prod() * kGravity * arm;
    test::validate({fmt::format("floe tilted by {:g} degrees about its {} axis: righting moment",
                                degrees, axis == 0 ? "long" : "short"),
                    "N m", expected, -load_on(w).moment[axis], test::within_percent(1),
                    "m g (GM + BM tan^2 / 2) sin: wall-sided"});
}

TEST_CASE("a released floe rises at its terminal speed", "[validation][water]") {
    World w = floating(0.01, GENERATE(DragModel::projected, DragModel::panel));
    const std::size_t i = place(w, -50.0);
    while (w.time < 10.0) step(w);
    test::validate({"floe rising from 50 m: terminal speed", "m/s",
                    std::sqrt(2.0 * (kWater - kIce) / kWater * kGravity * test::kPaperFloe.z()),
                    w.scene.bodies.velocity[i].z(), test::within_percent(0.5),
                    "sqrt(2 (rho_w - rho_i) g h / (rho_w C_d))"});
}

TEST_CASE("buoyancy and drag have no steps when a floe crosses the surface",
          "[validation][water]") {
    const double tilt = GENERATE(0.0, 0.1, 0.3, 1.0);
    const Quaternion turn(Eigen::AngleAxisd(tilt, Vec3(2, 1, 0).normalized()));
    const Mat3 r = turn.toRotationMatrix();
    constexpr double dz = 1e-4;
    double buoyancy = 0.0, drag = 0.0;
    World still = floating(0.01, DragModel::none),
          rising = floating(0.01, GENERATE(DragModel::projected, DragModel::panel));
    place(still, 1.0, turn);
    place(rising, 1.0, turn);
    const Vec3 velocity(0.5, 0.2, 1.0);
    rising.scene.bodies.momentum[1] = rising.scene.bodies.mass[1] * velocity;
    double last = 0.0, last_drag = 0.0;
    for (double z = 0.8; z > -0.8; z -= dz) {
        still.scene.bodies.position[1].z() = rising.scene.bodies.position[1].z() = z;
        const WaterLoad load = load_on(still);
        const Vec3 resisted = load_on(rising).force - load.force;
        if (z < 0.8) {
            buoyancy = std::max(buoyancy, std::abs(load.force.z() - last) / dz);
            drag = std::max(drag, std::abs(resisted.norm() - last_drag) / dz);
        }
        last = load.force.z();
        last_drag = resisted.norm();
    }
    test::validate(
        {"floe crossing the surface at four tilts: change of buoyancy per metre over "
         "that of its largest waterplane",
         "", 1.0 + 1e-6, buoyancy / (kWater * kGravity * largest_section(r)),
         test::at_most_expected(), "rho_w g A_w"});
    if (tilt == 0.0) return;  // a level face is wet at once
    // every face's wetted part grows by at most twice its area over its height: triangles
    double bound = 0.0;
    for (const Facet& facet : rising.scene.shapes[1].facets) {
        double low = 1e300, high = -1e300;
        for (const Vec3& c : facet.corner) {
            low = std::min(low, r.row(2).dot(c));
            high = std::max(high, r.row(2).dot(c));
        }
        const double facing = (r * facet.area).dot(velocity);
        if (facing > 0.0) bound += 2.0 * facing / (high - low);
    }
    bound *= 0.5 * kWater * velocity.norm();
    test::validate(
        {"moving floe crossing the surface at three tilts: change of drag per metre over "
         "that of its faces' widths",
         "", 1.0, drag / bound, test::at_most_expected(),
         "1/2 rho_w C_d u^2 times the projected widths"});
}
