// SPDX-License-Identifier: GPL-3.0-or-later
// Hulls as they come (look_alikes): what is wrong is mended where it is.
//
// Tolerances: 1e-4 is the sampling error of 1000 x 1000 rows; 1e-12 and 1e-9 are rounding of a
// volume.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <iterator>
#include <set>

#include "common/base/parallel.hpp"
#include "common/geometry/mass_properties.hpp"
#include "preprocess/clean/find_self_intersections.hpp"
#include "preprocess/measure/row_volumes.hpp"
#include "preprocess/repair/check_solid.hpp"
#include "preprocess/repair/make_solid.hpp"
#include "tests/preprocess/look_alikes.hpp"
#include "tests/support/damage_mesh.hpp"
#include "tests/support/make_hull.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

struct Mended {
    TriangleMesh mesh;
    Repairs repairs;
    std::vector<std::string> warnings;
    double volume = 0.0;

    std::int64_t count(const std::string& step) const {
        for (const auto& [name, number] : repairs)
            if (name == step) return number;
        return 0;
    }
    std::string said() const {
        std::string out;
        for (const auto& [name, number] : repairs) out += fmt::format("{}: {}\n", name, number);
        for (const auto& warning : warnings) out += warning + "\n";
        return out;
    }
};

Mended mend(const TriangleMesh& mesh, const SolidOptions& options = {}) {
    Mended out;
    out.mesh = make_solid(mesh, "ship.obj", options, out.repairs, &out.warnings);
    out.volume = measure_mass(out.mesh).volume;
    CHECK(diagnose_solid(out.mesh).text() == "");
    return out;
}

using Place = std::array<double, 3>;

std::set<Place> places_ahead(const TriangleMesh& mesh, double x) {
    std::set<Place> out;
    for (const Vec3& v : mesh.vertices)
        if (v.x() > x) out.insert({v.x(), v.y(), v.z()});
    return out;
}

}  // namespace

TEST_CASE("crossings at the stern leave every vertex forward of 0.1 L where it was, bit for bit",
          "[repair][mend]") {
    const TriangleMesh ship = test::container_ship(test::Stern::crossing);
    const Mended mended = mend(ship);
    INFO(mended.said());
    const double aft = -0.4 * test::kShipLength;
    CHECK(places_ahead(mended.mesh, aft) == places_ahead(ship, aft));
    CHECK(mended.warnings.empty());
    CHECK(mended.count("overlapping parts united") == 2);
    // every place of positive winding number counts once: the sampling error of 1000 x 1000 rows
    CHECK(mended.volume == Near(measure_rows(ship, 1000)[0].by_winding).epsilon(1e-4));
}

TEST_CASE("sides that cross along a keel, and plates through a deck edge, are cut where they cross",
          "[repair][mend]") {
    const TriangleMesh mesh = GENERATE(test::combatant(0.3), test::ship_with_bulwark());
    const Mended mended = mend(mesh);
    INFO(mended.said());
    CHECK(mended.warnings.empty());
    CHECK(mended.count("crossing triangles cut where they meet") > 50);
    CHECK(mended.volume == Near(measure_rows(mesh, 1000)[0].by_winding).epsilon(1e-4));
}

TEST_CASE("hulls of 1e5 triangles cut at their waterline are closed there", "[repair][mend]") {
    const TriangleMesh cut = test::cut_at(
        GENERATE(test::container_ship(test::Stern::clean, 460, 80), test::combatant(0.0, 500, 85)),
        0.0);
    REQUIRE(cut.triangles.size() > 90000);
    double below = 0.0;  // cones from the origin, which lies in the cut
    for (std::size_t t = 0; t < cut.triangles.size(); ++t)
        below += cut.corner(t, 0).dot(cut.corner(t, 1).cross(cut.corner(t, 2))) / 6.0;
    const Mended mended = mend(cut);
    // in the stem the two sides' rims are nearer than a third of their edges: stitched there
    CHECK(mended.volume == Near(below).epsilon(1e-6));
    CHECK(mended.count("deck closed by a cap") == 1);
}

