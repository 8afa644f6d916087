// SPDX-License-Identifier: GPL-3.0-or-later
// Volumes by rows, and the proofs made of them and of winding numbers.
//
// Tolerances: 1e-14 and 1e-12 are rounding of a sum; 0.2 to 5 % are the sampling error of rows and
// places, which falls with their number.
#include <catch2/catch.hpp>

#include "common/geometry/mass_properties.hpp"
#include "preprocess/measure/row_volumes.hpp"
#include "preprocess/repair/verify_solid.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

// The globe's faces at x < 0.
TriangleMesh half_globe(int bands) {
    TriangleMesh globe = test::make_globe(1, bands), half = globe;
    half.triangles.clear();
    for (std::size_t t = 0; t < globe.triangles.size(); ++t)
        if (globe.corner(t, 0).x() + globe.corner(t, 1).x() + globe.corner(t, 2).x() <= 0.0)
            half.triangles.push_back(globe.triangles[t]);
    half.region.assign(half.triangles.size(), 0);
    return half;
}

}  // namespace

TEST_CASE("rows along three axes give the volume of a box and see an opening",
          "[measure][analytic]") {
    TriangleMesh box = test::make_box_mesh(Vec3(4, 2, 1));
    for (const RowVolume& axis : measure_rows(box, 50)) {
        CHECK(axis.by_sign == Near(8).epsilon(1e-12));  // prism along each axis: no sampling error
        CHECK(axis.by_winding == Near(axis.by_sign).epsilon(1e-12));
        CHECK(axis.by_parity == Near(axis.by_sign).epsilon(1e-12));
        CHECK(axis.open_rows == 0);
    }
    box.triangles.pop_back();
    std::int64_t open_rows = 0;
    for (const RowVolume& axis : measure_rows(box, 50)) open_rows += axis.open_rows;
    CHECK(open_rows > 0);
}

TEST_CASE("rows of a globe agree with its exact volume", "[measure]") {
    const TriangleMesh globe = test::make_globe(1, 40);
    const double volume = measure_mass(globe).volume;
    for (const RowVolume& axis : measure_rows(globe, 100))
        CHECK(axis.by_sign == Near(volume).epsilon(0.002));
}

TEST_CASE("a proof fails on an opening, on the wrong side out and on volume counted twice",
          "[repair][verify]") {
    const TriangleMesh box = test::make_box_mesh(Vec3(4, 2, 1));
    CHECK(verify_solid(box).good);
    CHECK(verify_solid(box).volume == Near(8).epsilon(1e-14));
    TriangleMesh open = box;
    open.triangles.pop_back();
    CHECK_THAT(verify_solid(open).fault, Catch::Contains("3 edges"));
    TriangleMesh turned = box;
    for (auto& t : turned.triangles) std::swap(t[1], t[2]);
    CHECK_FALSE(verify_solid(turned).good);
    TriangleMesh twice = box;
    for (const Vec3& v : box.vertices) twice.vertices.push_back(v + Vec3(3.5, 0, 0));
    for (const auto& t : box.triangles) twice.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
    CHECK_THAT(verify_solid(twice).fault, Catch::Contains("counted twice"));
    CHECK(verify_solid(twice).overlap == Near(2.0 / 16).epsilon(0.05));  // parity: 0 for 2
}

TEST_CASE("two surfaces are compared by their winding numbers", "[repair][verify]") {
    const WindingComparison same =
        compare_windings(test::make_globe(1, 20), test::make_globe(1, 20));
    CHECK(same.differs == 0.0);
    CHECK(same.second_volume == Near(4.0 / 3.0 * 3.14159265).epsilon(0.02));
    const WindingComparison half = compare_windings(half_globe(20), test::make_globe(1, 20));
    CHECK(half.differs == Near(0.5).margin(0.02));
}
