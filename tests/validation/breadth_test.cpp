// SPDX-License-Identifier: GPL-3.0-or-later
// A 3D case one metre broad is the 2D case: the same profile, the same forces.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/make_worlds.hpp"
#include "tests/validation/paper_case.hpp"
#include "tests/validation/table.hpp"

using namespace ice;

namespace {

// The paper's 2D hull and piece (1 x 0.4 m) as sections, or as prisms of 1 m breadth.
struct Sets {
    SphereSet hull, floe;
};

const Sets& sets(int dimension) {
    FillOptions options;
    options.radius = options.spacing = 0.1;
    options.surface_only = true;
    const auto make = [&](int d) {
        const auto set = d == 2 ? test::set_of_section : test::set_of_prism;
        return Sets{set("paper-hull-2d", options), set("paper-floe-2d", options)};
    };
    static const Sets two = make(2), three = make(3);
    return dimension == 2 ? two : three;
}

// The method's defaults; the ship's bow just clear of x = 0, less `back`.
World ship_world(int dimension, double back, Hold hold) {
    Case p = test::empty_space(0.01);
    p.dimension = dimension;
    p.gravity = 9.81;
    p.buoyancy = BuoyancyModel::distributed;
    p.drag = DragModel::panel;
    p.iterations = 30;
    p.tolerance = 1e-4;
    p.speed_table = {{0.0, 0.5}};
    p.floes[0].hold = hold;
    World w;
    w.parameters = p;
    w.scene = make_scene(build_shape(sets(dimension).hull, false), Vec3(-10.05 - back, 0, 0),
                         Vec3(0.5, 0, 0));
    test::add_shape(w, sets(dimension).floe);
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

Vec3 single_piece(int dimension, const Vec3& position) {
    World w = ship_world(dimension, 0.0, Hold::never);
    add_piece(w, position);
    return mean_force(w);
}

struct Mean {
    Vec3 value, error;  // error: standard one of the mean
};

// A row of pieces, floating and held until the ship's first touch. Its motion is chaotic: the mean
// over starts that differ by a centimetre.
Mean row_of_pieces(int dimension, int starts) {
    Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
    for (int start = 0; start < starts; ++start) {
        World w = ship_world(dimension, 0.013 * start, Hold::until_hull_contact);
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
        test::validate({what + ": mean " + (axis == 0 ? "x" : "z") +
                            " force of a 3D case 1 m broad over that of the 2D one",
                        "", 1.0, three[axis] / two[axis], test::within_percent(percent),
                        "the same profile"});
}

}  // namespace

TEST_CASE("one piece before the bow or under the bottom: 3D one metre broad equals 2D",
          "[validation][2d]") {
    // not chaotic; the piece under the bottom settles on 200 spheres instead of 10
    const Vec3 afloat(0.5, 0, -0.16), below(-3.0, 0, -1.42);
    compare("one piece pushed by the bow", single_piece(2, afloat), single_piece(3, afloat), 1.0);
    compare("one piece under the bottom", single_piece(2, below), single_piece(3, below), 1.0);
}

TEST_CASE("a row of fourteen pieces: 3D one metre broad equals 2D", "[validation][2d]") {
    const Mean two = row_of_pieces(2, 4), three = row_of_pieces(3, 4);
    CAPTURE(two.value.transpose(), two.error.transpose(), three.value.transpose(),
            three.error.transpose());
    compare("row of 14 pieces met by the ship", two.value, three.value, 5.0);
    // the means must be known well enough to say so: standard errors below half the bound
    for (const int axis : {0, 2})
        CHECK(std::hypot(two.error[axis], three.error[axis]) < 0.025 * std::abs(two.value[axis]));
}
