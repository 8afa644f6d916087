// SPDX-License-Identifier: GPL-3.0-or-later
// Outlines and the prisms made of them, against exact areas and volumes.
//
// Tolerances: 1e-15 and 1e-14 are rounding of a few products; 1e-12 m that of a difference of them,
// with a reserve.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "common/geometry/edge_table.hpp"
#include "common/geometry/mass_properties.hpp"
#include "preprocess/field/make_prism.hpp"
#include "preprocess/field/polygon_checks.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

const Outline kSquare{{1.0, 2.0}, {5.0, 2.0}, {5.0, 6.0}, {1.0, 6.0}};
// an L: a 4 m square without its upper right quarter
const Outline kCorner{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}};

Outline moved(Outline outline, const Vec2& by) {
    for (Vec2& p : outline) p += by;
    return outline;
}

bool is_closed(const TriangleMesh& mesh) {
    for (const MeshEdge& edge : edge_table(mesh))
        for (const std::int32_t t : edge.triangles)
            if (t < 0) return false;
    return true;
}

}  // namespace

TEST_CASE("area, centroid and size of a square and an L", "[field][analytic]") {
    CHECK(area_of(kSquare) == 16.0);
    CHECK(centroid_of(kSquare) == Vec2(3.0, 4.0));
    CHECK(size_of(kSquare) == Near(8.0 / std::sqrt(std::numbers::pi)).epsilon(1e-15));
    CHECK(area_of(kCorner) == 12.0);
    // three squares of 4 m2 about (1, 1), (3, 1) and (1, 3)
    CHECK((centroid_of(kCorner) - Vec2(5.0 / 3.0, 5.0 / 3.0)).norm() < tolerance(1e-15));
    CHECK(area_of({kSquare.rbegin(), kSquare.rend()}) == -16.0);
    CHECK(is_convex(kSquare));
    CHECK_FALSE(is_convex(kCorner));
}

TEST_CASE("an inset by d takes d from every side, and nothing is left of a narrow part",
          "[field][analytic]") {
    const Outline in = inset(kSquare, 0.5);
    REQUIRE(in.size() == 4);
    CHECK((in[0] - Vec2(1.5, 2.5)).norm() < tolerance(1e-15));
    CHECK((in[2] - Vec2(4.5, 5.5)).norm() < tolerance(1e-15));
    // perimeter 16, five right-angled corners to the left and one to the right: each 1 m2 of d^2
    CHECK(area_of(inset(kCorner, 0.25)) == Near(12.0 - 16.0 * 0.25 + 4.0 * 0.0625));
    CHECK(inset(kSquare, 2.1).empty());
}

TEST_CASE("straight corners go, turns stay", "[field]") {
    Outline more = kSquare;
    more.insert(more.begin() + 1, Vec2(3.0, 2.0));
    more.push_back(Vec2(1.0, 4.0));
    CHECK(without_straight_corners(more) == kSquare);
    CHECK(without_straight_corners(kCorner) == kCorner);
}

TEST_CASE("a prism is closed and has its exact volume, area and centroid", "[field][analytic]") {
    const double h = 0.6;
    for (const Outline& outline : {kSquare, kCorner}) {
        const TriangleMesh mesh = make_prism(outline, h, 0.0);
        CHECK(is_closed(mesh));
        const MassProperties mass = measure_mass(mesh);
        CHECK(mass.volume == Near(h * area_of(outline)).epsilon(1e-14));
        CHECK(mass.area == Near(2.0 * area_of(outline) + 16.0 * h).epsilon(1e-14));
        const Vec2 c = centroid_of(outline);
        CHECK((mass.centroid - Vec3(c.x(), c.y(), 0.0)).norm() < tolerance(1e-14));
    }
}

TEST_CASE("a chamfer takes frustums above and below", "[field][analytic]") {
    const double h = 0.6, c = 0.1;
    const TriangleMesh mesh = make_prism(kSquare, h, c);
    CHECK(is_closed(mesh));
    // a frustum between squares of 4 and 3.8 m, c high
    const double frustum = c / 3.0 * (16.0 + 3.8 * 3.8 + 4.0 * 3.8);
    const MassProperties mass = measure_mass(mesh);
    CHECK(mass.volume == Near(16.0 * (h - 2.0 * c) + 2.0 * frustum).epsilon(1e-14));
    CHECK((mass.centroid - Vec3(3.0, 4.0, 0.0)).norm() < tolerance(1e-14));
    CHECK(is_closed(make_prism(kCorner, h, c)));
    CHECK_THROWS_WITH(make_prism(moved({{0, 0}, {1, 0}, {1, 0.1}, {0, 0.1}}, {7, 8}), h, c),
                      Catch::Contains("ice.chamfer: 0.1 m leaves nothing of an edge"));
}

TEST_CASE("overlap of outlines: none when they touch, its depth when not", "[field][analytic]") {
    CHECK(overlap_depth(kSquare, moved(kSquare, {4.0, 0.0})) == Near(0.0).margin(1e-12));
    CHECK(overlap_depth(kSquare, moved(kSquare, {4.0, 4.0})) == Near(0.0).margin(1e-12));
    CHECK(overlap_depth(kSquare, moved(kSquare, {9.0, 0.0})) == 0.0);
    CHECK(overlap_depth(kSquare, moved(kSquare, {3.75, 0.0})) == Near(0.25));
    CHECK(overlap_depth(kSquare, kSquare) > 1.0);
    // a square in the L's open quarter touches, one that reaches over its inner corner does not
    const Outline in_corner{{2, 2}, {4, 2}, {4, 4}, {2, 4}};
    CHECK(overlap_depth(kCorner, in_corner) == Near(0.0).margin(1e-12));
    CHECK(overlap_depth(kCorner, moved(in_corner, {-0.1, -0.1})) > 0.05);
}

TEST_CASE("a bow tie is not simple", "[field]") {
    CHECK(is_simple(kSquare));
    CHECK(is_simple(kCorner));
    CHECK_FALSE(is_simple({{0, 0}, {2, 2}, {2, 0}, {0, 2}}));
}
