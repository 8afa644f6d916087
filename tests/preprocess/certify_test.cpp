// SPDX-License-Identifier: GPL-3.0-or-later
// The certificate against the source, the ice belt, ends cut back, spheres outside.
//
// Tolerances: 1e-12 is rounding of a sum over triangles; 1e-9 m that of a distance, with a reserve;
// 1e-6 of a radius is what spherize settles to.
#include <catch2/catch.hpp>

#include "common/base/error.hpp"
#include "common/geometry/winding_number.hpp"
#include "preprocess/certify/certify_solid.hpp"
#include "preprocess/certify/compare_with_source.hpp"
#include "preprocess/certify/find_cut_back.hpp"
#include "preprocess/certify/judge_spheres.hpp"
#include "preprocess/fill/drop_outside.hpp"
#include "preprocess/fill/fill_spheres.hpp"
#include "preprocess/repair/make_solid.hpp"
#include "tests/preprocess/lattice_solids.hpp"
#include "tests/preprocess/look_alikes.hpp"
#include "tests/support/make_hull.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/make_sphere_sets.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

// A box whose forward face is moved aft.
TriangleMesh shortened(TriangleMesh box, double by) {
    for (Vec3& v : box.vertices)
        if (v.x() > 0.0) v.x() -= by;
    return box;
}

// A wedge with a vertical edge forward at x = 0.
TriangleMesh make_wedge(double length, double half_angle, double height) {
    const double half = length * std::tan(half_angle);
    TriangleMesh mesh =
        test::make_prism({{0.0, 0.0}, {-length, half}, {-length, -half}}, 0.5 * height);
    for (Vec3& v : mesh.vertices) v = Vec3(v.x(), -v.z(), v.y());  // its axis from y to z
    return mesh;
}

SpheresReport compared(const TriangleMesh& source, const TriangleMesh& solid, double radius) {
    SpheresReport report;
    compare_with_source(source, solid, radius, report);
    return report;
}

bool warns(const SpheresReport& report, const std::string& words) {
    return std::any_of(report.warnings.begin(), report.warnings.end(),
                       [&](const std::string& w) { return w.find(words) != std::string::npos; });
}

}  // namespace

TEST_CASE("a mesh is its own solid: all distances are zero", "[certify][analytic]") {
    const TriangleMesh hull = test::make_hull({10, 2, 1.8}, 2000);
    const SpheresReport report = compared(hull, hull, 0.1);
    CHECK(report.source.known);
    CHECK(report.source.to_solid.max == 0.0);
    CHECK(report.source.to_source.max == 0.0);
    CHECK(report.source.caps_area == 0.0);
    CHECK(report.source.area == Near(measure_mass(hull).area).epsilon(1e-12));
}

TEST_CASE("a face that was moved aft by 0.3 m is 0.3 m away, with its share and place",
          "[certify][analytic]") {
    const TriangleMesh box = test::make_box_mesh(Vec3(4, 1, 1));
    const SpheresReport report = compared(box, shortened(box, 0.3), 0.1);
    // the source's forward face, 1 of 18 m2, and the sides' last 0.3 m; the largest at the face
    CHECK(report.source.to_solid.max == Near(0.3).epsilon(1e-9));
    CHECK(report.source.to_solid.at[0] == Near(2.0));
    CHECK(report.source.to_solid.p99 == Near(0.3).epsilon(1e-9));
    CHECK(report.source.to_solid.p50 == 0.0);
    // seen from the solid, whose face lies in the source, the nearest side is 0.3 m or less away
    CHECK(report.source.to_source.max == Near(0.3).epsilon(0.05));
    CHECK(report.source.caps_area == 0.0);
}

TEST_CASE("what lies inside the solid or is left out on purpose is no distance", "[certify]") {
    const TriangleMesh hull = test::container_ship(test::Stern::clean);
    TriangleMesh source = hull;
    SECTION("a hold inside") {
        TriangleMesh hold = test::make_box_mesh(Vec3(60, 16, 8));
        for (auto& t : hold.triangles) std::swap(t[1], t[2]);
        test::append(source, hold);
        CHECK(compared(source, hull, 1.0).source.to_solid.max == 0.0);
    }
    SECTION("a sea plane") {
        source = test::in_domain_box(hull, false, true);
        SpheresReport report = compared(source, hull, 1.0);
        CHECK(report.source.to_solid.max <= 1.0);
        CHECK(report.source.left_out_area > 4e5);  // (3 L)^2 but for the hull's waterplane
        certify_solid("sea.stl", source, hull, 1.0, false, report);
        CHECK(warns(report, "are no surface of the solid"));
    }
    SECTION("a domain's box") {
        const SpheresReport report = compared(test::in_domain_box(hull), hull, 1.0);
        CHECK(report.source.to_solid.max == 0.0);
        CHECK(report.source.left_out_area > 1e6);
    }
}

