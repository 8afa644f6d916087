// SPDX-License-Identifier: GPL-3.0-or-later
// Tolerances: 1e-12 is rounding of a rotation of lengths of a metre.
#include "postprocess/views/faces.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "postprocess/views/depth_map.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::views;
using ice::test::make_box;
using ice::test::Near;
using ice::test::tolerance;

TEST_CASE("the 12 triangles of a box become 6 faces with 4 corners and outward normals",
          "[views][analytic]") {
    const auto faces = make_faces(make_box({2.0, 1.0, 0.5}));
    REQUIRE(faces.size() == 6);
    for (const Face& face : faces) {
        CHECK(face.corners.size() == 4);
        CHECK(face.normal.norm() == Near(1.0));
        CHECK(face.normal.dot(face.center()) > 0.2);
    }
}

TEST_CASE("a cylinder of 360 sides keeps its sides: flatness is not passed on",
          "[views][analytic]") {
    TriangleMesh mesh;
    const int sides = 360;
    for (int k = 0; k < sides; ++k) {
        const double a = 2.0 * std::numbers::pi * k / sides;
        mesh.vertices.emplace_back(std::cos(a), std::sin(a), 0.0);
        mesh.vertices.emplace_back(std::cos(a), std::sin(a), 1.0);
    }
    for (std::int32_t k = 0; k < sides; ++k) {
        const std::int32_t a = 2 * k, b = (2 * k + 2) % (2 * sides);
        mesh.triangles.push_back({a, b, b + 1});
        mesh.triangles.push_back({a, b + 1, a + 1});
    }
    mesh.region.assign(mesh.triangles.size(), 0);
    CHECK(make_faces(mesh).size() == 360);
}

TEST_CASE("a box cut at the waterline has 5 faces below and 5 above, and a section",
          "[views][analytic]") {
    const CutMesh cut = cut_mesh(make_box({4.0, 2.0, 1.0}, {0.0, 0.0, 0.1}), 0.0);
    CHECK(make_faces(cut.below).size() == 5);
    CHECK(make_faces(cut.above).size() == 5);
    double length = 0.0;
    for (const auto& [a, b] : cut.section) {
        CHECK(std::abs(a.z()) < tolerance(1e-12));
        length += (b - a).norm();
    }
    CHECK(length == Near(12.0));
    CHECK(cut_mesh(make_box({1, 1, 1}), 2.0).above.triangles.empty());
    CHECK(cut_mesh(make_box({1, 1, 1}), 0.5).above.triangles.empty());
}

TEST_CASE("a fine mesh is thinned to the wanted number of triangles, a coarse one kept",
          "[views]") {
    TriangleMesh fine;
    const int n = 100;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) fine.vertices.emplace_back(0.1 * i, 0.1 * j, 0.0);
    for (std::int32_t j = 0; j < n; ++j)
        for (std::int32_t i = 0; i < n; ++i) {
            const std::int32_t a = j * (n + 1) + i;
            fine.triangles.push_back({a, a + 1, a + n + 2});
            fine.triangles.push_back({a, a + n + 2, a + n + 1});
        }
    fine.region.assign(fine.triangles.size(), 0);
    const TriangleMesh thin = simplify_mesh(fine, 3000);
    CHECK(thin.triangles.size() <= 3000);
    CHECK(thin.triangles.size() > 1000);
    CHECK(simplify_mesh(make_box({1, 1, 1}), 3000).triangles.size() == 12);
}

TEST_CASE("the depth map gives the bottom of a box seen from below, and nothing beside it",
          "[views][analytic]") {
    const Projection below = projection_of(ViewFrom::below);
    const DepthMap map(make_box({4.0, 2.0, 1.0}), below, 200);
    CHECK(map.nearness(0.3, 0.2) == Near(0.5));
    CHECK(map.nearness(2.5, 0.0) < -1e300);
    CHECK(DepthMap(TriangleMesh{}, below, 200).nearness(0.0, 0.0) < -1e300);
}

TEST_CASE("right x up points to the viewer in all five views", "[views]") {
    const auto from = GENERATE(ViewFrom::below, ViewFrom::top, ViewFrom::side, ViewFrom::front,
                               ViewFrom::quarter);
    const Projection p = projection_of(from);
    CHECK((p.right.cross(p.up) - p.toward).norm() < tolerance(1e-12));
    CHECK(p.right.norm() == Near(1.0));
}
