// SPDX-License-Identifier: GPL-3.0-or-later
// The look-alikes have the faults they are made for, and no others.
//
// Tolerances: 1e-12 is rounding of a volume.
#include "tests/preprocess/look_alikes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "common/geometry/mass_properties.hpp"
#include "preprocess/clean/find_parts.hpp"
#include "preprocess/clean/find_self_intersections.hpp"
#include "preprocess/repair/check_solid.hpp"
#include "tests/support/make_hull.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

double length_of(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    return box.sizes().x();
}

}  // namespace

TEST_CASE("look-alike: the container ship is a solid, and crosses itself at the stern only",
          "[support][look-alikes]") {
    const TriangleMesh clean = test::container_ship(test::Stern::clean);
    const SolidDiagnosis d = diagnose_solid(clean);
    INFO(d.text());
    CHECK(d.good());
    CHECK(d.parts == 1);
    CHECK(length_of(clean) == Near(test::kShipLength).epsilon(0.03));
    const double block = d.volume / (230.0 * 32.2 * 19.0);
    CAPTURE(block);
    CHECK((block > 0.6 && block < 0.85));
    CHECK(diagnose_solid(test::container_ship(test::Stern::rudder)).good());
    const TriangleMesh crossing = test::container_ship(test::Stern::crossing);
    CHECK(diagnose_edges(crossing).closed());
    const auto pairs = find_self_intersections(crossing);
    const Parts parts = find_parts(crossing);
    CHECK(pairs.size() > 100);
    std::size_t own = 0;
    for (const auto& [s, t] : pairs) {
        own += parts.of_triangle[s] == parts.of_triangle[t] ? 1 : 0;
        for (int k = 0; k < 3; ++k)
            REQUIRE(crossing.corner(s, k).x() < (-0.5 + 0.1) * test::kShipLength);
    }
    CHECK(own > 20);
    CHECK(own < pairs.size());
}

TEST_CASE("look-alike: the combatant is a solid with a fine bow, and crosses itself at its keel",
          "[support][look-alikes]") {
    const TriangleMesh hull = test::combatant();
    const SolidDiagnosis d = diagnose_solid(hull);
    INFO(d.text());
    CHECK(d.good());
    CHECK(length_of(hull) == Near(142.0).epsilon(0.02));
    const TriangleMesh folded = test::combatant(0.05);
    const auto pairs = find_self_intersections(folded);
    CHECK(pairs.size() > 20);
    CHECK(measure_mass(folded).volume == Near(measure_mass(hull).volume).epsilon(1e-3));
}

TEST_CASE("look-alike: the double skin's plates are solids that touch, or do not",
          "[support][look-alikes]") {
    double outer = 0.0, plates = 0.0;
    const TriangleMesh touching = test::double_skin(0.0, &outer, &plates);
    CHECK(find_parts(touching).count == 144);
    for (const double volume : part_volumes(touching, find_parts(touching))) CHECK(volume > 0.0);
    CHECK(plates / outer == Near(1.0 - 0.512).epsilon(1e-12));
    CHECK(find_self_intersections(test::double_skin(0.01)).empty());
}

TEST_CASE("look-alike: the catamaran has 51 parts and 57 planar openings",
          "[support][look-alikes]") {
    double whole = 0.0;
    const TriangleMesh mesh = test::catamaran(&whole);
    CHECK(find_parts(mesh).count == 51);
    CHECK(find_openings(mesh).size() == 57);
    CHECK(find_self_intersections(mesh).empty());
}

TEST_CASE("look-alike: a hull cut at its waterline is open there and nowhere else",
          "[support][look-alikes]") {
    TriangleMesh hull = test::make_hull({}, 20000);
    for (Vec3& v : hull.vertices) v.z() -= 10.0;
    const TriangleMesh cut = test::cut_at(hull, 0.0);
    const auto openings = find_openings(cut);
    REQUIRE(openings.size() == 1);
    CHECK(std::all_of(cut.vertices.begin(), cut.vertices.end(),
                      [](const Vec3& v) { return v.z() <= 0.0; }));
}

TEST_CASE("look-alike: patches one by one have cracks all round, and lie on the ship",
          "[support][look-alikes]") {
    const TriangleMesh patches = test::patchwise_ship();
    CHECK(find_parts(patches).count == 61);
    CHECK(diagnose_edges(patches).open_edges > 3000);
}

TEST_CASE("look-alike: a domain's box and a sea plane lie around the ship",
          "[support][look-alikes]") {
    const TriangleMesh ship = test::container_ship(test::Stern::clean, 40, 12);
    const TriangleMesh mesh = test::in_domain_box(ship, true, true);
    const Parts parts = find_parts(mesh);
    REQUIRE(parts.count == 3);
    CHECK(part_volumes(mesh, parts)[1] < -30.0 * part_volumes(mesh, parts)[0]);
}

TEST_CASE("look-alike: bulwark plates reach through the shell at their ends",
          "[support][look-alikes]") {
    const TriangleMesh mesh = test::ship_with_bulwark();
    CHECK(find_parts(mesh).count == 9);
    CHECK(diagnose_edges(mesh).closed());
    CHECK(find_self_intersections(mesh).size() > 8);
}