TEST_CASE("an opening's cap is told apart from a surface that was moved", "[certify]") {
    TriangleMesh box = test::make_box_mesh(Vec3(4, 1, 1));
    TriangleMesh open = box;
    // without its upper face
    std::size_t kept = 0;
    for (std::size_t t = 0; t < box.triangles.size(); ++t) {
        if (box.area_vector(t).z() > 0.1) continue;
        open.triangles[kept] = box.triangles[t];
        open.region[kept++] = 0;
    }
    open.triangles.resize(kept);
    open.region.resize(kept);
    const SpheresReport report = compared(open, box, 0.1);
    CHECK(report.source.to_solid.max == 0.0);
    CHECK(report.source.to_source.max == 0.0);
    CHECK(report.source.caps_area == Near(4.0));
}

TEST_CASE("a part that was lost is a distance, and a warning with the number", "[certify]") {
    const TriangleMesh hull = test::container_ship(test::Stern::clean);
    TriangleMesh source = hull, rudder = test::make_box_mesh(Vec3(4, 0.6, 5));
    for (Vec3& v : rudder.vertices) v += Vec3(-118, 0, -7);
    test::append(source, rudder);
    SpheresReport report;
    certify_solid("ship.stl", source, hull, 1.0, false, report);
    CHECK(report.source.to_solid.max > 2.0);
    CHECK(warns(report, "the mesh lies outside the solid"));
    CHECK(report.source.left_out_area == 0.0);
}

TEST_CASE("a stem that repairs moved in the ice belt is refused, wrapped it is a warning",
          "[certify][errors]") {
    const TriangleMesh box = test::make_box_mesh(Vec3(4, 1, 1));
    const TriangleMesh solid = shortened(box, 0.3);
    SpheresReport report;
    set_ice_belt(solid, 0.5, 0.05, report);
    CHECK(report.belt.low == Near(-0.1));
    CHECK(report.belt.high == Near(0.1));
    CHECK_THROWS_WITH(certify_solid("box.stl", box, solid, 0.1, false, report),
                      Catch::Contains("ice belt") && Catch::Contains("0.3 m"));
    certify_solid("box.stl", box, solid, 0.1, true, report);
    CHECK(report.belt.to_solid.max == Near(0.3).epsilon(1e-9));
    CHECK(warns(report, "outside the solid"));
    // outside the belt it is a warning anyway
    SpheresReport dry;
    certify_solid("box.stl", box, solid, 0.1, false, dry);
    CHECK(warns(dry, "radii"));
}

TEST_CASE("draughts that mean nothing are refused by name", "[certify][errors]") {
    const TriangleMesh box = test::make_box_mesh(Vec3(4, 1, 1));
    SpheresReport report;
    CHECK_THROWS_WITH(set_ice_belt(box, 1.5, {}, report), Catch::Contains("--draught"));
    CHECK_THROWS_WITH(set_ice_belt(box, {}, 0.1, report), Catch::Contains("--ice-thickness"));
    set_ice_belt(box, 0.8, {}, report);
    CHECK(report.belt.thickness == Near(0.08));
    CHECK(report.belt.water() == Near(0.3));
}

TEST_CASE("a wedge's stem is cut back by R (1 / sin(angle) - 1)", "[certify][analytic]") {
    const double angle = GENERATE(0.2, 0.35), radius = 0.1;
    const TriangleMesh wedge = make_wedge(4.0, angle, 2.0);
    SpheresReport report;
    const SphereSet set = fill_spheres(wedge, {radius, 0.0, Arrangement::conforming, true}, report);
    find_cut_back(set, report);
    const double expected = radius * (1.0 / std::sin(angle) - 1.0);
    const auto stem = std::find_if(report.cut_back.begin(), report.cut_back.end(),
                                   [](const CutBack& cut) { return cut.part == "stem"; });
    REQUIRE(stem != report.cut_back.end());
    // levels are a quarter of a radius apart: the nearest lies at most R / 8 off a sphere's centre
    CHECK(stem->by >= expected * (1 - tolerance(1e-6)));
    CHECK(stem->by <= expected + radius * (1.0 - std::cos(std::asin(0.125))) + tolerance(1e-9));
    CHECK_THAT(cut_back_text(*stem), Catch::Contains("the stem is cut back by up to"));
    // a box is cut nowhere
    SpheresReport none;
    const SphereSet box = fill_spheres(test::make_box_mesh(Vec3(4, 1, 1)), {radius}, none);
    find_cut_back(box, none);
    CHECK(none.cut_back.empty());
    // nor where its spheres stand in a lattice and touch in single points
    SphereSet lattice = fill_spheres(test::make_box_mesh(Vec3(1, 0.8, 0.3)),
                                     {0.05, 0.1, Arrangement::lattice}, none);
    find_cut_back(lattice, none);
    CHECK(none.cut_back.empty());
    // a row of spheres missing at the keel is a cut all the same
    std::vector<Vec3> kept;
    for (std::size_t s = 0; s < lattice.surface_count; ++s)
        if (std::abs(lattice.centers[s].x()) > 0.11) kept.push_back(lattice.centers[s]);
    lattice.centers = kept;
    lattice.surface_count = kept.size();
    lattice.radii.resize(kept.size());
    find_cut_back(lattice, none);
    REQUIRE(none.cut_back.size() == 1);
    CHECK(none.cut_back[0].part == std::string("keel"));
    CHECK(none.cut_back[0].from > -0.11);
    CHECK(none.cut_back[0].to < 0.11);
}

