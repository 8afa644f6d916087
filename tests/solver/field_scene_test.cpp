// SPDX-License-Identifier: GPL-3.0-or-later
// Floes from a field file: which shapes, where, how high, and which of them may move.
//
// Tolerances: 1e-12 is rounding of a few sums and products; 1e-9 that of a clearance, a difference
// of places of 10 m.
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "common/formats/field_file.hpp"
#include "common/formats/spheres_file.hpp"
#include "solver/draft/draft_case.hpp"
#include "solver/scene/build_scene.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/make_sphere_sets.hpp"
#include "tests/support/temporary_file.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

const Vec3 kSmall(1.0, 0.8, 0.4), kLarge(2.0, 1.0, 0.4);

// Shares that add up to the surface, as a file's must.
SphereSet box_set(const Vec3& size, double radius, double spacing) {
    SphereSet set = test::make_box_set(size, radius, spacing);
    const double sum = std::accumulate(set.areas.begin(), set.areas.end(), 0.0);
    for (double& area : set.areas) area *= set.solid.area / sum;
    return set;
}

// Two shapes, four floes; the second and the last are unbroken ice.
Field make_field() {
    Field field;
    field.radius = 0.1;
    field.spacing = 0.2;
    field.mode = "surface";
    for (const Vec3& size : {kSmall, kLarge}) {
        SphereSet set = box_set(size, 0.1, 0.2);
        set.mesh.region_names = {"ice"};
        field.shapes.push_back(set);
    }
    const Eigen::Quaterniond turned(0.6, 0.0, 0.0, 0.8);
    const auto straight = Eigen::Quaterniond::Identity();
    field.floes = {{0, {1.0, 2.0}, straight, false},
                   {1, {5.0, 3.0}, straight, true},
                   {1, {9.0, -2.0}, turned, false},
                   {1, {5.0, -3.0}, straight, true}};
    return field;
}

// Of a hull of 10 x 2 x 1 m, half of it above z = 0, and floes in a row from x = 0.005 m on.
Draft drafted(int floes) {
    const test::TemporaryFile hull(".spheres.h5", ""), file(".h5", "");
    write_spheres(hull.path(), box_set({10.0, 2.0, 1.0}, 0.2, 0.4));
    Field field;
    field.radius = 0.1;
    field.spacing = 0.2;
    field.mode = "surface";
    SphereSet floe = box_set(kSmall, 0.1, 0.2);
    floe.mesh.region_names = {"ice"};
    field.shapes.push_back(floe);
    for (int k = 0; k < floes; ++k)
        field.floes.push_back({0, {0.505 + 1.25 * k, 0.0}, Eigen::Quaterniond::Identity(), false});
    write_field(file.path(), field);
    return draft_case(hull.path(), file.path());
}

Case parameters(const test::TemporaryFile& hull, const test::TemporaryFile& field) {
    SphereSet set = box_set({4.0, 2.0, 1.0}, 0.2, 0.4);
    write_spheres(hull.path(), set);
    write_field(field.path(), make_field());
    Case p;
    p.hull_spheres = hull.path();
    p.speed_table = {{0.0, 1.0}};
    p.floes.resize(2);
    for (FloeGroup& group : p.floes) {
        group.pattern = Pattern::file;
        group.file = field.path();
        group.origin = {10.0, -1.0};
    }
    p.floes[1].unbroken_part = true;
    p.floes[1].hold = Hold::always;
    return p;
}

}  // namespace

TEST_CASE("a field's floes lie where the file says, afloat, unbroken ice last", "[scene][field]") {
    const test::TemporaryFile hull(".spheres.h5", ""), file(".h5", "");
    const Scene scene = build_scene(parameters(hull, file));
    const Bodies& b = scene.bodies;
    REQUIRE(b.size() == 1 + 4);
    CHECK(scene.shapes.size() == 3);          // both groups share the file's shapes
    const double height = 0.4 * (0.5 - 0.9);  // floating at 900 / 1000, body axes halfway up
    const std::vector<Vec3> expected{Vec3(11.0, 1.0, height), Vec3(19.0, -3.0, height),
                                     Vec3(15.0, 2.0, height), Vec3(15.0, -4.0, height)};
    for (std::size_t i = 1; i < b.size(); ++i) {
        CAPTURE(i);
        // floating_height bisects to 1e-12 of the height
        CHECK((b.position[i] - expected[i - 1]).norm() < tolerance(1e-11));
        CHECK(b.group[i] == (i <= 2 ? 0 : 1));
        CHECK(b.held[i] == 1);  // the default, until the hull's contact
    }
    CHECK(b.mass[1] == Near(900.0 * kSmall.prod()).epsilon(1e-12));
    CHECK(b.mass[2] == Near(900.0 * kLarge.prod()).epsilon(1e-12));
    CHECK(b.orientation[2].z() == 0.8);
}

