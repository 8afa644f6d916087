// SPDX-License-Identifier: GPL-3.0-or-later
// Overlaps: how fast they open, and whether solids that lie in each other are seen.
//
// Tolerances: 1e-12 m is rounding of lengths of a metre; 1e-6 m is a normal stored as a float, over
// 0.05 m.
#include <catch2/catch.hpp>

#include "solver/record/solid_overlap.hpp"
#include "solver/run/unfelt_hull.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

// A hull far away and two floes of 1 x 0.8 x 0.3 sizes, the second one at `place` from the first.
World two_floes(double size, double dt, const Vec3& place,
                const Quaternion& turn = Quaternion::Identity()) {
    World w = test::plate_world(test::empty_space(dt), Vec3(1, 1, 1), 0.1, 0.2, 100.0 * size);
    const auto box =
        test::add_shape(w, test::make_box_set(size * Vec3(1, 0.8, 0.3), 0.05 * size, 0.1 * size));
    add_floe(w.scene, box, 900.0, Vec3::Zero(), Quaternion::Identity(), 0, false);
    add_floe(w.scene, box, 900.0, place, turn, 0, false);
    return w;
}

OverlapFound measure(const World& w, const std::vector<Contact>& contacts = {}) {
    return measure_overlaps(w.scene, contacts);
}

}  // namespace

TEST_CASE("a deep overlap opens at half a radius in a tenth of a second, at any scale and step",
          "[overlaps]") {
    const double size = GENERATE(0.1, 1.0, 10.0), dt = GENERATE(0.02, 0.01, 0.0025);
    const double radius = 0.05 * size;
    World w = two_floes(size, dt, Vec3(size - 1.9 * radius, 0, 0));
    const auto apart = [&] {
        return w.scene.bodies.position[2].x() - w.scene.bodies.position[1].x();
    };
    const double before = apart();
    while (w.time < 0.1 - 0.5 * dt) step(w);
    CAPTURE(size, dt);
    // as far as ten sweeps over the contacts of a face settle
    CHECK((apart() - before) / radius == Near(0.5).epsilon(1e-3));
    // from half a radius on the rest goes as exp(-t / 0.1 s): what is tolerated is left after 2 s
    while (w.time < 2.0) step(w);
    CHECK(size - apart() == Near(kToleratedOverlap * radius).epsilon(0.05));
}

TEST_CASE("solids in each other are measured exactly where they are convex, seen or not",
          "[overlaps]") {
    // no contact of a finder is asked for: any depth counts
    const double depth = GENERATE(0.003, 0.06, 0.15, 0.3);
    const World w = two_floes(1.0, 0.01, Vec3(1.0 - depth, 0.1, 0.05));
    const OverlapFound found = measure(w);
    // no deeper than half of what the floes share: from there the other faces are nearer
    const double expected = std::min(depth, 0.125);
    CAPTURE(depth);
    CHECK(found.deepest == Near(expected).margin(depth < 0.1 ? 1e-12 : 0.05));
    REQUIRE(found.unseen.size() == 1);
    CHECK(found.unseen[0].depth == found.deepest);
    CHECK(std::pair(found.unseen[0].a, found.unseen[0].b) == std::pair(1, 2));
}

TEST_CASE("what contacts know of an overlap is not unseen, and crushed ice is no overlap",
          "[overlaps]") {
    World w = two_floes(1.0, 0.01, Vec3(1.0 - 0.06, 0, 0));
    Contact contact{};
    contact.point = contact.normal = Vec3::Zero();
    contact.a = 1;
    contact.b = 2;
    contact.gap = -0.05;
    REQUIRE(measure(w, {contact}).unseen.size() == 1);
    CHECK(measure(w, {contact}).unseen[0].depth == Near(0.01).margin(1e-12));
    contact.gap = -0.061;
    CHECK(measure(w, {contact}).unseen.empty());
    const Shape& shape = w.scene.shapes[1];
    for (std::size_t k = 0; k < shape.center.size(); ++k)
        if (shape.normal[k].x() > 0.5)  // of the first floe's face towards the second
            w.scene.crushed.crush(1, static_cast<std::int32_t>(k), shape.center.size(),
                                  Vec3(-0.05, 0, 0));
    CHECK(measure(w).deepest == Near(0.01).margin(1e-6));
}

TEST_CASE("floes side by side and corner to corner are in nobody", "[overlaps]") {
    CHECK(measure(two_floes(1.0, 0.01, Vec3(1.0, 0, 0))).deepest == Near(0.0).margin(1e-12));
    const Quaternion turn(Eigen::AngleAxisd(0.7, Vec3(0.2, 0.3, 1).normalized()));
    CHECK(measure(two_floes(1.0, 0.01, Vec3(1.25, 0.3, 0.1), turn)).deepest == 0.0);
    // the hull is of no convex shape here: a floe inside it is found by winding number and seats
    World w = two_floes(1.0, 0.01, Vec3(5, 0, 0));
    CHECK(measure(w).deepest == 0.0);
    w.scene.bodies.position[1] = w.scene.bodies.position[0] + Vec3(0.95, 0, 0);
    CHECK(measure(w).deepest == Near(0.05).margin(0.01));
}

TEST_CASE("the part of a hull that no sphere stands for is measured in the belt", "[overlaps]") {
    // spheres of a box of 2 x 1 x 0.6 m in the mesh of one that is `more` longer ahead
    const double more = GENERATE(0.0, 0.05, 0.4), spacing = 0.1;
    SphereSet set = test::make_box_set(Vec3(2, 1, 0.6), 0.05, spacing);
    for (Vec3& v : set.mesh.vertices)
        if (v.x() > 0.0) v.x() += more;
    Scene scene = make_scene(build_shape(set, false), Vec3(0, 0, 1), Vec3::Zero());
    const UnfeltHull found = measure_unfelt_hull(scene, 0.8, 1.2);
    // the belt of 0.4 m: two sides and two ends, without deck and bottom
    CHECK(found.area == Near(0.4 * (2.0 * (2.0 + more) + 2.0)).epsilon(0.05));
    const double unfelt = more > spacing ? 0.4 * (2.0 * (more - spacing) + 1.0) : 0.0;
    CAPTURE(more, found.share * found.area);
    // points are half a spacing apart, on two sides
    CHECK(found.share * found.area == Near(unfelt).margin(0.4 * 2.0 * 0.75 * spacing));
    if (more <= spacing) CHECK(found.share == 0.0);
    if (more > spacing) CHECK(found.distance == Near(more).epsilon(0.2));
}
