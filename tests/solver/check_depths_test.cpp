// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts of a solid that is not convex, held to the meshes: a hull that is an angle seen from
// above, a square of 4 m without its quarter x, y > 0, and a box of 1.2 x 1 x 0.4 m as a floe.
//
// Tolerances: 1e-6 is a normal or a radius stored as a float, 1e-7 of it.
#include "solver/narrow/manifold/check_depths.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>
#include <random>

#include "solver/narrow/feature/deep_pair.hpp"
#include "solver/narrow/manifold/deep_seats.hpp"
#include "tests/support/make_angle_world.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

constexpr double kRadius = 0.05, kSlack = 0.1 * kRadius;

// The sphere nearest to `at` [m] among those where so many faces meet (0: on a face).
std::int32_t sphere_at(const Shape& shape, const Vec3& at, int faces) {
    std::int32_t best = -1;
    for (std::int32_t k = 0; k < std::ssize(shape.center); ++k)
        if (shape.cone[k].count == faces &&
            (best < 0 || (shape.center[k] - at).norm() < (shape.center[best] - at).norm()))
            best = k;
    REQUIRE(best >= 0);
    return best;
}

// What is left of a candidate.
std::vector<Candidate> checked(const World& w, const Candidate& candidate) {
    const PairView view(w.scene, {0, 1});
    REQUIRE(deep_slack(view) == Near(kSlack).epsilon(1e-6));
    std::vector<Candidate> out{candidate};
    check_depths(view, out);
    return out;
}

// The hull's face x = 2 meets the floe's face -x, or so it seems, at this gap [m].
Candidate face_on_face(const World& w, double gap) {
    const std::int32_t i = sphere_at(w.scene.shapes[0], Vec3(2.0 - kRadius, -1.0, 0.0), 0),
                       j = sphere_at(w.scene.shapes[1], Vec3(-0.6 + kRadius, 0.0, 0.0), 0);
    REQUIRE((w.scene.shapes[1].normal[j] + Vec3::UnitX()).norm() < tolerance(1e-6));
    return {i, j, {Vec3::UnitX(), gap, 0.0, true, true}};
}

// The deep seats of a pair without contacts, of all its seats.
std::vector<DeepSeat> deep_seats_of(const PairView& view) {
    std::vector<SpherePair> near;
    list_near_seats(view, -1.0, 0.0, near);
    std::vector<DeepSeat> out;
    find_deep_seats(view, near, {}, out);
    return out;
}

}  // namespace

TEST_CASE("a deep point in the other solid is as deep as its distance from that surface at most",
          "[narrow][deep][analytic]") {
    // 0.05 m over the face x = 2; the leg's other faces are 0.3 m away and more
    const World w = test::angle_and_box(kRadius, Vec3(2.0 + 0.6 - 0.05, -1.0, 0.0));
    const auto held = checked(w, face_on_face(w, -0.3));
    REQUIRE(held.size() == 1);
    CHECK(held[0].gap.gap == Near(-0.05).epsilon(1e-6));
    // a gap that is less deep is kept as it is
    CHECK(checked(w, face_on_face(w, -0.03)).at(0).gap.gap == -0.03);
}

TEST_CASE("in a notch of the other body a point is as deep as what is left of the ice",
          "[narrow][deep][notch][analytic]") {
    // the hull's face lies 0.05 m behind the floe's, which has been crushed by `depth`
    const double depth = GENERATE(0.02, 0.06);
    World w = test::angle_and_box(kRadius, Vec3(2.0 + 0.6 - 0.05, -1.0, 0.0));
    const Shape& floe = w.scene.shapes[1];
    for (std::int32_t k = 0; k < std::ssize(floe.center); ++k)
        if (floe.normal[k].x() < -0.99)
            w.scene.crushed.crush(1, k, floe.center.size(), Vec3(depth, 0, 0));
    Candidate candidate = face_on_face(w, -0.3);
    candidate.gap.reference_is_a = false;
    const auto held = checked(w, candidate);
    REQUIRE(held.size() == (depth > 0.05 ? 0 : 1));
    if (held.empty()) return;
    CHECK(held[0].gap.gap == Near(-0.03).epsilon(1e-6));
}

TEST_CASE("a tip outside of its own body is less deep by its distance from it",
          "[narrow][deep][analytic]") {
    // the floe's face is 0.05 m deep; the sphere's point is 0.04 m before it, 0.09 m deep
    World w = test::angle_and_box(kRadius, Vec3(2.0 + 0.6 - 0.05, -1.0, 0.0));
    const Candidate candidate = face_on_face(w, -0.3);
    w.scene.crushed.crush(1, candidate.j, w.scene.shapes[1].center.size(), Vec3(-0.04, 0, 0));
    const auto held = checked(w, candidate);
    REQUIRE(held.size() == 1);
    CHECK(held[0].gap.gap == Near(-0.05).epsilon(1e-6));
}

