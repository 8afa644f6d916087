// SPDX-License-Identifier: GPL-3.0-or-later
// Distances of many points from a triangle: known answers, bits on every instruction set.
//
// Tolerances: 1e-12 is rounding of a square of a distance.
#include "preprocess/fill/triangle_distances.hpp"

#include <hwy/targets.h>

#include <bit>
#include <catch2/catch.hpp>
#include <random>

#include "common/geometry/closest_on_triangle.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

TriangleSides sides_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    TriangleSides out{{a, b, c}, {b - a, c - b, a - c}, {}, {}, {}, 0.0};
    out.normal = out.edge[0].cross(out.edge[1]);
    out.per_area_sq = 1.0 / out.normal.squaredNorm();
    for (std::size_t k = 0; k < 3; ++k) {
        out.inward[k] = out.normal.cross(out.edge[k]);
        out.per_edge_sq[k] = 1.0 / out.edge[k].squaredNorm();
    }
    return out;
}

PointBatch random_points(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-2.0, 3.0);
    PointBatch out;
    out.x.fill(0.0);
    out.y = out.z = out.x;
    out.count = count;
    for (std::size_t k = 0; k < count; ++k) {
        out.x[k] = place(random);
        out.y[k] = place(random);
        out.z[k] = place(random);
    }
    return out;
}

}  // namespace

TEST_CASE("points over a face, beyond an edge and beyond a corner", "[lattice][analytic]") {
    const TriangleSides triangle = sides_of(Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0));
    PointBatch points = random_points(3, 1);
    const Vec3 at[3] = {{1, 1, -2}, {2, -3, 4}, {-1, -2, 2}};
    for (std::size_t k = 0; k < 3; ++k) {
        points.x[k] = at[k].x();
        points.y[k] = at[k].y();
        points.z[k] = at[k].z();
    }
    std::array<double, PointBatch::kMost> square;
    measure_distances(triangle, points, square.data());
    CHECK(square[0] == 4.0);
    CHECK(square[1] == 25.0);
    CHECK(square[2] == 9.0);
}

TEST_CASE("every instruction set gives the bits of the reference, and the nearest point's distance",
          "[lattice][simd]") {
    const std::size_t count = GENERATE(0u, 1u, 2u, 3u, 4u, 5u, 7u, 8u, 9u, 31u, 32u);
    const PointBatch points = random_points(count, static_cast<unsigned>(count));
    const Vec3 a(0.1, 0.2, -0.3), b(1.7, 0.4, 0.5), c(0.3, 1.9, 0.2);
    const TriangleSides triangle = sides_of(a, b, c);
    std::array<double, PointBatch::kMost> expected{}, actual{};
    reference::measure_distances(triangle, points, expected.data());
    for (std::size_t k = 0; k < count; ++k) {
        const Vec3 p(points.x[k], points.y[k], points.z[k]);
        REQUIRE(expected[k] ==
                Near((p - closest_on_triangle(p, a, b, c).point).squaredNorm()).epsilon(1e-12));
    }
    for (const auto target : hwy::SupportedAndGeneratedTargets()) {
        CAPTURE(hwy::TargetName(target), count);
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        measure_distances(triangle, points, actual.data());
        for (std::size_t k = 0; k < count; ++k)
            REQUIRE(std::bit_cast<std::uint64_t>(actual[k]) ==
                    std::bit_cast<std::uint64_t>(expected[k]));
    }
    hwy::SetSupportedTargetsForTest(0);  // back to the best of this machine
    hwy::GetChosenTarget().DeInit();
}
