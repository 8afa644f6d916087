// SPDX-License-Identifier: GPL-3.0-or-later
// Filling what is far away, tiny, huge or degenerate.
//
// Tolerances: 1e-12 and 1e-9 are rounding of a cosine and its inverse near 1; 1e-9 of a sum that of
// 40 terms, with a reserve.
#include <catch2/catch.hpp>
#include <numeric>

#include "preprocess/fill/fill_spheres.hpp"
#include "preprocess/fill/narrowest_cone.hpp"
#include "preprocess/fill/point_cells.hpp"
#include "tests/preprocess/check_shares.hpp"
#include "tests/preprocess/fill_options.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;
using test::check_shares;
using test::options;

TEST_CASE("the nearest of points far away or deep among them is found, the first of equals",
          "[fill][equivalence]") {
    std::vector<Vec3> points;
    for (int k = 0; k < 500; ++k) points.emplace_back(k * 37 % 9, k * 53 % 7, k * 71 % 5);
    const PointCells cells(points, GENERATE(0.7, 1.5, 3.0));  // hashed; numbered, twice
    for (const Vec3& p : {Vec3(1000, 3, 2), Vec3(-1e12, 0, 0), Vec3(4, 20, 2), Vec3(4, 3, -9),
                          Vec3(4.2, 3.3, 2.1)}) {
        std::size_t best = 0, within = 0;
        for (std::size_t i = 1; i < points.size(); ++i)
            if ((points[i] - p).squaredNorm() < (points[best] - p).squaredNorm()) best = i;
        const double range = (points[best] - p).norm() + 1.0;
        for (const Vec3& q : points) within += (q - p).norm() <= range ? 1 : 0;
        const auto found = cells.nearest(p);
        CHECK(found.index == static_cast<std::int32_t>(best));
        CHECK(cells.nearest(p, {499, (points[499] - p).norm()}).index == found.index);
        if (std::abs(p.x()) > 1e6) continue;
        std::size_t visited = 0;
        cells.visit(p, range, [&](std::int32_t, double) { ++visited; });
        CHECK(visited == within);
    }
}

TEST_CASE("the cone of hundreds of directions holds all and is hardly too wide",
          "[fill][analytic]") {
    std::vector<Vec3> directions{Vec3::UnitZ()};
    for (int k = 0; k < 600; ++k) {  // on the rim of a cone of 0.5 rad, and one inside it
        const double angle = 2.0 * M_PI * k / 600.0;
        for (const double tilt : {0.5, 0.2})
            directions.emplace_back(std::sin(tilt) * std::cos(angle),
                                    std::sin(tilt) * std::sin(angle), std::cos(tilt));
    }
    const Cone cone = narrowest_cone(directions);
    CHECK(cone.half_angle >= 0.5 - tolerance(1e-12));
    CHECK(cone.half_angle <= 0.5 * 1.01);
    for (const Vec3& d : directions)
        REQUIRE(std::acos(std::min(1.0, d.dot(cone.axis))) <= cone.half_angle + tolerance(1e-9));
}

TEST_CASE("a box a thousand kilometres from the origin is filled", "[fill][degenerate]") {
    TriangleMesh mesh = test::make_box_mesh(Vec3(1, 0.75, 0.5));
    for (Vec3& v : mesh.vertices) v += Vec3(1e6, -1e6, 1e6);
    SpheresReport report;
    const SphereSet set = fill_spheres(mesh, options(0.05), report);
    CHECK(set.surface_count > 1000);
    CHECK(report.protrusion_max < tolerance(1e-8));  // coordinates are known to 1e-10 m
}

TEST_CASE("a spacing that would take 1e8 discs is refused", "[fill][errors]") {
    Section section;
    const double x[4] = {0, 1, 1, 0}, z[4] = {0, 0, 1, 1};
    section.loops.emplace_back();
    for (int k = 0; k < 4; ++k) {
        const Vec3 a(x[k], 0, z[k]), b(x[(k + 1) % 4], 0, z[(k + 1) % 4]);
        const Vec3 d = b - a;
        section.loops[0].push_back({a, b, Vec3(d.z(), 0, -d.x()), 0});
    }
    SpheresReport report;
    const double spacing = GENERATE(1e-8, 1e-12, 1e-300);
    CHECK_THROWS_WITH(fill_discs(section, {"hull"}, options(0.1, spacing), report),
                      Catch::Contains("spheres"));
}

TEST_CASE("volume shares sum to the volume even where no spheres are near the centroid",
          "[fill][degenerate]") {
    // a 1 m bar with a plate of 5 cm that reaches 40 m aside: all spheres are in the bar
    Section section;
    const double x[6] = {0, 40, 40, 1, 1, 0}, z[6] = {0, 0, 0.05, 0.05, 1, 1};
    section.loops.emplace_back();
    for (int k = 0; k < 6; ++k) {
        const Vec3 a(x[k], 0, z[k]), b(x[(k + 1) % 6], 0, z[(k + 1) % 6]);
        const Vec3 d = (b - a).normalized();
        section.loops[0].push_back({a, b, Vec3(d.z(), 0, -d.x()), 0});
    }
    SpheresReport report;
    const SphereSet set = fill_spheres(extrude(section, {"hull"}), options(0.1), report);
    const double sum = std::accumulate(set.volumes.begin(), set.volumes.end(), 0.0);
    CHECK(sum == Near(1.0 + 39 * 0.05).epsilon(1e-9));
    for (const double v : set.volumes) REQUIRE(v > 0.0);
    REQUIRE(report.warnings.size() == 1);
    CHECK_THAT(report.warnings[0], Catch::Contains("miss the centroid"));
}
