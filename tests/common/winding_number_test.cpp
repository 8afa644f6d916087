// SPDX-License-Identifier: GPL-3.0-or-later
// Inside tests that do not need a closed surface.
//
// Tolerances: 0.05 is clusters of triangles taken as dipoles; 1e-12 is rounding of a sum of solid
// angles.
#include "common/geometry/winding_number.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include "tests/support/make_meshes.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

// The faces whose corners' mean has f(mean) > 0.
template <class F>
TriangleMesh part_of(const TriangleMesh& mesh, const F& f) {
    TriangleMesh part = mesh;
    part.triangles.clear();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        if (f(Vec3((mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0)) > 0.0)
            part.triangles.push_back(mesh.triangles[t]);
    part.region.assign(part.triangles.size(), 0);
    return part;
}

}  // namespace

TEST_CASE("winding numbers: 1 inside, 0 outside, a half in the middle of a missing half",
          "[winding][analytic]") {
    const WindingNumber whole(test::make_globe(1, 30));
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(-1.5, 1.5);
    for (int k = 0; k < 500; ++k) {
        const Vec3 p(unit(random), unit(random), unit(random));
        if (std::abs(p.norm() - 1.0) < 0.05) continue;
        CHECK(whole.at(p) == Near(p.norm() < 1.0 ? 1.0 : 0.0).margin(0.05));
    }
    const WindingNumber half(
        part_of(test::make_globe(1, 30), [](const Vec3& p) { return -p.x(); }));
    CHECK(half.at(Vec3::Zero()) == Near(0.5).margin(0.05));
}

TEST_CASE("a point is inside a box exactly where its coordinates say so", "[winding][analytic]") {
    const WindingNumber box(test::make_box_mesh(Vec3(2, 1, 0.5)));
    std::mt19937 draw(7);
    std::uniform_real_distribution<double> at(-1.2, 1.2);
    int inside = 0;
    for (int k = 0; k < 10000; ++k) {
        const Vec3 p(at(draw), at(draw), at(draw));
        const bool expected =
            std::abs(p.x()) < 1 && std::abs(p.y()) < 0.5 && std::abs(p.z()) < 0.25;
        REQUIRE((box.at(p) > 0.5) == expected);
        inside += expected;
    }
    CHECK(inside > 200);
    // before the middles of faces, and where their diagonals, edges and corners are in line
    for (const double x : {-0.5, 0.0, 0.5, 0.999})
        for (const double y : {-0.25, 0.0, 0.25, 0.499}) {
            CAPTURE(x, y);
            CHECK(box.at(Vec3(x, y, 0.1)) > 0.5);
            CHECK(box.at(Vec3(x, y, 0.249)) > 0.5);
            CHECK(box.at(Vec3(x, y, 0.251)) < 0.5);
            CHECK(box.at(Vec3(2.0 * x + 0.001, y, 0.3)) < 0.5);
        }
}

TEST_CASE("without triangles nothing is inside, without one face of a cube five sixths",
          "[winding][analytic]") {
    CHECK(WindingNumber(TriangleMesh{}).at(Vec3::Zero()) == 0.0);
    const TriangleMesh cube = test::make_box_mesh(Vec3(1, 1, 1));
    const WindingNumber open(part_of(cube, [](const Vec3& p) { return p.z() + 0.49; }));
    CHECK(open.at(Vec3::Zero()) == Near(5.0 / 6.0).epsilon(1e-12));
}

TEST_CASE("just under a wide flat opening of a fine mesh, what is inside is said exactly",
          "[winding][analytic]") {
    // A globe without what lies above z = 0.29: from below the flat cut, which covers up to half of
    // all directions, the winding number is barely above a half; from above it is below.
    const double rim = std::cos(std::numbers::pi * 61 / 150);  // a parallel of the globe
    const TriangleMesh bowl =
        part_of(test::make_globe(1, 150), [&](const Vec3& p) { return rim - p.z(); });
    const WindingNumber winding(bowl);
    constexpr double kExact = std::numeric_limits<double>::infinity();
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-0.6, 0.6);
    int fooled = 0;
    double worst[2] = {0.0, 0.0};
    for (int k = 0; k < 2000; ++k) {
        const bool inside = k % 2 == 0;
        const Vec3 p(unit(random), unit(random), rim + (inside ? -1e-3 : 1e-3));
        REQUIRE(winding.contains(p) == inside);
        fooled += (winding.at(p) > 0.5) != inside;
        const double exact = winding.at(p, kExact);
        worst[0] = std::max(worst[0], std::abs(winding.at(p) - exact));
        worst[1] = std::max(worst[1], std::abs(winding.at(p, 8.0) - exact));
    }
    CHECK(fooled > 0);
    CHECK(worst[0] < 0.16 / 4);
    CHECK(worst[1] < 0.16 / 64);
}