TEST_CASE("patches that were tessellated one by one are stitched, and stay where they were",
          "[repair][mend]") {
    const TriangleMesh patches = test::patchwise_ship(1e-4);
    const double volume = measure_mass(test::container_ship(test::Stern::clean)).volume;
    const Mended mended = mend(patches);
    INFO(mended.said());
    CHECK(mended.volume == Near(volume).epsilon(1e-3));
    CHECK(mended.warnings.empty());
    REQUIRE(mended.repairs[0].first.starts_with("open edges stitched across cracks of up to 0.1"));
    CHECK(mended.repairs[0].second > 3000);
    // but for the corners of the few pieces that were cut, every vertex is one of the patches'
    const auto before = places_ahead(patches, -1e9), after = places_ahead(mended.mesh, -1e9);
    std::vector<Place> added;
    std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                        std::back_inserter(added));
    CHECK(added.size() < 100);
}

TEST_CASE(
    "patches with cracks as wide as their chords' heights become one surface, or are refused "
    "as cracks",
    "[repair][mend]") {
    const double volume = measure_mass(test::container_ship(test::Stern::clean)).volume;
    for (const double crack : {3e-4, 5e-4}) {
        const Mended mended = mend(test::patchwise_ship(crack));
        INFO(crack << ": " << mended.said());
        CHECK(mended.volume == Near(volume).epsilon(2e-3));
    }
    for (const double crack : {7e-4, 2e-3})
        CHECK_THROWS_WITH(mend(test::patchwise_ship(crack)),
                          Catch::Contains("lie beside another open edge") &&
                              Catch::Contains("cracks between patches") &&
                              Catch::Contains("--repair wrap"));
}

TEST_CASE("triangles one by one with gaps of 1e-4 L become one surface", "[repair][mend]") {
    TriangleMesh ship = test::container_ship(test::Stern::clean, 60, 20);
    const double volume = measure_mass(ship).volume;
    std::mt19937 random(4);
    test::split_faces(
        ship, [](std::size_t t) { return static_cast<std::int32_t>(t); },
        0.5e-4 * test::kShipLength, random);
    const Mended mended = mend(ship);
    INFO(mended.said());
    CHECK(mended.volume == Near(volume).epsilon(2e-3));
}

TEST_CASE("a ship of plates is filled, whether they touch or leave gaps", "[repair][mend]") {
    double outer = 0.0, plates = 0.0;
    SECTION("touching: exactly, in the envelope and in the material") {
        const TriangleMesh mesh = test::double_skin(0.0, &outer, &plates);
        CHECK(mend(mesh).volume == Near(outer).epsilon(1e-9));
        SolidOptions options;
        options.kind = SolidKind::material;
        CHECK(mend(mesh, options).volume == Near(plates).epsilon(1e-9));
    }
    SECTION("gaps of 0.01 m: to the cells of a contour, and said") {
        const TriangleMesh mesh = test::double_skin(0.01, &outer, &plates);
        SolidOptions options;
        options.radius = 0.4;
        const Mended mended = mend(mesh, options);
        CHECK(mended.volume == Near(outer).epsilon(0.01));
        REQUIRE(mended.warnings.size() == 1);
        CHECK_THAT(mended.warnings[0],
                   Catch::Contains("voids of about 5") && Catch::Contains("cells of 0.4 m"));
    }
}

TEST_CASE("a catamaran with 57 planar openings is accepted, with the doubt that leaves",
          "[repair][mend]") {
    double whole = 0.0;
    const Mended mended = mend(test::catamaran(&whole));
    CHECK(mended.volume == Near(whole).epsilon(1e-9));
    REQUIRE(mended.warnings.size() == 1);
    CHECK_THAT(mended.warnings[0], Catch::Contains("57 openings were closed by guess") &&
                                       Catch::Contains("1.3 % of the volume in doubt"));
}

