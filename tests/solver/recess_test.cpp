// SPDX-License-Identifier: GPL-3.0-or-later
// Whole contact spheres in a recess that their crushed neighbours' contacts have left.
//
// Tolerances: 1e-15 m is rounding of sums of lengths of 0.01 m.
#include "solver/contact/recess.hpp"

#include <catch2/catch.hpp>

#include "solver/contact/overlaps.hpp"
#include "solver/scene/build_scene.hpp"
#include "tests/support/make_sphere_sets.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

constexpr double kDt = 0.01;      // [s]
constexpr double kRadius = 0.05;  // [m]
constexpr double kSlack = kToleratedOverlap * kRadius;
constexpr std::int32_t kSphere = 7;

// A floe of 1 x 1 x 0.4 m, turned about z, below a plate; kSphere has a neighbour 30 mm deep.
struct Floe {
    World w = test::plate_world(test::empty_space(kDt), Vec3(4, 4, 0.4), 0.1, 0.2, 0.0);
    ContactLaw law;
    std::vector<Contact> contacts;
    std::vector<Constraint> constraints;
    Recess recess;

    Floe() {
        const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 1, 0.4), kRadius, 0.1));
        add_floe(w.scene, box, 900.0, Vec3(0, 0, -0.19),
                 Quaternion(Eigen::AngleAxisd(0.5, Vec3::UnitZ())), 0, false);
        law.crushing_pressure = 1e6;
        crush_beside(kSphere, 0.0, 0.03);
    }
    // Crushes the sphere that is nearest to another one, but farther from it than `from` [m].
    void crush_beside(std::int32_t sphere, double from, double depth) {
        const auto& centre = w.scene.shapes[1].center;
        std::int32_t nearest = -1;
        const auto distance = [&](std::int32_t k) { return (centre[k] - centre[sphere]).norm(); };
        for (std::int32_t k = 0; k < std::ssize(centre); ++k)
            if (distance(k) > from && (nearest < 0 || distance(k) < distance(nearest))) nearest = k;
        w.scene.crushed.crush(1, nearest, centre.size(), Vec3(0, 0, -depth));
    }
    // The contacts of a step: their depths [m], along -z from the plate into the floe.
    void meet(std::initializer_list<double> depths, double approach = 0.0) {
        contacts.assign(depths.size(), {});
        constraints.clear();
        constraints.resize(depths.size());
        std::size_t k = 0;
        for (const double depth : depths) {
            Contact& c = contacts[k];
            c.a = 0;
            c.b = 1;
            c.sphere_b = kSphere + static_cast<std::int32_t>(k);
            c.normal = -Vec3::UnitZ();
            c.gap = -depth;
            constraints[k].a = c.a;
            constraints[k].b = c.b;
            constraints[k].gap = c.gap;
            constraints[k].approach = -approach;
            ++k;
        }
        recess.move_spheres(w.scene, law, kDt, contacts, constraints);
    }
    double moved() const { return -w.scene.crushed.displacement_of(1, kSphere).z(); }
};

}  // namespace

TEST_CASE("a contact that is deep at once is as deep as its neighbour's recess",
          "[contact][crushing][recess]") {
    Floe f;
    f.meet({0.0});
    const double depth = GENERATE(0.0005, 0.02, 0.05);
    f.meet({depth});
    // what the tolerance does not explain, but no more than the recess
    const double expected = std::clamp(depth - kSlack, 0.0, 0.03);
    CHECK(f.moved() == Near(expected).margin(1e-15));
    CHECK(f.contacts[0].gap == Near(expected - depth).margin(1e-15));
    CHECK(f.constraints[0].gap == f.contacts[0].gap);
    // the sphere moves inwards, and nowhere else
    CHECK(f.w.scene.crushed.displacement_of(1, kSphere).head<2>().norm() < tolerance(1e-15));
    // the search for contacts is told
    CHECK(f.w.scene.crushed.recent.size() == (expected > 0.0 ? 1U : 0U));
}

TEST_CASE("an overlap that the pair had, or came into within the step, stays",
          "[contact][crushing][recess]") {
    Floe f;
    f.meet({0.004, 0.015});
    f.meet({0.018, 0.0});
    CHECK(f.moved() == Near(0.018 - 0.015 - kSlack).margin(1e-15));
    Floe g;
    g.meet({0.0});
    g.meet({0.02}, 1.5);
    CHECK(g.moved() == Near(0.02 - 1.5 * kDt - kSlack).margin(1e-15));
    // bodies that part explain nothing
    Floe h;
    h.meet({0.0});
    h.meet({0.02}, -1.5);
    CHECK(h.moved() == Near(0.02 - kSlack).margin(1e-15));
}

