// SPDX-License-Identifier: GPL-3.0-or-later
// The largest sphere inside a solid, and fills whose radius is large beside the mesh's triangles.
//
// Tolerances: 1e-12 is rounding of a radius; 1e-6 R is where the fill settles; 10 % is a row of
// spheres more or less.
#include "preprocess/fill/inscribed.hpp"

#include <catch2/catch.hpp>

#include "preprocess/fill/fill_spheres.hpp"
#include "tests/preprocess/check_shares.hpp"
#include "tests/preprocess/look_alikes.hpp"
#include "tests/preprocess/solid_oracle.hpp"
#include "tests/support/make_hull.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

TEST_CASE("the largest sphere inside a box, a plate and a ball is known, and none is larger",
          "[fill][inscribed][analytic]") {
    const auto [mesh, radius] = GENERATE(table<TriangleMesh, double>(
        {{test::make_box_mesh(Vec3(1, 0.8, 0.3)), 0.15},
         {test::make_box_mesh(Vec3(100, 80, 0.3)), 0.15},  // its deepest points fill a plane
         {test::make_box_mesh(Vec3(5, 0.4, 0.4)), 0.2}}));
    const SurfaceTree tree(mesh);
    const Inscribed largest = find_inscribed(tree, 3);
    CHECK(largest.radius <= radius * (1 + tolerance(1e-12)));
    CHECK(largest.radius >= radius * (1 - tolerance(1e-3)));
    CHECK(largest.bound >= radius * (1 - tolerance(1e-12)));
    // a wanted radius is found, or known not to fit
    CHECK(find_inscribed(tree, 3, 0.9 * radius).radius >= 0.9 * radius);
    if (mesh.vertices[0].cwiseAbs().maxCoeff() < 50.0)
        CHECK(find_inscribed(tree, 3, 1.02 * radius).bound < 1.02 * radius);
}

TEST_CASE("a sphere only just fits where the hull is deepest, by CGAL", "[fill][inscribed]") {
    const TriangleMesh hull = test::make_hull({10, 2, 1.8}, 20000);
    const SurfaceTree tree(hull);
    const Inscribed largest = find_inscribed(tree, 3);
    const auto answer = test::ask_oracle(hull, {largest.center});
    CHECK(answer[0].inside);
    CHECK(answer[0].distance == Near(largest.radius).epsilon(1e-12));
    CHECK(largest.bound <= 1.01 * largest.radius * (1 + tolerance(1e-12)));
    SpheresReport report;
    CHECK(fill_spheres(hull, {0.99 * largest.radius}, report).surface_count > 0);
    CHECK_THROWS_WITH(
        fill_spheres(hull, {1.02 * largest.radius}, report),
        Catch::Contains("no sphere of radius") && Catch::Contains("the largest that fits has"));
}

TEST_CASE("a fine mesh has the layer of a coarse one where the radius is large", "[fill]") {
    // 400 triangles in a sphere's shadow; the numbers are those of 20 triangles a side
    const double radius = 0.3;
    SpheresReport coarse, fine;
    const SphereSet few = fill_spheres(test::make_globe(1.5, 24), {radius}, coarse);
    const SphereSet many = fill_spheres(test::make_globe(1.5, 240), {radius}, fine);
    CHECK(static_cast<double>(many.surface_count) ==
          Near(static_cast<double>(few.surface_count)).epsilon(0.1));
    CHECK(fine.covering_radius <= 0.65 * radius);
    CHECK(fine.protrusion_max <= tolerance(1e-6) * radius);
    test::check_shares(many);
}

TEST_CASE("progress is told from the first step to the last", "[fill]") {
    std::vector<std::string> told;
    FillOptions options{0.1};
    options.progress = [&](const std::string& step, double share) {
        CHECK(share >= 0.0);
        CHECK(share < 1.0);
        if (told.empty() || told.back() != step) told.push_back(step);
    };
    SpheresReport report;
    fill_spheres(test::make_box_mesh(Vec3(1, 0.8, 0.6)), options, report);
    CHECK(told == std::vector<std::string>{"surface layer", "certificate", "interior"});
}