TEST_CASE("openings that leave too much in doubt together are refused with the sum and its limit",
          "[repair][mend][errors]") {
    TriangleMesh mesh;
    for (int k = 0; k < 6; ++k) {  // six boats with 57 posts' openings each, and little hull
        TriangleMesh boat = test::catamaran();
        for (Vec3& v : boat.vertices)
            v = Vec3(v.x(), v.y() + 30.0 * k, v.z() > 2.3 ? v.z() : 0.3 * v.z() + 1.61);
        test::append(mesh, boat);
    }
    CHECK_THROWS_WITH(mend(mesh), Catch::Contains("342 openings") &&
                                      Catch::Contains("% of the volume in doubt (2 % may be)"));
}

TEST_CASE("a flow solver's box and sea plane are dropped and named", "[repair][mend]") {
    const TriangleMesh ship = test::container_ship(test::Stern::clean, 60, 20);
    const Mended mended = mend(test::in_domain_box(ship, true, true));
    CHECK(mended.volume == Near(measure_mass(ship).volume).epsilon(1e-12));
    CHECK(mended.count("parts of a flow solver's domain dropped") == 2);
    REQUIRE(mended.warnings.size() == 2);
    CHECK_THAT(mended.warnings[0], Catch::Contains("a box of 924 x 693 x 693 m"));
    CHECK_THAT(mended.warnings[1], Catch::Contains("a flat sheet of 693 x 693 x 0 m"));
    SolidOptions strict;
    strict.mode = RepairMode::strict;
    CHECK_THROWS_WITH(mend(test::in_domain_box(ship), strict), Catch::Contains("a box of"));
    const TriangleMesh floe = test::make_box_mesh(Vec3(2, 1, 0.5));
    CHECK(mend(test::in_domain_box(floe, true, true)).volume == Near(1.0));
    // a barge around its own small tank is no domain: nothing here is anything but a box
    TriangleMesh barge = test::make_box_mesh(Vec3(60, 20, 5));
    test::append(barge, test::make_box_mesh(Vec3(6, 4, 3)));
    CHECK(mend(barge).volume == Near(6000.0));
}

TEST_CASE("wrapping a hull with an open deck caps the deck first, and says what that gives",
          "[repair][mend]") {
    const TriangleMesh cut = test::cut_at(test::container_ship(test::Stern::clean, 60, 20), 0.0);
    double below = 0.0;
    for (std::size_t t = 0; t < cut.triangles.size(); ++t)
        below += cut.corner(t, 0).dot(cut.corner(t, 1).cross(cut.corner(t, 2))) / 6.0;
    SolidOptions options;
    options.mode = RepairMode::wrap;
    const Mended mended = mend(cut, options);
    CHECK(mended.volume == Near(below).epsilon(0.02));
    REQUIRE(mended.warnings.size() == 2);
    const double said = std::stod(mended.warnings[1].substr(mended.warnings[1].rfind('(') + 1));
    // the winding number's volume is that of 20 000 places
    CHECK(said == Near(100.0 * (mended.volume / below - 1.0)).margin(1.0));
}

TEST_CASE("a noisy surface is solid where it encloses, and is called noisy", "[repair][mend]") {
    TriangleMesh ship = test::container_ship(test::Stern::clean);
    const double volume = measure_mass(ship).volume;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(-0.6, 0.6);  // faces are about 2 m by 0.5 m
    for (Vec3& v : ship.vertices) v += Vec3(unit(random), unit(random), unit(random));
    const Mended mended = mend(ship);
    CHECK(mended.volume == Near(volume).epsilon(0.01));
    CHECK(mended.volume == Near(measure_rows(ship, 1000)[0].by_winding).epsilon(1e-4));
    REQUIRE(mended.warnings.size() == 1);
    CHECK_THAT(mended.warnings[0], Catch::Contains("% of the triangles cross others"));
}

TEST_CASE("what is mended has the same bits for any number of threads", "[repair][mend]") {
    const TriangleMesh ship = test::container_ship(test::Stern::crossing);
    const int threads = thread_count();
    set_thread_count(1);
    const Mended one = mend(ship);
    set_thread_count(3);
    const Mended three = mend(ship);
    set_thread_count(threads);
    CHECK(one.mesh.triangles == three.mesh.triangles);
    CHECK(one.mesh.vertices == three.mesh.vertices);
    CHECK(one.repairs == three.repairs);
}