TEST_CASE("only neighbours have a common recess, and it is as deep as the deepest of them",
          "[contact][crushing][recess]") {
    Floe f;
    // far off, and deeper
    f.crush_beside(kSphere, 0.5, 0.2);
    f.meet({0.0});
    f.meet({0.05});
    CHECK(f.moved() == Near(0.03).margin(1e-15));
    // it lies as deep as its neighbour now
    f.meet({0.0});
    f.meet({0.05});
    CHECK(f.moved() == Near(0.03).margin(1e-15));
}

TEST_CASE("no recess: rigid ice, whole ice, and a first step whose past is not known",
          "[contact][crushing][recess]") {
    Floe first;
    first.meet({0.02});
    CHECK(first.moved() == 0.0);
    Floe rigid;
    rigid.law.crushing_pressure = std::numeric_limits<double>::infinity();
    rigid.meet({0.0});
    rigid.meet({0.02});
    CHECK(rigid.moved() == 0.0);
    Floe whole;
    whole.w.scene.crushed = {};
    whole.meet({0.0});
    whole.meet({0.02});
    CHECK(whole.moved() == 0.0);
    CHECK(whole.contacts[0].gap == -0.02);
}

TEST_CASE("between floes the incident one has the recess", "[contact][crushing][recess]") {
    Floe f;
    add_floe(f.w.scene, 1, 900.0, Vec3(0, 0, -0.59), Quaternion::Identity(), 0, false);
    f.crush_beside(kSphere, 0.0, -0.06);  // 30 mm deep in the floe's lower face
    f.meet({0.0});
    f.contacts[0].a = f.constraints[0].a = 1;
    f.contacts[0].b = f.constraints[0].b = 2;
    f.contacts[0].crushes_a = true;
    f.contacts[0].sphere_a = kSphere;
    f.contacts[0].gap = f.constraints[0].gap = -0.02;
    f.recess.move_spheres(f.w.scene, f.law, kDt, f.contacts, f.constraints);
    // against the normal, which leads from a to b
    CHECK(f.w.scene.crushed.displacement_of(1, kSphere).z() == Near(0.02 - kSlack).margin(1e-15));
    CHECK(f.w.scene.crushed.is_whole(2));
}

TEST_CASE("the order of the contacts does not matter, and a recess does not run on within a step",
          "[contact][crushing][recess]") {
    // three spheres in a row, of which only the first has a crushed neighbour
    Floe f, g;
    const Shape& shape = f.w.scene.shapes[1];
    const auto apart = [&](std::int32_t k, std::int32_t l) {
        return (shape.center[k] - shape.center[l]).norm() > 2.0 * shape.patch_radius;
    };
    std::int32_t crushed = 0, far = -1;
    for (std::int32_t k = 0; k < std::ssize(shape.center); ++k)
        if (!f.w.scene.crushed.displacement_of(1, k).isZero()) crushed = k;
    for (std::int32_t k = 0; k < std::ssize(shape.center) && far < 0; ++k)
        if (apart(k, crushed) && !apart(k, kSphere)) far = k;
    REQUIRE(far >= 0);
    const auto meet = [&](Floe& floe, std::int32_t first, std::int32_t second) {
        floe.meet({0.0, 0.0});
        for (std::size_t k = 0; k < 2; ++k) {
            floe.contacts[k].sphere_b = k == 0 ? first : second;
            floe.contacts[k].gap = floe.constraints[k].gap = -0.02;
        }
        floe.recess.move_spheres(floe.w.scene, floe.law, kDt, floe.contacts, floe.constraints);
    };
    meet(f, kSphere, far);
    meet(g, far, kSphere);
    CHECK(f.moved() == Near(0.02 - kSlack).margin(1e-15));
    CHECK(g.moved() == f.moved());
    CHECK(f.w.scene.crushed.displacement_of(1, far).isZero());
    CHECK(g.w.scene.crushed.displacement_of(1, far).isZero());
}

TEST_CASE("a sphere of two contacts moves once, and both are less deep",
          "[contact][crushing][recess]") {
    Floe f;
    f.meet({0.0, 0.0});
    for (Contact& c : f.contacts) c.sphere_b = kSphere;
    for (std::size_t k = 0; k < 2; ++k)
        f.contacts[k].gap = f.constraints[k].gap = k == 0 ? -0.02 : -0.015;
    f.recess.move_spheres(f.w.scene, f.law, kDt, f.contacts, f.constraints);
    CHECK(f.moved() == Near(0.02 - kSlack).margin(1e-15));
    CHECK(f.contacts[0].gap == Near(-kSlack).margin(1e-15));
    CHECK(f.contacts[1].gap == Near(0.005 - kSlack).margin(1e-15));
    CHECK(f.constraints[1].gap == f.contacts[1].gap);
}

TEST_CASE("contacts of a body that has another shape now have no past for one step",
          "[contact][crushing][recess]") {
    Floe f;
    f.meet({0.0});
    f.recess.forget({1});
    f.meet({0.02});
    CHECK(f.moved() == 0.0);
    f.meet({0.045});
    CHECK(f.moved() == Near(0.025 - kSlack).margin(1e-15));
}
