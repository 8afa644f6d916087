// SPDX-License-Identifier: GPL-3.0-or-later
// Half hulls and mirror symmetry.
//
// Tolerances: 1e-14 to 1e-10 are rounding of sums over triangles, of first and third moments.
#include "preprocess/load/half_hull.hpp"

#include <catch2/catch.hpp>
#include <map>

#include "common/geometry/mass_properties.hpp"
#include "preprocess/clean/orient_faces.hpp"
#include "preprocess/clean/weld.hpp"
#include "preprocess/load/symmetry.hpp"
#include "preprocess/repair/check_solid.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

TriangleMesh moved(TriangleMesh mesh, const Vec3& by) {
    for (Vec3& v : mesh.vertices) v += by;
    return mesh;
}

// The triangles at y >= 0 of a mesh none of whose triangles crosses that plane. A Wigley hull's
// deck does: it is cut at its centre line.
TriangleMesh port_half(const TriangleMesh& whole) {
    TriangleMesh half;
    half.vertices = whole.vertices;
    for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
        double low = 0.0;
        for (int k = 0; k < 3; ++k) low = std::min(low, whole.corner(t, k).y());
        if (low < 0.0) continue;
        half.triangles.push_back(whole.triangles[t]);
        half.region.push_back(0);
    }
    return half;
}

// The port half of a Wigley hull with its deck; open in y = 0. Volume (2/9) L B T of a Wigley
// hull of stations and levels without number, half of (4/9) L B T.
TriangleMesh half_wigley(int stations, int levels) {
    TriangleMesh half = port_half(test::make_wigley(10, 2, 1, stations, levels));
    // the deck runs from the sheer to the centre line at z = 0
    std::vector<std::int32_t> sheer, centre;
    for (int i = 0; i <= stations; ++i) {
        const double x = 10.0 * (static_cast<double>(i) / stations - 0.5);
        const double y = std::max(0.0, 1.0 - 4.0 * x * x / 100.0);
        sheer.push_back(static_cast<std::int32_t>(half.vertices.size()));
        half.vertices.emplace_back(x, i == 0 || i == stations ? 0.0 : y, 0.0);
        centre.push_back(static_cast<std::int32_t>(half.vertices.size()));
        half.vertices.emplace_back(x, 0.0, 0.0);
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(stations); ++i) {
        half.triangles.push_back({sheer[i], centre[i], centre[i + 1]});
        half.triangles.push_back({sheer[i], centre[i + 1], sheer[i + 1]});
    }
    half.region.assign(half.triangles.size(), 0);
    weld(half);
    return half;
}

// Closes the half in y = 0 by a fan about the box's centre, boundary edges turned round.
TriangleMesh close_in_plane(TriangleMesh half) {
    std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
    for (const auto& t : half.triangles)
        for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    const auto centre = static_cast<std::int32_t>(half.vertices.size());
    half.vertices.emplace_back(0, 0, -0.5);
    for (const auto& [edge, count] : edges)
        if (!edges.contains({edge.second, edge.first})) {
            half.triangles.push_back({edge.second, edge.first, centre});
            half.region.push_back(0);
        }
    return half;
}

}  // namespace

TEST_CASE("odd surface moments vanish for mirrored shapes and not for others",
          "[load][symmetry][analytic]") {
    const TriangleMesh box = moved(test::make_box_mesh(Vec3(3, 2, 1)), Vec3(7, -4, 2));
    for (int axis = 0; axis < 3; ++axis) CHECK(asymmetry(box, axis) < tolerance(1e-12));
    const TriangleMesh wigley = test::make_wigley(10, 2, 1, 24, 8);
    CHECK(asymmetry(wigley, 1) < tolerance(1e-12));
    CHECK(asymmetry(wigley, 2) > 0.05);

    // right triangle (0,0), (1,0), (0,1): area 1/2, mean x = 1/3; from the middle in half extents
    // that is 2 (1/3 - 1/2) = -1/3; the mean of n^3 = 8 (x - 1/2)^3 is -1/5, of n a^2 -1/15
    TriangleMesh flat;
    flat.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    flat.triangles = {{0, 1, 2}};
    flat.region = {0};
    CHECK(asymmetry(flat, 0) == Near(1.0 / 3.0).epsilon(1e-14));
    CHECK(asymmetry(TriangleMesh{}, 0) == 0.0);

    // unit squares across x: one at 1, two at -1/2, and one too small to weigh at -1. Their first
    // moment is zero, the mean of n^3 is (1 - 2/8) / 3 = 1/4
    TriangleMesh plates;
    for (const auto& [x, side] :
         {std::pair{1.0, 1.0}, std::pair{-0.5, 1.0}, std::pair{-0.5, 1.0}, std::pair{-1.0, 1e-6}}) {
        const auto n = static_cast<std::int32_t>(plates.vertices.size());
        const double h = 0.5 * side;
        for (const auto& [y, z] :
             {std::pair{-h, -h}, std::pair{h, -h}, std::pair{h, h}, std::pair{-h, h}})
            plates.vertices.emplace_back(x, y, z);
        plates.triangles.push_back({n, n + 1, n + 2});
        plates.triangles.push_back({n, n + 2, n + 3});
    }
    CHECK(asymmetry(plates, 0) == Near(0.25).epsilon(1e-10));
}

