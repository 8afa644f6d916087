// SPDX-License-Identifier: GPL-3.0-or-later
// Which region of the hull a contact is entered for.
#include "solver/shape/face_regions.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "common/base/units.hpp"
#include "solver/record/measure_step.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::tolerance;

namespace {

// a sum of a dozen contacts, divided by the step late or early
constexpr double kAreaRounding = 1e-14;
constexpr double kSphereRadius = 0.1, kSphereSpacing = 0.2;
constexpr std::int32_t kHull = 0, kBow = 1, kSide = 2;

// A box with a bow, x = 2, and sides, y = +-1. Spheres in edges of the bow count to the side.
SphereSet ship_set() {
    SphereSet set = test::make_box_set(Vec3(4, 2, 1), kSphereRadius, kSphereSpacing);
    set.mesh.region_names = {"hull", "bow", "side"};
    set.mesh.region = {kHull, kHull, kHull, kHull, kSide, kSide,
                       kSide, kSide, kHull, kHull, kBow,  kBow};
    for (std::size_t k = 0; k < set.surface_count; ++k) {
        const Vec3 c = set.centers[k].cwiseAbs();
        if (c.x() > 2.0 - 1.01 * kSphereRadius && set.centers[k].x() > 0.0) set.regions[k] = kBow;
        if (c.y() > 1.0 - 1.01 * kSphereRadius) set.regions[k] = kSide;
    }
    return set;
}

// The surface sphere nearest to a point.
std::int32_t sphere_at(const SphereSet& set, const Vec3& p) {
    std::size_t best = 0;
    for (std::size_t k = 0; k < set.surface_count; ++k)
        if ((set.centers[k] - p).norm() < (set.centers[best] - p).norm()) best = k;
    return static_cast<std::int32_t>(best);
}

Vec3 at_angle(double degrees) {
    return {std::cos(degrees * kDegree), std::sin(degrees * kDegree), 0.0};
}

// Mean force on the hull by region in one step in which a box of ice, at rest, meets the ship at 1
// m/s without friction.
struct Booked {
    Vec3 bow = Vec3::Zero(), side = Vec3::Zero(), rest = Vec3::Zero(), total = Vec3::Zero();
};
Booked push_floe(const Vec3& at, double yaw_degrees, const Vec3& velocity) {
    Case p = test::empty_space(0.01);
    p.contact.friction_ship_ice = 0.0;
    World w;
    w.parameters = p;
    w.scene = make_scene(build_shape(ship_set(), false), Vec3::Zero(), Vec3::Zero());
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    const Quaternion turn(Eigen::AngleAxisd(yaw_degrees * kDegree, Vec3::UnitZ()));
    const std::size_t i = add_floe(w.scene, box, 900.0, at, turn, 0, false);
    w.scene.bodies.momentum[i] = w.scene.bodies.mass[i] * velocity;
    update_derived(w.scene.bodies, i);
    step(w);
    const StepRecord r = measure_step(w.scene, w.contacts, w.constraints, p.time_step);
    Booked out;
    for (const RegionImpulse& on : r.regions)
        (on.region == kBow    ? out.bow
         : on.region == kSide ? out.side
                              : out.rest) += on.impulse / p.time_step;
    out.total = r.contact_force + r.friction_force;
    return out;
}

}  // namespace

TEST_CASE("a sphere in an edge has the region of the face whose normal is nearest",
          "[regions][analytic]") {
    const SphereSet set = ship_set();
    const FaceRegions regions(set);
    const std::int32_t shoulder = sphere_at(set, Vec3(2, 1, 0)), corner = sphere_at(set, {2, 1, 1});
    REQUIRE(set.regions[static_cast<std::size_t>(shoulder)] == kSide);
    for (const std::int32_t k : {shoulder, corner}) {
        CHECK(regions.at(k, Vec3::UnitX()) == kBow);
        CHECK(regions.at(k, Vec3::UnitY()) == kSide);
        CHECK(regions.at(k, at_angle(44.0)) == kBow);
        CHECK(regions.at(k, at_angle(46.0)) == kSide);
    }
    CHECK(regions.at(corner, Vec3::UnitZ()) == kHull);
    CHECK(regions.of_spheres() == set.regions);
}