TEST_CASE("a field's hold is the case's for loose floes only", "[scene][field]") {
    const test::TemporaryFile hull(".spheres.h5", ""), file(".h5", "");
    Case p = parameters(hull, file);
    p.floes[0].hold = Hold::never;
    const Scene scene = build_scene(p);
    CHECK(scene.bodies.held == std::vector<std::uint8_t>{0, 0, 0, 1, 1});
}

TEST_CASE("a drafted case of a box hull has the numbers that follow by hand", "[draft][analytic]") {
    const Draft draft = drafted(24);
    CHECK(draft.draught_from_mesh);
    CHECK(draft.draught == 0.5);
    CHECK(draft.length == Near(10.0).epsilon(1e-12));
    CHECK(draft.y == 0.0);
    // the bow two spacings of 0.4 m before the ice, rounded down to a centimetre
    CHECK(draft.x == Near(0.005 - 0.8 - 5.0 - 0.005).epsilon(1e-12));
    CHECK(draft.clearance == Near(0.805).epsilon(1e-9));
    // 0.0657 sqrt(9.81 m/s2 x 10 m) = 0.6507 m/s; a fifth of 0.1 m at 0.65 m/s is 0.031 s
    CHECK(draft.speed == 0.65);
    CHECK(draft.time_step == 0.02);
    // 22 m and the clearance are 1754.2 steps of 0.013 m; the averages begin after a ship length in
    // the ice: the last 12 m take 18.462 s
    CHECK(draft.duration == Near(1755 * 0.02).epsilon(1e-12));
    CHECK(draft.average_from == 16.6);
    CHECK(draft.lengths == Near(0.65 * 35.1 / 10.0).epsilon(1e-12));
    CHECK(draft.averaged_lengths == Near(0.65 * 18.5 / 10.0).epsilon(1e-12));
    CHECK(draft.settled_lengths == Near((0.65 * 16.6 - 0.805) / 10.0).epsilon(1e-9));
    // level ice: a quarter of a length beyond the way of the bow, -0.8 + 0.65 x 35.1 + 2.5 m, and
    // three half breadths to both sides
    CHECK(draft.thickness == 0.4);
    CHECK(draft.ice_from == 0.0);
    CHECK(draft.ice_to == 25.0);
    CHECK(draft.ice_starboard == -3.0);
    CHECK(draft.ice_port == 3.0);
}

TEST_CASE("a hull under water asks for the sets that were swapped", "[scene][errors]") {
    const test::TemporaryFile small(".spheres.h5", ""), large(".spheres.h5", "");
    write_spheres(small.path(), box_set(kSmall, 0.1, 0.2));
    write_spheres(large.path(), box_set({10.0, 2.0, 1.8}, 0.2, 0.4));
    Case p;
    p.hull_spheres = small.path();
    p.hull_draught = 1.44;
    p.speed_table = {{0.0, 1.0}};
    p.floes.resize(1);
    p.floes[0].spheres = large.path();
    const auto complaint = [&] { return test::error_text([&] { build_scene(p); }); };
    CHECK_THAT(complaint(),
               Catch::Contains("the hull would lie wholly under water; the mesh is 0.4 m "
                               "deep") &&
                   Catch::Contains("or is hull.spheres the floe's set? "
                                   "floes.1.spheres is 1.8 m deep"));
    p.hull_draught = 2.0;  // more than either is deep
    CHECK_THAT(complaint(),
               Catch::Contains("wholly under water") && !Catch::Contains("floe's set"));
}

TEST_CASE("a drafted case of a short field averages over the last ship length all the same",
          "[draft][analytic]") {
    // 15 floes end at x = 18.505 m: 95 % of the 19.305 m from the bow to there are 18.34 m
    const Draft draft = drafted(15);
    CHECK(draft.duration == Near(1411 * 0.02).epsilon(1e-12));
    CHECK(draft.average_from == 12.8);  // the last 10 m take 15.385 s
    CHECK(draft.averaged_lengths == Near(0.65 * (28.22 - 12.8) / 10.0).epsilon(1e-12));
    CHECK(draft.settled_lengths == Near((0.65 * 12.8 - 0.805) / 10.0).epsilon(1e-9));
}
