// SPDX-License-Identifier: GPL-3.0-or-later
// Sphere sets: counts, exact integrals, tangency, cover, shares, symmetry, threads.
#include <catch2/catch.hpp>
#include <map>
#include <numeric>

#include "common/base/parallel.hpp"
#include "preprocess/fill/fill_spheres.hpp"
#include "preprocess/fill/lattice.hpp"
#include "preprocess/fill/narrowest_cone.hpp"
#include "preprocess/fill/point_cells.hpp"
#include "preprocess/fill/surface_samples.hpp"
#include "tests/preprocess/solid_oracle.hpp"
#include "tests/support/make_meshes.hpp"

using namespace ice;

namespace {

FillOptions options(double radius, double spacing = 0.0,
                    Arrangement arrangement = Arrangement::conforming, bool surface_only = false) {
    return {radius, spacing, arrangement, surface_only};
}

void check_shares(const SphereSet& set) {
    const double volume = std::accumulate(set.volumes.begin(), set.volumes.end(), 0.0);
    const double area = std::accumulate(set.areas.begin(), set.areas.end(), 0.0);
    Vec3 first = Vec3::Zero();
    for (std::size_t k = 0; k < set.size(); ++k) {
        REQUIRE(set.volumes[k] > 0.0);
        REQUIRE(set.area(k) >= 0.0);
        first += set.volumes[k] * set.centers[k];
    }
    Vec3 centroid = set.solid.centroid;
    if (set.dimension == 2) centroid.y() = 0.0;
    CHECK(volume == Approx(set.solid.volume).epsilon(1e-12));
    CHECK(area == Approx(set.solid.area).epsilon(1e-9));
    const double size = std::cbrt(set.solid.volume);
    CHECK((first / volume - centroid).norm() < 1e-9 * (centroid.norm() + size));
}

}  // namespace

TEST_CASE("the paper's floe is exactly 240 spheres, 0.24 m3, with its inertia to 1e-12",
          "[fill][analytic]") {
    SpheresReport report;
    const SphereSet set = fill_spheres(test::make_box_mesh(Vec3(1, 0.8, 0.3)),
                                       options(0.05, 0, Arrangement::lattice), report);
    CHECK(set.size() == 240);
    CHECK(report.surface_spheres == 240 - 8 * 6 * 1);
    CHECK(set.solid.volume == Approx(0.24).epsilon(1e-12));
    const Vec3 d(1, 0.8, 0.3);
    for (int k = 0; k < 3; ++k) {
        const double expected = 0.24 / 12.0 * (d.squaredNorm() - d[k] * d[k]);
        CHECK(set.solid.inertia(k, k) == Approx(expected).epsilon(1e-12));
    }
    for (const double v : set.volumes) REQUIRE(v == Approx(0.001).epsilon(1e-12));
    // tangent to all six faces
    Eigen::AlignedBox3d box;
    for (const Vec3& c : set.centers) box.extend(c);
    CHECK((box.sizes() - (d - Vec3::Constant(0.1))).norm() < 1e-12);
    check_shares(set);
}

TEST_CASE("normals of a box: faces square to them, edges at 45 degrees, corners at 54.7",
          "[fill][analytic]") {
    SpheresReport report;
    const SphereSet set = fill_spheres(
        test::make_box_mesh(Vec3(1, 0.8, 0.3)),
        options(0.05, 0, GENERATE(Arrangement::lattice, Arrangement::conforming)), report);
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
        REQUIRE((set.normals[k] - sum.normalized()).norm() < 1e-6);
        REQUIRE(set.normal_spread[k] == Approx(std::acos(1.0 / std::sqrt(faces))).margin(1e-6));
        corners += faces == 3;
    }
    CHECK(corners == 8);
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
        REQUIRE(answers[k].distance >= radius * (1 - 1e-6));
        if (set.on_surface(k)) REQUIRE(answers[k].distance <= radius * (1 + 1e-6));
    }
    CHECK(report.protrusion_max <= 1e-6 * radius);
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
    for (const SurfaceSample& sample : sample_surface(mesh, 0.04 * set.spacing, 3)) {
        const Vec3 seat = sample.point - set.radius * sample.normal;
        if (!tree.is_clear(seat, set.radius * (1 - 1e-6))) continue;
        double nearest = 1e300;
        for (std::size_t k = 0; k < set.surface_count; ++k)
            nearest = std::min(nearest, (set.centers[k] - seat).squaredNorm());
        worst = std::max(worst, std::sqrt(nearest));
    }
    // the climb stops at steps of 0.01 spacings; the search sees every 0.04
    CHECK(report.covering_radius == Approx(worst).margin(0.03 * set.spacing));
}

