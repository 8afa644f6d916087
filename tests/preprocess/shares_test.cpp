// SPDX-License-Identifier: GPL-3.0-or-later
// What a sphere stands for: its normals, its part of the surface, and what stays without any.
//
// Tolerances: 1e-6 is a normal stored as a float; 1e-12 is rounding of a sum of areas; 1e-9 of a
// part's size that of a cut.
#include <catch2/catch.hpp>
#include <map>

#include "preprocess/fill/fill_spheres.hpp"
#include "preprocess/fill/narrowest_cone.hpp"
#include "preprocess/fill/point_cells.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/sample_surface.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

TEST_CASE("normals of a box: faces square to them, edges at 45 degrees, corners at 54.7",
          "[fill][analytic]") {
    SpheresReport report;
    const SphereSet set =
        fill_spheres(test::make_box_mesh(Vec3(1, 0.8, 0.3)),
                     {0.05, 0.0, GENERATE(Arrangement::lattice, Arrangement::conforming)}, report);
    int corners = 0;
    for (std::size_t k = 0; k < set.surface_count; ++k) {
        // faces that the sphere touches
        const Vec3 gap = Vec3(0.5, 0.4, 0.15) - set.centers[k].cwiseAbs();
        Vec3 sum = Vec3::Zero();
        int faces = 0;
        for (int d = 0; d < 3; ++d)
            if (std::abs(gap[d] - 0.05) < 1e-7) {
                sum[d] = set.centers[k][d] > 0 ? 1.0 : -1.0;
                ++faces;
            }
        REQUIRE(faces >= 1);
        REQUIRE((set.normals[k] - sum.normalized()).norm() < tolerance(1e-6));
        REQUIRE(set.normal_spread[k] == Near(std::acos(1.0 / std::sqrt(faces))).margin(1e-6));
        corners += faces == 3;
    }
    CHECK(corners == 8);
}

TEST_CASE("stored normals are within a degree of a smooth surface, in the mean",
          "[fill][analytic]") {
    // a place is 0.35 spacings from its sphere in the mean (a disc of the sphere's share): on a
    // globe that alone turns the normal by 0.35 s / R
    SpheresReport report;
    const double radius = 3.0;
    const TriangleMesh globe = test::make_globe(radius, 120);
    const SphereSet set = fill_spheres(globe, {0.1}, report);
    CHECK(report.normal_error_mean_deg == Near(0.36 * 0.1 / radius * 180 / M_PI).epsilon(0.15));
    for (std::size_t k = 0; k < set.surface_count; ++k)
        // facets of the globe stand off its normal by half their turn, 1.5 degrees
        REQUIRE(set.normals[k].dot(set.centers[k].normalized()) > std::cos(0.03));
}

TEST_CASE("edges and corners say which normals meet there", "[fill][analytic]") {
    const TriangleMesh box = test::make_box_mesh(Vec3(1, 0.8, 0.3));
    SpheresReport report;
    const SphereSet set = fill_spheres(box, {0.05}, report);
    std::map<std::int32_t, std::vector<Vec3>> met;
    for (const CreaseNormal& crease : set.creases) met[crease.sphere].push_back(crease.normal);
    int corners = 0;
    for (std::size_t k = 0; k < set.surface_count; ++k) {
        std::size_t faces = 0;
        for (int d = 0; d < 3; ++d) {
            const double gap = 0.5 * (d == 0   ? 1.0
                                      : d == 1 ? 0.8
                                               : 0.3) -
                               std::abs(set.centers[k][d]);
            faces += gap < 0.05 + 1e-7;
        }
        const auto& normals = met[static_cast<std::int32_t>(k)];
        REQUIRE(normals.size() == (faces > 1 ? faces : 0));
        for (const Vec3& n : normals) REQUIRE(n.cwiseAbs().maxCoeff() == Near(1.0));
        corners += faces == 3;
    }
    CHECK(corners == 8);
}

TEST_CASE("faces take no area of one another round an edge", "[fill][analytic]") {
    // a plate 0.21 m thick: either face is one hexagonal layer, 1 cm from the other's centres
    const TriangleMesh plate = test::make_box_mesh(Vec3(3, 2, 0.21));
    SpheresReport report;
    const SphereSet set = fill_spheres(plate, {0.1}, report);
    double top = 0.0, bottom = 0.0;
    for (std::size_t k = 0; k < set.surface_count; ++k) {
        if (set.normal_spread[k] > 0.1) continue;
        if (set.normals[k].z() > 0.9) top += set.areas[k];
        if (set.normals[k].z() < -0.9) bottom += set.areas[k];
    }
    // without the rims, which the edge spheres have: a sphere's share reaches 0.05 m beyond it
    CHECK(top == Near(2.7 * 1.7).epsilon(0.1));
    CHECK(bottom == Near(top).epsilon(0.05));
}