TEST_CASE("the ice belt's line says what the certificate holds", "[certify]") {
    SpheresReport report;
    CHECK(ice_belt_text(report).empty());
    const TriangleMesh hull = test::combatant();
    set_ice_belt(hull, 6.2, 0.6, report);
    certify_solid("ship.stl", hull, hull, 0.5, false, report);
    const SphereSet set = fill_spheres(hull, {0.5, 0.0, Arrangement::conforming, true}, report);
    find_cut_back(set, report);
    judge_spheres(set, Arrangement::conforming, report);
    const std::string text = ice_belt_text(report);
    CHECK_THAT(text, Catch::Contains("draught 6.2 m, ice 0.6 m") &&
                         Catch::Contains("the surface is the mesh's") &&
                         Catch::Contains("the stem is cut back by up to"));
    CHECK(report.belt.gap_max >= report.belt.gap_p99);
    CHECK(report.unfitted_share > 0.001);
    CHECK(report.unfitted_share < 0.2);
    CHECK(warns(report, "in the ice belt the stem is cut back"));
    // of single places between spheres only
    CHECK(report.covering_radius <= 0.66 * set.spacing);
}

TEST_CASE("a lattice whose layers do not fill the thickness is warned of", "[certify][fill]") {
    // spheres of 0.05 m: 0.3 m is three layers, 0.35 m leaves half a layer at one face
    const double thickness = GENERATE(0.3, 0.35);
    const TriangleMesh box = test::make_box_mesh(Vec3(2, 1.5, thickness));
    SpheresReport report;
    set_ice_belt(box, {}, {}, report);
    certify_solid("floe.obj", box, box, 0.05, false, report);
    const SphereSet set = fill_spheres(box, {0.05, 0.0, Arrangement::lattice, true}, report);
    judge_spheres(set, Arrangement::lattice, report);
    CAPTURE(thickness, report.unfitted_share);
    CHECK(warns(report, "the lattice has no sphere at") == (thickness > 0.3));
}

TEST_CASE("no sphere is outside by exact winding number where faces cross", "[certify][fill]") {
    // the sides change places along the keel: below the fold the normals point inwards
    const TriangleMesh folded = test::combatant(0.8);
    SpheresReport report;
    const SphereSet set = fill_spheres(folded, {0.5, 0.0, Arrangement::conforming, true}, report);
    const WindingNumber winding(folded);
    for (std::size_t k = 0; k < set.surface_count; k += 7)
        REQUIRE(winding.at(set.centers[k], INFINITY) > 0.5);
    CHECK(report.protrusion_max <= tolerance(1e-6) * set.radius);
}

TEST_CASE("spheres outside are dropped heap by heap, those inside keep their order",
          "[certify][fill][equivalence]") {
    const TriangleMesh globe = test::make_globe(2.0, 24);
    std::vector<Vec3> centers, inside;
    const double radius = 0.1;
    for (int k = 0; k < 400; ++k) {  // on lines through the surface, none nearer to it than R
        const double at = 0.05 * (k % 100) - 2.5;
        const Vec3 p = k < 100 ? Vec3(at, 0.1, 0.2) : Vec3(0.3, at, 0.01 * (k / 100));
        if (std::abs(p.norm() - 2.0) < 0.15) continue;
        centers.push_back(p);
        if (p.norm() < 2.0) inside.push_back(p);
    }
    const std::size_t all = centers.size();
    CHECK(drop_outside(globe, radius, centers) == static_cast<std::int64_t>(all - inside.size()));
    CHECK(centers == inside);
}
