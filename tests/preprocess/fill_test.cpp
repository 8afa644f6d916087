// SPDX-License-Identifier: GPL-3.0-or-later
// Sphere sets: counts, exact integrals, tangency, cover, symmetry, threads, refusals.
//
// Tolerances: 1e-13 to 1e-12 are rounding of sums over a box's triangles; 1e-9 that of an inertia
// at a distance; 1e-6 R is where the fill settles.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "common/base/parallel.hpp"
#include "preprocess/fill/fill_spheres.hpp"
#include "preprocess/fill/lattice.hpp"
#include "preprocess/fill/layer_tile.hpp"
#include "tests/preprocess/check_shares.hpp"
#include "tests/preprocess/fill_options.hpp"
#include "tests/preprocess/solid_oracle.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/sample_surface.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;
using test::check_shares;
using test::options;

TEST_CASE("the paper's floe is exactly 240 spheres, 0.24 m3, with its inertia to 1e-12",
          "[fill][analytic]") {
    SpheresReport report;
    const SphereSet set = fill_spheres(test::make_box_mesh(Vec3(1, 0.8, 0.3)),
                                       options(0.05, 0, Arrangement::lattice), report);
    CHECK(set.size() == 240);
    CHECK(report.surface_spheres == 240 - 8 * 6 * 1);
    CHECK(set.solid.volume == Near(0.24).epsilon(1e-12));
    const Vec3 d(1, 0.8, 0.3);
    for (int k = 0; k < 3; ++k) {
        const double expected = 0.24 / 12.0 * (d.squaredNorm() - d[k] * d[k]);
        CHECK(set.solid.inertia(k, k) == Near(expected).epsilon(1e-12));
    }
    for (const double v : set.volumes) REQUIRE(v == Near(0.001).epsilon(1e-12));
    // tangent to all six faces
    Eigen::AlignedBox3d box;
    for (const Vec3& c : set.centers) box.extend(c);
    CHECK((box.sizes() - (d - Vec3::Constant(0.1))).norm() < tolerance(1e-12));
    check_shares(set);
}

TEST_CASE("conforming layers touch from inside, no centre outside, by CGAL",
          "[fill][equivalence]") {
    const TriangleMesh mesh =
        GENERATE(test::make_box_mesh(Vec3(1, 0.8, 0.3)), test::make_globe(0.6, 24),
                 test::make_wigley(10, 2, 1, 40, 12));
    const double radius = 0.08;
    SpheresReport report;
    const SphereSet set = fill_spheres(mesh, options(radius), report);
    const auto answers = test::ask_oracle(mesh, set.centers);
    for (std::size_t k = 0; k < set.size(); ++k) {
        REQUIRE(answers[k].inside);
        // protrusion at most 1e-6 R; surface spheres touch as closely
        REQUIRE(answers[k].distance >= radius * (1 - tolerance(1e-6)));
        if (set.on_surface(k)) REQUIRE(answers[k].distance <= radius * (1 + tolerance(1e-6)));
    }
    CHECK(report.protrusion_max <= tolerance(1e-6) * radius);
    CHECK(report.surface_spheres > 100);
    check_shares(set);
}

TEST_CASE(
    "every place a sphere can touch has one within 0.65 of the spacing, with at most 8 % more "
    "spheres than an ideal hexagonal layer",
    "[fill][property]") {
    // the hull off its plane of symmetry too: the layer then is made in one piece
    TriangleMesh hull = test::make_wigley(10, 2, 1, 60, 16);
    if (GENERATE(false, true))
        for (Vec3& v : hull.vertices) v.y() += 0.037;
    const TriangleMesh mesh =
        GENERATE_REF(test::make_globe(1.0, 40), hull, test::make_box_mesh(Vec3(3, 2, 1)));
    SpheresReport report;
    const SphereSet set = fill_spheres(mesh, options(0.1), report);
    CHECK(report.covering_radius <= 0.65 * set.spacing);
    // each sphere of a hexagonal layer stands for sqrt(3) / 2 of the spacing squared
    const double ideal = set.solid.area / (std::sqrt(0.75) * set.spacing * set.spacing);
    CHECK(static_cast<double>(report.surface_spheres) <= 1.08 * ideal);
}

TEST_CASE("the covering radius is that of a dense search", "[fill][equivalence]") {
    const TriangleMesh mesh =
        GENERATE(test::make_wigley(6, 2, 1, 30, 8), test::make_box_mesh(Vec3(1, 0.8, 0.3)));
    SpheresReport report;
    const SphereSet set = fill_spheres(mesh, options(0.1), report);
    const SurfaceTree tree(mesh);
    double worst = 0.0;
    for (const SurfaceSample& sample : test::sample_surface(mesh, 0.04 * set.spacing)) {
        const Vec3 seat = sample.point - set.radius * sample.normal;
        if (!tree.is_clear(seat, set.radius * (1 - 1e-6))) continue;
        double nearest = 1e300;
        for (std::size_t k = 0; k < set.surface_count; ++k)
            nearest = std::min(nearest, (set.centers[k] - seat).squaredNorm());
        worst = std::max(worst, std::sqrt(nearest));
    }
    // the climb stops at steps of 0.01 spacings; the search sees every 0.04
    CHECK(report.covering_radius == Near(worst).margin(0.03 * set.spacing));
}

