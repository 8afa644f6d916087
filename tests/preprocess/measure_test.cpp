// SPDX-License-Identifier: GPL-3.0-or-later
// Distances and inside tests against CGAL.
//
// Tolerances: 1e-12 m is rounding of lengths of a metre.
#include <catch2/catch.hpp>
#include <random>

#include "common/geometry/surface_tree.hpp"
#include "tests/preprocess/solid_oracle.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

TEST_CASE("distances to a unit box", "[measure][analytic]") {
    const TriangleMesh box = test::make_box_mesh(Vec3(1, 1, 1));
    const SurfaceTree tree(box);
    CHECK(tree.closest(Vec3(0.2, 0, 0)).distance == Near(0.3));
    CHECK(tree.closest(Vec3(0.2, 0, 0)).inside);
    CHECK(tree.closest(Vec3(1.5, 1.5, 0)).distance == Near(std::sqrt(2.0)));
    CHECK_FALSE(tree.closest(Vec3(1.5, 1.5, 1.5)).inside);
    CHECK_FALSE(tree.closest(Vec3(0.5, 0, 0)).inside);  // on the surface
    std::vector<Foot> feet;
    tree.within(Vec3(0.4, 0.4, 0), 0.2, feet);
    REQUIRE(feet.size() == 2);  // one triangle of each of the two near faces
    for (const Foot& foot : feet) CHECK(foot.distance == Near(0.1));
    CHECK(tree.is_clear(Vec3(0.2, 0, 0), 0.3 - 1e-12));
    CHECK_FALSE(tree.is_clear(Vec3(0.2, 0, 0), 0.3 + 1e-12));
}

TEST_CASE("inside and distance equal CGAL's on 3000 points of each solid",
          "[measure][equivalence]") {
    const TriangleMesh mesh =
        GENERATE(test::make_globe(1.0, 12), test::make_wigley(10, 2, 1, 20, 8),
                 test::make_box_mesh(Vec3(3, 1, 0.2)));
    const SurfaceTree tree(mesh);
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-0.1, 1.1);
    std::vector<Vec3> points;
    for (int k = 0; k < 3000; ++k)
        points.push_back(box.min() +
                         box.sizes().cwiseProduct(Vec3(unit(random), unit(random), unit(random))));
    const auto expected = test::ask_oracle(mesh, points);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Foot foot = tree.closest(points[k]);
        REQUIRE(foot.inside == expected[k].inside);
        REQUIRE(foot.distance == Near(expected[k].distance).margin(1e-12));
    }
}
