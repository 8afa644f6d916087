// SPDX-License-Identifier: GPL-3.0-or-later
// Sections.
//
// Tolerances: 1e-14 to 1e-12 are rounding of sums over the section's edges.
#include <catch2/catch.hpp>

#include "preprocess/clean/weld.hpp"
#include "preprocess/repair/check_solid.hpp"
#include "preprocess/slice/slice_solid.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

// Two meshes as one, the second turned inside out when it is a hole.
TriangleMesh join(TriangleMesh a, const TriangleMesh& b, bool hole) {
    const auto first = static_cast<std::int32_t>(a.vertices.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (const auto& t : b.triangles)
        a.triangles.push_back(hole ? std::array{t[0] + first, t[2] + first, t[1] + first}
                                   : std::array{t[0] + first, t[1] + first, t[2] + first});
    a.region.insert(a.region.end(), b.triangles.size(), 0);
    return a;
}

}  // namespace

TEST_CASE("the section of a box is its rectangle with four edges", "[slice][analytic]") {
    const Section s = slice_solid(test::make_box_mesh(Vec3(1, 0.8, 0.4)), 0.0);
    REQUIRE(s.loops.size() == 1);
    CHECK(s.loops[0].size() == 4);
    for (const SectionEdge& edge : s.loops[0]) {
        CHECK(edge.normal.dot(0.5 * (edge.a + edge.b)) > 0.0);  // outwards of a centred box
        CHECK(edge.normal.norm() == Near(1.0));
    }
}

TEST_CASE("a section as a prism has the section's area, centroid and polar moment per metre",
          "[slice][analytic]") {
    const TriangleMesh box = test::make_box_mesh(Vec3(1, 0.8, 0.4));
    TriangleMesh prism = extrude(slice_solid(box, 0.1), box.region_names);
    CHECK(diagnose_solid(prism).good());
    const MassProperties m = measure_mass(prism);
    CHECK(m.volume == Near(0.4).epsilon(1e-14));
    CHECK(m.centroid.norm() < tolerance(1e-14));
    CHECK(m.inertia(1, 1) == Near(0.4 * (1 + 0.16) / 12).epsilon(1e-13));
}

TEST_CASE("a hole and a second body keep their loops", "[slice]") {
    const TriangleMesh hollow =
        join(test::make_box_mesh(Vec3(2, 2, 2)), test::make_box_mesh(Vec3(1, 1, 1)), true);
    const Section s = slice_solid(hollow, 0.0);
    CHECK(s.loops.size() == 2);
    const TriangleMesh prism = extrude(s, hollow.region_names);
    CHECK(diagnose_solid(prism).good());
    CHECK(measure_mass(prism).volume == Near(3.0).epsilon(1e-13));

    TriangleMesh second = test::make_box_mesh(Vec3(1, 1, 1));
    for (Vec3& v : second.vertices) v.x() += 5.0;
    const Section two = slice_solid(join(test::make_box_mesh(Vec3(1, 1, 1)), second, false), 0.0);
    CHECK(two.loops.size() == 2);
    CHECK(measure_mass(extrude(two, {"hull"})).volume == Near(2.0).epsilon(1e-13));
}

TEST_CASE("a plane through vertices and along edges cuts all the same", "[slice][degenerate]") {
    // the hull has its keel, stem and stern exactly in y = 0
    const TriangleMesh hull = test::make_wigley(10, 2, 1, 20, 8);
    const Section s = slice_solid(hull, 0.0);
    REQUIRE(s.loops.size() == 1);
    CHECK(measure_mass(extrude(s, hull.region_names)).volume == Near(10.0).epsilon(1e-12));
}

TEST_CASE("a plane beside the solid is an error", "[slice][errors]") {
    CHECK_THROWS_WITH(slice_solid(test::make_box_mesh(Vec3(1, 1, 1)), 3.0),
                      Catch::Contains("does not cut"));
}