TEST_CASE("a symmetric hull gets mirror images port and starboard, bit for bit",
          "[fill][property]") {
    // 1.9 m broad: no multiple of the lattice pitch
    const auto arrangement = GENERATE(Arrangement::conforming, Arrangement::lattice);
    SpheresReport report;
    const SphereSet set =
        fill_spheres(test::make_wigley(10, 1.9, 1, 40, 12), options(0.1, 0, arrangement), report);
    std::map<std::array<double, 3>, std::size_t> all;
    for (std::size_t k = 0; k < set.size(); ++k)
        all[{set.centers[k].x(), set.centers[k].y(), set.centers[k].z()}] = k;
    for (std::size_t k = 0; k < set.size(); ++k) {
        const Vec3& c = set.centers[k];
        const auto image = all.find({c.x(), c.y() == 0 ? 0.0 : -c.y(), c.z()});
        REQUIRE(image != all.end());
        const std::size_t m = image->second;
        REQUIRE(set.on_surface(k) == set.on_surface(m));
        REQUIRE(set.area(k) == set.area(m));
        REQUIRE(set.volumes[k] == set.volumes[m]);
        REQUIRE(set.normal(k) == Vec3(set.normal(m).x(), -set.normal(m).y(), set.normal(m).z()));
    }
    check_shares(set);
}

TEST_CASE("a lattice that cannot fill a box from face to face is centred in it",
          "[fill][analytic]") {
    SpheresReport report;
    const SphereSet set = fill_spheres(test::make_box_mesh(Vec3(1.37, 0.93, 0.61)),
                                       options(0.05, 0, Arrangement::lattice), report);
    CHECK(set.size() == 13 * 9 * 6);
    Vec3 sum = Vec3::Zero();
    for (const Vec3& c : set.centers) sum += c;
    CHECK(sum.norm() < tolerance(1e-12) * static_cast<double>(set.size()));
    check_shares(set);
}

TEST_CASE("a lattice stands on the largest flat face", "[fill][analytic]") {
    // the deck of the curved hull, at z = 0
    SpheresReport report;
    const SphereSet set = fill_spheres(test::make_wigley(10, 2, 1, 40, 12),
                                       options(0.07, 0, Arrangement::lattice), report);
    double top = -1e300;
    for (const Vec3& c : set.centers) top = std::max(top, c.z());
    CHECK(top == Near(-0.07).epsilon(1e-9));
}

TEST_CASE("blocks of a lattice are decided as its single points are", "[fill][equivalence]") {
    const TriangleMesh globe = test::make_globe(1.0, 24);
    const SurfaceTree tree(globe);
    const double radius = 0.031;
    const Lattice lattice = fill_lattice(tree, radius, 2 * radius, 3, true);
    std::size_t expected = 0;
    const auto n = static_cast<int>(std::floor(1.0 / radius));
    for (int i = 0; i < n * n * n; ++i) {
        const Vec3 p =
            2 * radius * (Vec3(i % n, i / n % n, i / (n * n)) - Vec3::Constant(0.5 * (n - 1)));
        const Foot foot = tree.closest(p);
        expected += foot.inside && foot.distance >= 2 * radius;
    }
    CHECK(lattice.centers.size() == expected);
}

TEST_CASE("the set does not depend on the number of threads", "[fill][determinism]") {
    const TriangleMesh mesh = test::make_wigley(10, 2, 1, 40, 12);
    const auto fill_with = [&](int threads) {
        set_thread_count(threads);
        SpheresReport report;
        // so close that the layer is large enough to be shared among threads
        return fill_spheres(mesh, options(0.1, 0.03), report);
    };
    const SphereSet one = fill_with(1), three = fill_with(3);
    set_thread_count(2);
    CHECK(one.surface_count > 40000);
    CHECK(one.centers == three.centers);
    CHECK(one.areas == three.areas);
    CHECK(one.volumes == three.volumes);
    CHECK(one.normals == three.normals);
    CHECK(one.normal_spread == three.normal_spread);
    CHECK(one.regions == three.regions);
    CHECK(std::equal(one.creases.begin(), one.creases.end(), three.creases.begin(),
                     three.creases.end(), [](const CreaseNormal& l, const CreaseNormal& r) {
                         return l.sphere == r.sphere && l.normal == r.normal;
                     }));
}

TEST_CASE("moving a mesh by 1 km moves its spheres and keeps its inertia to 1e-9",
          "[fill][property]") {
    TriangleMesh mesh = test::make_box_mesh(Vec3(1, 0.8, 0.3));
    SpheresReport report;
    const SphereSet here = fill_spheres(mesh, options(0.05, 0, Arrangement::lattice), report);
    for (Vec3& v : mesh.vertices) v += Vec3(1000, -500, 200);
    const SphereSet there = fill_spheres(mesh, options(0.05, 0, Arrangement::lattice), report);
    CHECK(there.size() == here.size());
    CHECK((there.solid.inertia - here.solid.inertia).norm() <
          tolerance(1e-9) * here.solid.inertia.norm());
}