TEST_CASE("an open half hull is recognised on both sides, welded or not", "[load][half]") {
    TriangleMesh half = half_wigley(12, 4);
    const HalfHull seen = looks_like_half_hull(half);
    CHECK(seen.kind == HalfHull::Kind::open);
    CHECK(seen.port);
    // its profile: 12 stations of keel and of deck, 4 levels of stem and of stern
    CHECK(seen.open_edges == 12 + 12 + 4 + 4);
    CHECK(is_open_half(half));
    CHECK(seen.text() ==
          "this looks like half a hull (everything is on the port side of y = 0, "
          "32 open edges lie in that plane)");

    TriangleMesh soup;
    for (std::size_t t = 0; t < half.triangles.size(); ++t) {
        const auto n = static_cast<std::int32_t>(soup.vertices.size());
        for (int k = 0; k < 3; ++k) soup.vertices.push_back(half.corner(t, k));
        soup.triangles.push_back({n, n + 1, n + 2});
        soup.region.push_back(0);
    }
    CHECK(looks_like_half_hull(soup).open_edges == 32);

    for (Vec3& v : half.vertices) v.y() = -v.y();
    flip(half);
    CHECK(is_open_half(half));
    CHECK_FALSE(looks_like_half_hull(half).port);
}

TEST_CASE("half a hull plus its image is the whole hull", "[load][half][analytic]") {
    TriangleMesh whole = half_wigley(12, 4);
    CHECK(drop_centre_plane(whole) == 0);
    add_mirror_image(whole);
    weld(whole);
    CHECK(diagnose_solid(whole).good());
    CHECK_FALSE(looks_like_half_hull(whole));
    CHECK(measure_mass(whole).volume ==
          Near(measure_mass(test::make_wigley(10, 2, 1, 12, 4)).volume).epsilon(1e-12));
}

TEST_CASE("a half hull closed in its centre plane is recognised", "[load][half]") {
    const TriangleMesh half = half_wigley(12, 4);
    TriangleMesh closed = close_in_plane(half);
    REQUIRE(diagnose_solid(closed).good());
    const HalfHull seen = looks_like_half_hull(closed);
    CHECK(seen.kind == HalfHull::Kind::closed);
    CHECK(seen.centre_plane_triangles == 32);
    CHECK_FALSE(is_open_half(closed));
    CHECK(drop_centre_plane(closed) == 32);
    CHECK(closed.triangles == half.triangles);
}

TEST_CASE("whole solids beside the plane y = 0 are not half hulls", "[load][half]") {
    CHECK_FALSE(looks_like_half_hull(moved(test::make_box_mesh(Vec3(2, 1, 2)), Vec3(0, 0.5, 0))));
    CHECK_FALSE(looks_like_half_hull(test::make_wigley(10, 2, 1, 12, 4)));
    // a demihull clear of the plane; one that touches it in a line only
    CHECK_FALSE(looks_like_half_hull(moved(test::make_wigley(10, 2, 1, 12, 4), Vec3(0, 3, 0))));
    CHECK_FALSE(looks_like_half_hull(moved(test::make_wigley(10, 2, 1, 12, 4), Vec3(0, 1, 0))));
    CHECK_FALSE(looks_like_half_hull(TriangleMesh{}));
    // a floe with one side in y = 0 that is longer than the opposite one
    TriangleMesh floe = moved(test::make_box_mesh(Vec3(2, 1, 0.3)), Vec3(0, 0.5, 0));
    for (Vec3& v : floe.vertices)
        if (v.y() > 0.5) v.x() *= 0.6;
    CHECK(asymmetry(floe, 1) > kLopsided);
    CHECK_FALSE(looks_like_half_hull(floe));
    // a box with one triangle lost in y = 0 is a damaged box
    TriangleMesh damaged = moved(test::make_box_mesh(Vec3(2, 1, 2)), Vec3(0, 0.5, 0));
    for (std::size_t t = 0; t < damaged.triangles.size(); ++t)
        if (damaged.area_vector(t).y() < -0.5) {
            damaged.triangles.erase(damaged.triangles.begin() + static_cast<std::ptrdiff_t>(t));
            damaged.region.pop_back();
            break;
        }
    CHECK(looks_like_half_hull(damaged).open_edges == 3);
    CHECK_FALSE(is_open_half(damaged));
}
