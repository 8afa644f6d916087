// SPDX-License-Identifier: GPL-3.0-or-later
// A 3D case one metre broad is the 2D case: the same profile, the same forces.
//
// The pieces are 1 m broad, the hull 1 m as well, or 1.6 m: then no piece that has drifted a little
// meets the hull's sharp sides, which 2D does not have.
//
// Tolerances: 2.5 % is half of the bound of the comparison.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"
#include "tests/validation/paper_case.hpp"
#include "tests/validation/table.hpp"

using namespace ice;
using ice::test::tolerance;

namespace {

// The paper's 2D hull and piece (1 x 0.4 m) as sections, or as prisms.
struct Sets {
    SphereSet hull, floe;
};

// breadth of the hull [m]; 0: 2D
const Sets& sets(double breadth) {
    FillOptions options;
    options.radius = options.spacing = 0.1;
    options.surface_only = true;
    static const Sets two = {test::set_of_section("paper-hull-2d", options),
                             test::set_of_section("paper-floe-2d", options)};
    static const SphereSet piece = test::set_of_prism("paper-floe-2d", 1.0, options);
    static const Sets equal = {test::set_of_prism("paper-hull-2d", 1.0, options), piece};
    static const Sets broad = {test::set_of_prism("paper-hull-2d", 1.6, options), piece};
    return breadth == 0.0 ? two : breadth == 1.0 ? equal : broad;
}

// The method's defaults; the ship's bow just clear of x = 0, less `back`.
World ship_world(double breadth, double back, Hold hold) {
    Case p = test::empty_space(0.01);
    p.dimension = breadth == 0.0 ? 2 : 3;
    p.gravity = 9.81;
    p.buoyancy = BuoyancyModel::distributed;
    p.drag = DragModel::panel;
    p.contact.iterations = 30;
    p.contact.tolerance = 1e-4;
    p.speed_table = {{0.0, 0.5}};
    p.floes[0].hold = hold;
    World w;
    w.parameters = p;
    w.scene = make_scene(build_shape(sets(breadth).hull, false), Vec3(-10.05 - back, 0, 0),
                         Vec3(0.5, 0, 0));
    test::add_shape(w, sets(breadth).floe);
    return w;
}

void add_piece(World& w, const Vec3& position) {
    const bool held = w.parameters.floes[0].hold != Hold::never;
    add_floe(w.scene, 1, 900.0, position, Quaternion::Identity(), 0, held);
}

// Mean force of the ice on the ship over 14 m of travel [N], in 2D [N/m].
Vec3 mean_force(World& w) {
    Vec3 sum = Vec3::Zero();
    while (w.time < 28.0) {
        step(w);
        const auto [normal, tangent] = test::ship_on_ice(w);
        sum -= normal + tangent;
    }
    return sum / static_cast<double>(w.steps);
}

Vec3 single_piece(double breadth, const Vec3& position) {
    World w = ship_world(breadth, 0.0, Hold::never);
    add_piece(w, position);
    return mean_force(w);
}

struct Mean {
    Vec3 value, error;  // error: standard one of the mean
};

// A row of pieces, floating and held until the ship's first touch. Its motion is chaotic: the mean
// over starts that differ by a centimetre.
Mean row_of_pieces(double breadth, int starts) {
    Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
    for (int start = 0; start < starts; ++start) {
        World w = ship_world(breadth, 0.013 * start, Hold::until_hull_contact);
        for (int k = 0; k < 14; ++k) add_piece(w, Vec3(0.5 + 1.02 * k, 0, -0.16));
        const Vec3 force = mean_force(w);
        sum += force;
        squares += force.cwiseAbs2();
    }
    const Vec3 mean = sum / starts;
    const Vec3 variance = (squares / starts - mean.cwiseAbs2()).cwiseMax(0.0) / (starts - 1);
    return {mean, variance.cwiseSqrt()};
}

void compare(const std::string& what, const Vec3& two, const Vec3& three, double percent) {
    for (const int axis : {0, 2})
        test::validate({what + ": mean " + (axis == 0 ? "x" : "z") + " force in 3D over that in 2D",
                        "", 1.0, three[axis] / two[axis], test::within_percent(percent),
                        "the same profile"});
}

}  // namespace

TEST_CASE("one piece before the bow or under the bottom: 3D one metre broad equals 2D",
          "[validation][2d]") {
    // not chaotic; the piece under the bottom settles on 200 spheres instead of 10. Under the ship
    // of its own breadth the piece's edges lie on the ship's, where either may be the one to touch
    const auto row = GENERATE(std::pair(1.0, 5.0), std::pair(1.6, 0.1));
    const double breadth = row.first, percent = row.second;
    const Vec3 afloat(0.5, 0, -0.16), below(-3.0, 0, -1.42);
    const auto met = [&](const char* how) {
        return fmt::format("piece 1 m broad {} of a ship {:g} m broad", how, breadth);
    };
    compare(met("before the bow"), single_piece(0.0, afloat), single_piece(breadth, afloat),
            percent);
    compare(met("under the bottom"), single_piece(0.0, below), single_piece(breadth, below),
            percent);
}

TEST_CASE("a row of fourteen pieces: 3D one metre broad equals 2D", "[validation][2d]") {
    const double breadth = GENERATE(1.0, 1.6);
    const Mean two = row_of_pieces(0.0, 4), three = row_of_pieces(breadth, 4);
    CAPTURE(two.value.transpose(), two.error.transpose(), three.value.transpose(),
            three.error.transpose());
    compare(fmt::format("row of 14 pieces 1 m broad met by a ship {:g} m broad", breadth),
            two.value, three.value, 5.0);
    // the means must be known well enough to say so: standard errors below half the bound
    for (const int axis : {0, 2})
        CHECK(std::hypot(two.error[axis], three.error[axis]) <
              tolerance(0.025) * std::abs(two.value[axis]));
}
