// SPDX-License-Identifier: GPL-3.0-or-later
// Where the fill starts along edges, and when a centre counts as settled.
//
// Tolerance: 1e-12 m is rounding of coordinates of a metre.
#include "preprocess/fill/edge_chains.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "preprocess/fill/offset_surface.hpp"
#include "tests/support/make_prisms.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::tolerance;

TEST_CASE("both rims of a drum are polylines that end where they begin", "[fill][edges]") {
    // 32 sides: the rim turns by 11 degrees from side to side, the faces meet at a right angle
    std::vector<Vec3> low, high;
    for (int k = 0; k < 32; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / 32.0;
        low.emplace_back(std::cos(angle), std::sin(angle), -0.5);
        high.emplace_back(std::cos(angle), std::sin(angle), 0.5);
    }
    const TriangleMesh drum = test::make_ring_mesh(low, high);
    const SurfaceTree tree(drum);
    const auto rims = trace_sharp_edges(tree, 0.1, 0.05, std::cos(0.5));
    REQUIRE(rims.size() == 2);
    for (const std::vector<Vec3>& rim : rims) {
        REQUIRE(rim.size() >= 32);
        CHECK((rim.front() - rim.back()).norm() < tolerance(1e-12));
    }
}

TEST_CASE("far from the origin along one axis a centre is settled within its rounding",
          "[fill][analytic]") {
    constexpr double kUnit = 8.0 * std::numeric_limits<double>::epsilon();
    for (const Vec3& far : {Vec3(-1e6, 0, 1), Vec3(0, 1e6, 0), Vec3(2, 3, 1e6)})
        CHECK(exact_distance(far, 0.1) == kUnit * 1e6);
    CHECK(exact_distance(Vec3(1, -2, 0), 0.1) == 1e-10 * 0.1);
}