TEST_CASE("stored normals are within a degree of a smooth surface, in the mean",
          "[fill][analytic]") {
    // a place is 0.35 spacings from its sphere in the mean (a disc of the sphere's share): on a
    // globe that alone turns the normal by 0.35 s / R
    SpheresReport report;
    const double radius = 3.0;
    const TriangleMesh globe = test::make_globe(radius, 120);
    const SphereSet set = fill_spheres(globe, options(0.1), report);
    CHECK(report.normal_error_mean_deg == Approx(0.36 * 0.1 / radius * 180 / M_PI).epsilon(0.15));
    for (std::size_t k = 0; k < set.surface_count; ++k)
        // facets of the globe stand off its normal by half their turn, 1.5 degrees
        REQUIRE(set.normals[k].dot(set.centers[k].normalized()) > std::cos(0.03));
}

TEST_CASE("edges and corners say which normals meet there", "[fill][analytic]") {
    const TriangleMesh box = test::make_box_mesh(Vec3(1, 0.8, 0.3));
    SpheresReport report;
    const SphereSet set = fill_spheres(box, options(0.05), report);
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
        for (const Vec3& n : normals) REQUIRE(n.cwiseAbs().maxCoeff() == Approx(1.0));
        corners += faces == 3;
    }
    CHECK(corners == 8);
}

TEST_CASE("faces take no area of one another round an edge", "[fill][analytic]") {
    // a plate 0.21 m thick: either face is one hexagonal layer, 1 cm from the other's centres
    const TriangleMesh plate = test::make_box_mesh(Vec3(3, 2, 0.21));
    SpheresReport report;
    const SphereSet set = fill_spheres(plate, options(0.1), report);
    double top = 0.0, bottom = 0.0;
    for (std::size_t k = 0; k < set.surface_count; ++k) {
        if (set.normal_spread[k] > 0.1) continue;
        if (set.normals[k].z() > 0.9) top += set.areas[k];
        if (set.normals[k].z() < -0.9) bottom += set.areas[k];
    }
    // without the rims, which the edge spheres have: a sphere's share reaches 0.05 m beyond it
    CHECK(top == Approx(2.7 * 1.7).epsilon(0.1));
    CHECK(bottom == Approx(top).epsilon(0.05));
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
    CHECK(sum.norm() < 1e-12 * static_cast<double>(set.size()));
    check_shares(set);
}

TEST_CASE("a lattice stands on the largest flat face", "[fill][analytic]") {
    // the deck of the curved hull, at z = 0
    SpheresReport report;
    const SphereSet set = fill_spheres(test::make_wigley(10, 2, 1, 40, 12),
                                       options(0.07, 0, Arrangement::lattice), report);
    double top = -1e300;
    for (const Vec3& c : set.centers) top = std::max(top, c.z());
    CHECK(top == Approx(-0.07).epsilon(1e-9));
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
        return fill_spheres(mesh, options(0.1), report);
    };
    const SphereSet one = fill_with(1), three = fill_with(3);
    set_thread_count(2);
    CHECK(one.centers == three.centers);
    CHECK(one.areas == three.areas);
    CHECK(one.volumes == three.volumes);
    CHECK(one.normals == three.normals);
}

TEST_CASE("moving a mesh by 1 km moves its spheres and keeps its inertia to 1e-9",
          "[fill][property]") {
    TriangleMesh mesh = test::make_box_mesh(Vec3(1, 0.8, 0.3));
    SpheresReport report;
    const SphereSet here = fill_spheres(mesh, options(0.05, 0, Arrangement::lattice), report);
    for (Vec3& v : mesh.vertices) v += Vec3(1000, -500, 200);
    const SphereSet there = fill_spheres(mesh, options(0.05, 0, Arrangement::lattice), report);
    CHECK(there.size() == here.size());
    CHECK((there.solid.inertia - here.solid.inertia).norm() < 1e-9 * here.solid.inertia.norm());
}

TEST_CASE("discs of a rectangle stand on its outline, corners included, at most the spacing apart",
          "[fill][2d]") {
    const TriangleMesh box = test::make_box_mesh(Vec3(1, 1, 0.4));
    SpheresReport report;
    const SphereSet set = fill_discs(slice_solid(box, 0.0), box.region_names,
                                     options(0.1, 0.05, Arrangement::conforming, true), report);
    CHECK(set.dimension == 2);
    CHECK(set.solid.volume == Approx(0.4).epsilon(1e-13));
    CHECK(set.solid.inertia(1, 1) == Approx(0.4 * 1.16 / 12).epsilon(1e-12));
    CHECK(set.solid.area == Approx(2.8).epsilon(1e-13));
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
    fill_spheres(extrude(section, {"hull"}), options(0.06, 0, Arrangement::lattice), report);
    REQUIRE(report.warnings.size() == 1);
    // the centroid is at a third of 0.2 m, the row at 0.06 m
    CHECK_THAT(report.warnings[0], Catch::Contains("centroid by 0.00667 m"));
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
    fill_spheres(extrude(section, {"hull"}), options(0.1), report);
    REQUIRE(report.thin_features.size() == 1);
    CHECK(report.thin_features[0].at[2] == Approx(-0.6).margin(0.2));
    CHECK(report.thin_features[0].size == Approx(1.25).margin(0.3));
}

