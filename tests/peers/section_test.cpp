// SPDX-License-Identifier: GPL-3.0-or-later
// Tolerances: 1e-12 is rounding of a sum over corners; 1e-9 m is kSamePoint, within which corners
// are one.
#include "tests/peers/section.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "common/base/error.hpp"
#include "tests/support/make_sphere_sets.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::peers;
using ice::test::Near;
using ice::test::tolerance;

namespace {

double area_of(const Polygon& p) {
    double twice = 0.0;
    for (std::size_t k = 0; k < p.size(); ++k) {
        const Vec2 &a = p[k], &b = p[(k + 1) % p.size()];
        twice += a.x() * b.y() - b.x() * a.y();
    }
    return 0.5 * twice;
}

// The walls of the prism over a polygon; its caps do not reach the plane y = 0.
TriangleMesh walls(const Polygon& p) {
    TriangleMesh mesh;
    for (const Vec2& q : p)
        for (const double y : {-0.5, 0.5}) mesh.vertices.emplace_back(q.x(), y, q.y());
    const auto count = static_cast<std::int32_t>(p.size());
    for (std::int32_t k = 0; k < count; ++k) {
        const std::int32_t a = 2 * k, b = 2 * ((k + 1) % count);
        mesh.triangles.push_back({a, a + 1, b});
        mesh.triangles.push_back({b, a + 1, b + 1});
        mesh.region.insert(mesh.region.end(), 2, 0);
    }
    return mesh;
}

// An L of area 3 with one corner that is not convex, at (1, 1).
const Polygon kL{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

Polygon square(double x, double z) { return {{x, z}, {x + 1, z}, {x + 1, z + 1}, {x, z + 1}}; }

}  // namespace

TEST_CASE("the outline of a box of 1 x 0.4 m has four corners and its area", "[peers]") {
    const Polygon p = outline_of(test::make_box_mesh(Vec3(1.0, 1.0, 0.4)));
    REQUIRE(p.size() == 4);
    CHECK(area_of(p) == Near(0.4).epsilon(1e-12));  // positive: counter-clockwise
}

TEST_CASE("the outline of a prism is its polygon", "[peers]") {
    const Polygon p = outline_of(walls(kL));
    REQUIRE(p.size() == kL.size());
    for (const Vec2& corner : kL)
        CHECK(std::any_of(p.begin(), p.end(),
                          [&](const Vec2& q) { return (q - corner).norm() < tolerance(1e-9); }));
    CHECK(area_of(p) == Near(3.0).epsilon(1e-12));
}

TEST_CASE("an open section and one without triangles are refused", "[peers]") {
    TriangleMesh open = walls(kL);
    open.triangles.resize(open.triangles.size() - 2);
    CHECK_THROWS_AS(outline_of(open), Error);
    CHECK_THROWS_AS(outline_of(TriangleMesh{}), Error);
}

TEST_CASE("an L falls into two convex parts that keep its area and cut no edge", "[peers]") {
    const std::vector<Polygon> parts = convex_parts(kL);
    REQUIRE(parts.size() == 2);
    CHECK(area_of(parts[0]) + area_of(parts[1]) == Near(3.0).epsilon(1e-12));
    for (const Polygon& part : parts)
        for (const Vec2& corner : part) CHECK(std::find(kL.begin(), kL.end(), corner) != kL.end());
}

TEST_CASE("the inset of an L by 0.1 m has its edges 0.1 m further in", "[peers]") {
    const Polygon p = inset(kL, 0.1);
    const Polygon expected{{0.1, 0.1}, {1.9, 0.1}, {1.9, 0.9}, {0.9, 0.9}, {0.9, 1.9}, {0.1, 1.9}};
    REQUIRE(p.size() == expected.size());
    for (std::size_t k = 0; k < p.size(); ++k)
        CHECK((p[k] - expected[k]).norm() < tolerance(1e-12));
}

TEST_CASE("distance and depth of unit squares", "[peers]") {
    CHECK(distance(square(0, 0), square(1.5, 0)) == Near(0.5));
    CHECK(distance(square(0, 0), square(4.0, 5.0)) == Near(5.0));  // 3, 4, 5 from corner to corner
    CHECK(distance(square(0, 0), square(0.9, 0.2)) == 0.0);
    CHECK(distance(square(0, 0), kL) == 0.0);
    CHECK(overlap_depth(square(0, 0), square(0.9, 0.2)) == Near(0.1));
    CHECK(overlap_depth(square(0, 0), square(1.5, 0)) == 0.0);
    // reaches 0.1 into the notch's wall only, the notch itself is free
    CHECK(overlap_depth(kL, square(0.9, 1.2)) == Near(0.1));
}