TEST_CASE("a point deep behind two planes and outside the solid is no contact",
          "[narrow][deep][analytic]") {
    // in the missing quarter: 1.7 m behind the plane x = 2 of one leg, 1.1 m behind y = 2
    const World w = test::angle_and_box(kRadius, Vec3(0.9, 0.9, 0.0));
    CHECK(checked(w, face_on_face(w, -1.7)).empty());
    // shallow ones are left to the rule of the features
    CHECK(checked(w, face_on_face(w, -0.9 * kSlack)).size() == 1);
}

TEST_CASE("edges that cross are a deep contact where the place between them lies in both solids",
          "[narrow][deep][analytic]") {
    // The floe's edge comes foremost, level and at 45 degrees over the hull's upright edge x = 2,
    // y = 0, at a depth of 0.05 m; `beside` moves it along itself: its half length is 0.5 m.
    const double beside = GENERATE(0.0, 0.4, 0.8, -0.8), depth = 0.05;
    const double eighth = 0.25 * std::numbers::pi;
    const Quaternion turn = Quaternion(Eigen::AngleAxisd(eighth, Vec3::UnitZ())) *
                            Quaternion(Eigen::AngleAxisd(-eighth, Vec3::UnitY()));
    const Vec3 outwards = Vec3(1, 1, 0).normalized(), along = Vec3(-1, 1, 0).normalized();
    const Vec3 edge(-0.6, 0.0, 0.2);
    const World w = test::angle_and_box(
        kRadius, Vec3(2.0, 0.0, 0.1) - depth * outwards + beside * along - turn * edge, turn);
    const Shape &hull = w.scene.shapes[0], &floe = w.scene.shapes[1];
    const std::int32_t i = sphere_at(hull, Vec3(2.0 - kRadius, -kRadius, 0.1), 2),
                       j = sphere_at(floe, edge + kRadius * Vec3(1, 0, -1), 2);
    REQUIRE(std::abs(hull.cone[i].edge(0).dot(Vec3::UnitZ())) > 1.0 - tolerance(1e-6));
    REQUIRE(std::abs(floe.cone[j].edge(0).dot(Vec3::UnitY())) > 1.0 - tolerance(1e-6));
    const auto held = checked(w, {i, j, {outwards, -depth, 0.0, true, true, true, 0, 0}});
    if (std::abs(beside) > 0.5) {
        CHECK(held.empty());
    } else {
        REQUIRE(held.size() == 1);
        // both edges are right-angled: the points on them bound the depth by itself
        CHECK(held[0].gap.gap == Near(-depth).epsilon(1e-6));
    }
}

TEST_CASE("a seat is as much less deep as the ice sphere is crushed that it presses on",
          "[narrow][deep][analytic]") {
    // Ice 0.12 m thin, its spheres 0.1 m apart and 0.05 m in radius: often one of the opposite side
    // is nearest to a seat.
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    constexpr double kCrushed = 0.02;
    std::size_t seats = 0;
    World empty = test::angle_and_box(kRadius, Vec3::Zero());
    const auto thin = test::add_shape(empty, test::fill_box(Vec3(0.12, 1, 0.4), kRadius, 0.1));
    for (int pose = 0; pose < 100; ++pose) {
        World w = empty;
        const Vec3 at(2.0 + 0.03 * unit(random), -1.0 + 0.3 * unit(random), 0.3 * unit(random));
        const Quaternion turn(1.0, 0.1 * unit(random), 0.1 * unit(random), 0.1 * unit(random));
        add_floe(w.scene, thin, 900.0, at, turn.normalized(), 0, false);
        const PairView view(w.scene, {0, 2});
        const std::vector<DeepSeat> found = deep_seats_of(view);
        const std::size_t spheres = view.shape_b.center.size();
        for (const DeepSeat& seat : found) {
            if (seat.of_b) continue;  // a seat of the ice moves with its sphere
            const Vec3 into = view.rotation_ab.transpose() * seat.normal;  // the ice, its axes
            w.scene.crushed = {};
            w.scene.crushed.crush(2, seat.facing, spheres, kCrushed * into);
            const std::vector<DeepSeat> again = deep_seats_of(view);
            const auto same = std::find_if(again.begin(), again.end(), [&](const DeepSeat& s) {
                return !s.of_b && s.sphere == seat.sphere;
            });
            // The seat may be too shallow now, or another seat is the deepest one and decides the
            // direction.
            if (same == again.end()) continue;
            ++seats;
            CAPTURE(pose, seat.sphere, seat.facing, seat.gap);
            CHECK(same->gap == Near(seat.gap + kCrushed).margin(1e-12));
        }
    }
    CHECK(seats > 500);
}