TEST_CASE("a sphere on a face far from any border has one region, whatever touches it",
          "[regions]") {
    const SphereSet set = ship_set();
    const FaceRegions regions(set);
    for (const Vec3& n : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())}) {
        CHECK(regions.at(sphere_at(set, Vec3(0, 1, 0)), n) == kSide);
        CHECK(regions.at(sphere_at(set, Vec3(2, 0, 0)), n) == kBow);
        CHECK(regions.at(sphere_at(set, Vec3(0, 0, 1)), n) == kHull);
    }
}

TEST_CASE("the sphere at the end of an edge stands for the face beyond it, too", "[regions]") {
    // the last sphere of the upper edge of the side ends 2 cm before the bow, which none touches
    SphereSet set = ship_set();
    const auto k = static_cast<std::size_t>(sphere_at(set, Vec3(2, 1, 1)));
    set.centers[k].x() -= 0.02;
    set.normals[k] = Vec3(0, 1, 1).normalized();
    const FaceRegions regions(set);
    const auto end = static_cast<std::int32_t>(k);
    CHECK(regions.at(end, Vec3::UnitX()) == kBow);
    CHECK(regions.at(end, Vec3::UnitY()) == kSide);
}

TEST_CASE("where a border runs across a plane the nearer face counts", "[regions]") {
    // the two triangles of the upper face meet in its diagonal from (2, -1) to (-2, 1)
    SphereSet set = ship_set();
    set.mesh.region[2] = kBow;
    set.mesh.region[3] = kSide;
    const FaceRegions regions(set);
    for (const double y : {-0.4, 0.0, 0.4})
        for (const double beside : {-0.13, 0.13}) {
            const std::int32_t k = sphere_at(set, Vec3(-2.0 * y + beside, y, 0.5 - kSphereRadius));
            const Vec3& c = set.centers[static_cast<std::size_t>(k)];
            const double from_diagonal = c.x() + 2.0 * c.y();
            if (std::abs(from_diagonal) < 1e-9) continue;
            const bool first = from_diagonal < 0.0;
            CAPTURE(c.x(), c.y());
            CHECK(regions.at(k, Vec3::UnitZ()) == set.mesh.region[first ? 2 : 3]);
        }
}

TEST_CASE("ice on the shoulder pushes the bow along x and the side along y, and nothing else",
          "[regions][analytic]") {
    // flush: half of the piece's face lies on the bow, half beyond the side
    const Booked ahead = push_floe(Vec3(2.5, 1.0, 0), 0.0, Vec3(-1, 0, 0));
    CHECK(ahead.bow.x() < -1000.0);
    CHECK(ahead.side.x() == 0.0);
    CHECK((ahead.bow - ahead.total).norm() < tolerance(kAreaRounding) * ahead.total.norm());
    const Booked beside = push_floe(Vec3(2.0, 1.4, 0), 0.0, Vec3(0, -1, 0));
    CHECK(beside.side.y() < -1000.0);
    CHECK(beside.bow.y() == 0.0);
    CHECK((beside.side - beside.total).norm() < tolerance(kAreaRounding) * beside.total.norm());
}

TEST_CASE(
    "a face across the shoulder pushes the region whose normal is nearer, and all regions "
    "together feel the whole force",
    "[regions][analytic]") {
    // the middle of the piece's 0.8 m face lies on the edge, turned by `yaw` from the bow's plane
    const double yaw = GENERATE(30.0, 60.0);
    const Vec3 n = at_angle(yaw);
    const Booked b = push_floe(Vec3(2, 1, 0) + 0.5 * n, yaw, -n);
    const Vec3& nearer = yaw < 45.0 ? b.bow : b.side;
    CAPTURE(yaw);
    CHECK(-nearer.dot(n) > 1000.0);
    CHECK((nearer - b.total).norm() < tolerance(kAreaRounding) * b.total.norm());
    // the vertical shoulder is cut along its height, so that nothing pushes up or down
    CHECK((b.total - b.total.dot(n) * n).norm() < tolerance(kAreaRounding) * b.total.norm());
}