TEST_CASE("discs of a rectangle stand on its outline, corners included, at most the spacing apart",
          "[fill][2d]") {
    const TriangleMesh box = test::make_box_mesh(Vec3(1, 1, 0.4));
    SpheresReport report;
    const SphereSet set = fill_discs(slice_solid(box, 0.0), box.region_names,
                                     options(0.1, 0.05, Arrangement::conforming, true), report);
    CHECK(set.dimension == 2);
    CHECK(set.solid.volume == Near(0.4).epsilon(1e-13));
    CHECK(set.solid.inertia(1, 1) == Near(0.4 * 1.16 / 12).epsilon(1e-12));
    CHECK(set.solid.area == Near(2.8).epsilon(1e-13));
    // the offset outline is 0.8 x 0.2 m: 2 (16 + 4) discs
    CHECK(set.size() == 40);
    int corners = 0;
    for (const Vec3& c : set.centers) {
        REQUIRE(c.y() == 0.0);
        corners += std::abs(std::abs(c.x()) - 0.4) < 1e-9 && std::abs(std::abs(c.z()) - 0.1) < 1e-9;
    }
    CHECK(corners == 4);
    check_shares(set);
    const SphereSet lattice = fill_discs(slice_solid(box, 0.0), box.region_names,
                                         options(0.1, 0, Arrangement::lattice), report);
    CHECK(lattice.size() == 10);  // 5 x 2
}

TEST_CASE("discs of a hull's section have the guarantees of spheres, per metre of breadth",
          "[fill][2d][property]") {
    const TriangleMesh hull = test::make_wigley(10, 2, 1, 60, 16);
    const double offset = GENERATE(0.0, 0.6);
    const Section section = slice_solid(hull, offset);
    SpheresReport report;
    const SphereSet set = fill_discs(section, hull.region_names, options(0.05), report);
    double outline = 0.0;
    for (const auto& loop : section.loops)
        for (const SectionEdge& edge : loop) outline += (edge.b - edge.a).norm();
    CHECK(set.solid.area == Near(outline).epsilon(1e-12));
    check_shares(set);
    CHECK(report.protrusion_max <= tolerance(1e-6) * set.radius);
    CHECK(report.covering_radius <= 0.65 * set.spacing);
    CHECK(report.normal_error_mean_deg <= 1.0);
    // one disc a spacing, and one more for each of the outline's corners
    CHECK(static_cast<double>(set.surface_count) <= 1.08 * outline / set.spacing + 4.0);
    for (std::size_t k = 0; k < set.size(); ++k) {
        REQUIRE(set.centers[k].y() == 0.0);
        double nearest = 1e300;
        for (const auto& loop : section.loops)
            for (const SectionEdge& edge : loop) {
                const Vec3 along = edge.b - edge.a, from = set.centers[k] - edge.a;
                const double t = std::clamp(from.dot(along) / along.squaredNorm(), 0.0, 1.0);
                nearest = std::min(nearest, (from - t * along).norm());
            }
        REQUIRE(nearest >= set.radius * (1 - tolerance(1e-6)));
        if (set.on_surface(k)) REQUIRE(nearest <= set.radius * (1 + tolerance(1e-6)));
    }
}

TEST_CASE("a solid is convex when no vertex lies before a face", "[fill][analytic]") {
    const auto is_convex = [](const TriangleMesh& mesh) {
        return LayerSolid(SurfaceTree(mesh)).convex;
    };
    TriangleMesh box = test::make_box_mesh(Vec3(4, 2, 1));
    CHECK(is_convex(box));
    // one corner, where three faces meet, moved in: the diagonals of the upper face and the two
    // sides beside it fold inwards
    box.vertices[7] -= Vec3(1.5, 0.9, 0.4);
    CHECK_FALSE(is_convex(box));
    // a globe is, by its facets, but large meshes are not looked at
    CHECK(is_convex(test::make_globe(1, 4)));
    CHECK_FALSE(is_convex(test::make_globe(1, 60)));
}

TEST_CASE("an absurd number of spheres is refused with the unit as the likely cause",
          "[fill][errors]") {
    SpheresReport report;
    CHECK_THROWS_WITH(fill_spheres(test::make_box_mesh(Vec3(1000, 800, 300)), options(0.1), report),
                      Catch::Contains("spheres") && Catch::Contains("--units"));
}

TEST_CASE("a solid in which nothing fits names the largest radius that does", "[fill][errors]") {
    SpheresReport report;
    CHECK_THROWS_WITH(fill_spheres(test::make_box_mesh(Vec3(1, 1, 0.1)), options(0.06), report),
                      Catch::Contains("no sphere of radius 0.06") && Catch::Contains("0.05 m"));
}

TEST_CASE("a hull in millimetres is refused with its size and the option to give",
          "[fill][errors]") {
    SpheresReport report;
    CHECK_THROWS_WITH(
        fill_spheres(test::make_box_mesh(Vec3(12000, 3000, 1000)), options(0.15), report),
        Catch::Contains("12000 x 3000 x 1000 m") && Catch::Contains("--units mm"));
}