TEST_CASE("a seat in a notch has no contact, however near the ice's lower face",
          "[narrow][deep][analytic]") {
    // The face x = 2 of the hull's leg, z from -0.5 to 0.5, is 0.25 m deep in the side -x of the
    // box. The hull's top is 0.1 m above the box's lower face, which is the nearest face of all
    // seats near that edge.
    World w = test::angle_and_box(kRadius, Vec3(2.0 + 0.6 - 0.25, -1.0, 0.5 + 0.2 - 0.1));
    const PairView view(w.scene, {0, 1});
    std::vector<DeepSeat> seats = deep_seats_of(view);
    REQUIRE_FALSE(seats.empty());
    CHECK(std::all_of(seats.begin(), seats.end(), [](const DeepSeat& s) {
        return std::abs(s.normal.z()) > 1.0 - tolerance(1e-6);
    }));
    const double notch = GENERATE(0.3, 0.22);
    const std::size_t spheres = view.shape_b.center.size();
    for (std::size_t k = 0; k < spheres; ++k)
        if (view.shape_b.center[k].x() < -0.6 + 1.5 * kRadius)
            w.scene.crushed.crush(1, static_cast<std::int32_t>(k), spheres, {notch, 0, 0});
    seats = deep_seats_of(view);
    // The rest of 0.25 m is pressed against the bottom of the notch; seats in the hull's edges and
    // corners are R (1 - sqrt(1/2)) and R (1 - sqrt(1/3)) less deep.
    CHECK(seats.empty() == (notch > 0.25));
    for (const DeepSeat& s : seats) {
        CHECK(s.normal.x() == Near(1.0).epsilon(1e-6));
        CHECK(s.gap > notch - 0.25 - 1e-6 * kRadius);
        CHECK(s.gap < notch - 0.25 + 0.43 * kRadius);
    }
}

TEST_CASE("a list of near seats has all that lie deep while the bodies move within its skin",
          "[narrow][deep][property]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto some = [&] { return Vec3(unit(random), unit(random), unit(random)); };
    World w = test::angle_and_box(kRadius, Vec3::Zero());
    Bodies& b = w.scene.bodies;
    const auto set_pose = [&](const Vec3& at, const Quaternion& turn) {
        b.position[1] = at;
        b.orientation[1] = turn.normalized();
        b.rotation[1] = b.orientation[1].toRotationMatrix();
    };
    const double skin = GENERATE(0.02, 0.1, 0.3), reach = w.scene.shapes[1].bounding_radius;
    int deep = 0, clear = 0;
    for (int pose = 0; pose < 100; ++pose) {
        const Vec3 at = Vec3(2.0, -1.0, 0.0) + some().cwiseProduct(Vec3(1.0, 0.6, 0.4));
        const Vec3 turn = 0.3 * some();
        set_pose(at, Quaternion(1.0, turn.x(), turn.y(), turn.z()));
        std::vector<SpherePair> near;
        const double clearance = list_near_seats(PairView(w.scene, {0, 1}), -1.0, skin, near);
        REQUIRE(clearance <= skin);
        for (int move = 0; move < 10; ++move) {
            // The move is at most 0.39 skins. The quaternion (1, v) turns by 2 |v|, so the turn
            // moves the box by at most 0.31 skins.
            const double share = move / 10.0;
            const Vec3 more = share * 0.1 * skin / reach * some();
            set_pose(at + share * 0.25 * skin * some(),
                     Quaternion(1.0, more.x(), more.y(), more.z()) *
                         Quaternion(1.0, turn.x(), turn.y(), turn.z()).normalized());
            const PairView view(w.scene, {0, 1});
            const std::vector<DeepSeat> all = deep_seats_of(view);
            std::vector<DeepSeat> listed;
            find_deep_seats(view, near, {}, listed);
            REQUIRE(listed.size() == all.size());
            for (std::size_t k = 0; k < all.size(); ++k) {
                REQUIRE(listed[k].sphere == all[k].sphere);
                REQUIRE(listed[k].gap == all[k].gap);
            }
            deep += all.empty() ? 0 : 1;
            // in the first pose nothing has moved: the clearance tells whether a seat is deep
            if (move == 0) CHECK(all.empty() == (clearance > 0.0));
            clear += all.empty() ? 1 : 0;
        }
    }
    CHECK(deep > 50);
    CHECK(clear > 50);
}

TEST_CASE("of two convex solids every contact stays as it is", "[narrow][deep]") {
    World w;
    w.parameters = test::empty_space(0.01);
    w.scene = make_scene(build_shape(test::fill_box(Vec3(4, 4, 1), kRadius, 0.1), false),
                         Vec3::Zero(), Vec3::Zero());
    const auto box = test::add_shape(w, test::fill_box(Vec3(1.2, 1, 0.4), kRadius, 0.1));
    // beside the hull: with meshes asked, this would be none
    add_floe(w.scene, box, 900.0, Vec3(5, 0, 0), Quaternion::Identity(), 0, false);
    const auto held = checked(w, face_on_face(w, -0.3));
    REQUIRE(held.size() == 1);
    CHECK(held[0].gap.gap == -0.3);
}