TEST_CASE("the nearest point is the one a search of all finds, the first of equals",
          "[fill][equivalence]") {
    std::vector<Vec3> points;
    for (int k = 0; k < 700; ++k)  // a coarse grid visited in a scattered order, with repeats
        points.emplace_back(k * 37 % 9, k * 53 % 7, k * 71 % 5);
    const PointCells tree(points, 0.7);
    for (int k = 0; k < 2000; ++k) {
        const Vec3 p(0.5 * (k * 31 % 23) - 1, 0.5 * (k * 17 % 19) - 1, 0.5 * (k * 13 % 17) - 1);
        std::size_t best = 0;
        for (std::size_t i = 1; i < points.size(); ++i)
            if ((points[i] - p).squaredNorm() < (points[best] - p).squaredNorm()) best = i;
        const auto found = tree.nearest(p);
        REQUIRE(found.index == static_cast<std::int32_t>(best));
        REQUIRE(found.distance == (points[best] - p).norm());
    }
}

TEST_CASE("the narrowest cone holds all directions and no narrower one does", "[fill][analytic]") {
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    CHECK(narrowest_cone(std::array{x}).half_angle == 0.0);
    CHECK(narrowest_cone(std::array{x, y}).half_angle == Approx(M_PI / 4));
    CHECK(narrowest_cone(std::array{x, y, z}).half_angle == Approx(std::acos(std::sqrt(1.0 / 3))));
    // a direction between the others changes nothing
    const Vec3 between = (x + y).normalized();
    const Cone cone = narrowest_cone(std::array{x, between, y});
    CHECK(cone.half_angle == Approx(M_PI / 4));
    CHECK((cone.axis - between).norm() < 1e-12);
    CHECK(narrowest_cone(std::array{x, Vec3(-x)}).half_angle == Approx(M_PI));
}

TEST_CASE("surface samples sum to the area, stand in the triangles' middles and are small",
          "[fill][analytic]") {
    TriangleMesh mesh;
    mesh.vertices = {Vec3(0, 0, 0), Vec3(5, 0, 0), Vec3(4, 0.3, 0), Vec3(0, 0, 2)};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
    mesh.region = {0, 0};
    double area = 0.0;
    Vec3 first = Vec3::Zero();
    const auto samples = sample_surface(mesh, 0.1, 3);
    for (const SurfaceSample& s : samples) {
        area += s.area;
        first += s.area * s.point;
        REQUIRE(s.area <= 0.1 * 0.1 * (1 + 1e-9));
    }
    CHECK(area == Approx(0.75 + 5.0).epsilon(1e-12));
    // 0.75 (3, 0.1, 0) + 5 (5/3, 0, 2/3): centroids of the two
    CHECK((first - Vec3(2.25 + 25.0 / 3, 0.075, 10.0 / 3)).norm() < 1e-12);
    // the slender triangle gets pieces by its area, not by its length squared
    CHECK(static_cast<double>(samples.size()) < 1.6 * 5.75 / 0.01);
}

TEST_CASE("the nearest of points far away is found, the first of equals", "[fill][equivalence]") {
    std::vector<Vec3> points;
    for (int k = 0; k < 500; ++k) points.emplace_back(k * 37 % 9, k * 53 % 7, k * 71 % 5);
    const PointCells cells(points, 0.7);
    for (const Vec3& p : {Vec3(1000, 3, 2), Vec3(-1e12, 0, 0), Vec3(4, 20, 2), Vec3(4, 3, -9)}) {
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
    CHECK(cone.half_angle >= 0.5 - 1e-12);
    CHECK(cone.half_angle <= 0.5 * 1.01);
    for (const Vec3& d : directions)
        REQUIRE(std::acos(std::min(1.0, d.dot(cone.axis))) <= cone.half_angle + 1e-9);
}

TEST_CASE("a box a thousand kilometres from the origin is filled", "[fill][degenerate]") {
    TriangleMesh mesh = test::make_box_mesh(Vec3(1, 0.75, 0.5));
    for (Vec3& v : mesh.vertices) v += Vec3(1e6, -1e6, 1e6);
    SpheresReport report;
    const SphereSet set = fill_spheres(mesh, options(0.05), report);
    CHECK(set.surface_count > 1000);
    CHECK(report.protrusion_max < 1e-8);  // coordinates are known to 1e-10 m
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
    CHECK(sum == Approx(1.0 + 39 * 0.05).epsilon(1e-9));
    for (const double v : set.volumes) REQUIRE(v > 0.0);
    REQUIRE(report.warnings.size() == 1);
    CHECK_THAT(report.warnings[0], Catch::Contains("miss the centroid"));
}