TEST_CASE("shares that cannot meet the centroid say so", "[fill][degenerate]") {
    // a roof over a flat floor takes one row of spheres: no shares reach up to its centroid
    Section section;
    const double x[3] = {-0.3, 0.3, 0}, z[3] = {0, 0, 0.2};
    section.loops.emplace_back();
    for (int k = 0; k < 3; ++k) {
        const Vec3 a(x[k], 0, z[k]), b(x[(k + 1) % 3], 0, z[(k + 1) % 3]);
        const Vec3 d = (b - a).normalized();
        section.loops[0].push_back({a, b, Vec3(d.z(), 0, -d.x()), 0});
    }
    SpheresReport report;
    fill_spheres(extrude(section, {"hull"}), {0.06, 0.0, Arrangement::lattice}, report);
    REQUIRE(report.warnings.size() == 1);
    // the centroid is at a third of 0.2 m, the row at 0.06 m
    CHECK_THAT(report.warnings[0], Catch::Contains("centroid by 0.00667 m"));
}

TEST_CASE("widely spaced spheres make no feature thin", "[fill][property]") {
    SpheresReport report;
    fill_spheres(test::make_box_mesh(Vec3(6, 5, 4)), {0.1, 1.0}, report);
    CHECK(report.gap_max > 2.5 * 0.1);  // between the spheres, not for want of room
    CHECK(report.thin_features.empty());
}

TEST_CASE("a fin too thin for a sphere is listed with its place and size", "[fill]") {
    // a 2 m box with a 1 m fin of 2 cm under it, as one closed mesh: a prism over a T section
    Section section;
    const double x[8] = {-1, -0.01, -0.01, 0.01, 0.01, 1, 1, -1};
    const double z[8] = {0, 0, -1, -1, 0, 0, 1, 1};
    section.loops.emplace_back();
    for (int k = 0; k < 8; ++k) {
        const Vec3 a(x[k], 0, z[k]), b(x[(k + 1) % 8], 0, z[(k + 1) % 8]);
        const Vec3 d = (b - a).normalized();
        section.loops[0].push_back({a, b, Vec3(d.z(), 0, -d.x()), 0});
    }
    SpheresReport report;
    fill_spheres(extrude(section, {"hull"}), {0.1}, report);
    REQUIRE(report.thin_features.size() == 1);
    CHECK(report.thin_features[0].at[2] == Near(-0.6).margin(0.2));
    CHECK(report.thin_features[0].size == Near(1.25).margin(0.3));
}

TEST_CASE("the narrowest cone holds all directions and no narrower one does", "[fill][analytic]") {
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    CHECK(narrowest_cone(std::array{x}).half_angle == 0.0);
    CHECK(narrowest_cone(std::array{x, y}).half_angle == Near(M_PI / 4));
    CHECK(narrowest_cone(std::array{x, y, z}).half_angle == Near(std::acos(std::sqrt(1.0 / 3))));
    // a direction between the others changes nothing
    const Vec3 between = (x + y).normalized();
    const Cone cone = narrowest_cone(std::array{x, between, y});
    CHECK(cone.half_angle == Near(M_PI / 4));
    CHECK((cone.axis - between).norm() < tolerance(1e-12));
    CHECK(narrowest_cone(std::array{x, Vec3(-x)}).half_angle == Near(M_PI));
}

TEST_CASE("the nearest point is the one a search of all finds, the first of equals",
          "[fill][equivalence]") {
    std::vector<Vec3> points;
    for (int k = 0; k < 700; ++k)  // a coarse grid visited in a scattered order, with repeats
        points.emplace_back(k * 37 % 9, k * 53 % 7, k * 71 % 5);
    const PointCells tree(points, GENERATE(0.7, 3.0));  // hashed; numbered
    for (int k = 0; k < 2000; ++k) {
        const Vec3 p(0.5 * (k * 31 % 23) - 1, 0.5 * (k * 17 % 19) - 1, 0.5 * (k * 13 % 17) - 1);
        std::size_t best = 0;
        for (std::size_t i = 1; i < points.size(); ++i)
            if ((points[i] - p).squaredNorm() < (points[best] - p).squaredNorm()) best = i;
        const auto found = tree.nearest(p);
        REQUIRE(found.index == static_cast<std::int32_t>(best));
        REQUIRE(found.distance == (points[best] - p).norm());
        const auto k0 = static_cast<std::int32_t>(k % 700);
        const double known = (points[static_cast<std::size_t>(k0)] - p).norm();
        REQUIRE(tree.nearest(p, {k0, known}).index == found.index);
    }
}

TEST_CASE("surface samples sum to the area, stand in the triangles' middles and are small",
          "[fill][analytic]") {
    TriangleMesh mesh;
    mesh.vertices = {Vec3(0, 0, 0), Vec3(5, 0, 0), Vec3(4, 0.3, 0), Vec3(0, 0, 2)};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
    mesh.region = {0, 0};
    double area = 0.0;
    Vec3 first = Vec3::Zero();
    const auto samples = test::sample_surface(mesh, 0.1);
    for (const SurfaceSample& s : samples) {
        area += s.area;
        first += s.area * s.point;
        REQUIRE(s.area <= 0.1 * 0.1 * (1 + tolerance(1e-9)));
    }
    CHECK(area == Near(0.75 + 5.0).epsilon(1e-12));
    // 0.75 (3, 0.1, 0) + 5 (5/3, 0, 2/3): centroids of the two
    CHECK((first - Vec3(2.25 + 25.0 / 3, 0.075, 10.0 / 3)).norm() < tolerance(1e-12));
    // the slender triangle gets pieces by its area, not by its length squared
    CHECK(static_cast<double>(samples.size()) < 1.6 * 5.75 / 0.01);
}
