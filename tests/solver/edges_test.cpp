// SPDX-License-Identifier: GPL-3.0-or-later
// Gaps and normals where edges and corners of boxes meet.
#include <catch2/catch.hpp>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <random>

#include "common/base/units.hpp"
#include "solver/narrow/feature/measure_gap.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

constexpr double kRadius = 0.05;  // [m]
// lengths of the order of a metre are rounded to 1e-16, and a few of them are added
constexpr double kRounding = 1e-14;
const Vec3 kX = Vec3::UnitX(), kY = Vec3::UnitY(), kZ = Vec3::UnitZ();

// The sphere of radius r tangent to the faces, at right angles, that meet at the point `tip`: an
// edge of two, a corner of three.
Feature tip_sphere(const Vec3& tip, std::initializer_list<Vec3> normals, double r = kRadius) {
    Feature s{tip, r, Vec3::Zero(), 0.0, 0.0};
    for (const Vec3& n : normals) {
        s.center -= r * n;
        s.normal += n;
    }
    s.cone = NormalCone::meeting(normals);
    s.normal.normalize();
    s.spread_cos = 1.0 / std::sqrt(static_cast<double>(s.cone.count));
    s.spread_sin = std::sqrt(1.0 - s.spread_cos * s.spread_cos);
    s.cone.apex_distance = r / s.spread_cos;
    return s;
}

Feature face_sphere(const Vec3& on_face, const Vec3& normal, double r = kRadius) {
    return {on_face - r * normal, r, normal, 1.0, 0.0};
}

Feature turned(Feature s, const Mat3& turn) {
    s.center = turn * s.center;
    s.normal = turn * s.normal;
    s.cone = s.cone.turned(turn);
    return s;
}

Mat3 some_turn(unsigned seed) {
    if (seed == 0) return Mat3::Identity();
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    Eigen::Vector4d q;
    for (double& x : q) x = unit(random);
    return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
}

// Asserts normal and gap, whichever of the two comes first and is preferred, and however both are
// turned together.
void check_gap(const Feature& a, const Feature& b, const Vec3& normal, double gap) {
    for (const unsigned seed : {0u, 1u, 2u})
        for (const bool prefer_reference_a : {false, true}) {
            const Mat3 turn = some_turn(seed);
            const Gap forth =
                measure_gap_surface(turned(a, turn), turned(b, turn), prefer_reference_a);
            const Gap back =
                measure_gap_surface(turned(b, turn), turned(a, turn), prefer_reference_a);
            CAPTURE(seed, prefer_reference_a);
            REQUIRE(forth.valid);
            REQUIRE(back.valid);
            CHECK((forth.normal - turn * normal).norm() < tolerance(kRounding));
            CHECK((back.normal + turn * normal).norm() < tolerance(kRounding));
            CHECK(forth.gap == Near(gap).margin(kRounding));
            CHECK(back.gap == Near(gap).margin(kRounding));
            const auto beside_sq = [](const Gap& g) {
                return std::max(g.reference_offset_sq, g.incident_offset_sq);
            };
            CHECK(beside_sq(forth) == Near(beside_sq(back)).margin(kRounding));
        }
}

void check_refused(const Feature& a, const Feature& b) {
    for (const unsigned seed : {0u, 1u, 2u})
        for (const bool prefer_reference_a : {false, true}) {
            const Mat3 turn = some_turn(seed);
            CHECK_FALSE(
                measure_gap_surface(turned(a, turn), turned(b, turn), prefer_reference_a).valid);
            CHECK_FALSE(
                measure_gap_surface(turned(b, turn), turned(a, turn), prefer_reference_a).valid);
        }
}

}  // namespace

TEST_CASE("a corner inside a face is as deep as it is, however near the face's own corner",
          "[narrow][edges][analytic]") {
    // all of a's face within 0.1 m of its corner is behind b's leaning face somewhere, though a's
    // corner and its edges are before it
    const double depth = 0.004;
    const double y = GENERATE(0.02, 0.05, 0.061, 0.075), z = GENERATE(0.02, 0.049, 0.075);
    CAPTURE(y, z);
    const Mat3 lean =
        (Eigen::AngleAxisd(11.0 * kDegree, kY) * Eigen::AngleAxisd(-10.0 * kDegree, kZ))
            .toRotationMatrix();
    const Feature a = tip_sphere(Vec3::Zero(), {kX, kY, kZ});
    Feature b = turned(tip_sphere(Vec3::Zero(), {-kX, -kY, -kZ}), lean);
    b.center += Vec3(-depth, -y, -z);
    for (const bool prefer_reference_a : {false, true}) {
        const Gap found = measure_gap_surface(a, b, prefer_reference_a);
        REQUIRE(found.valid);
        CHECK((found.normal - kX).norm() < tolerance(kRounding));
        CHECK(found.gap == Near(-depth).margin(kRounding));
        CHECK(measure_gap_surface(b, a, prefer_reference_a).gap == Near(-depth).margin(kRounding));
    }
}

TEST_CASE("edges of boxes side by side have the faces' normal and distance at any height",
          "[narrow][edges][analytic]") {
    const double gap = GENERATE(0.004, 0.0, -0.004);
    const double height = GENERATE(-0.08, -0.04, -0.001, 0.0, 0.001, 0.04, 0.08);
    const double aside = GENERATE(0.0, 0.03);
    CAPTURE(gap, height, aside);
    const Feature left = tip_sphere(Vec3::Zero(), {kX, kZ});
    const Feature right = tip_sphere(Vec3(gap, aside, height), {-kX, kZ});
    check_gap(left, right, kX, gap);
    // the lower edge lies on the other box's side, whose sphere stands for it from its centre up
    const Gap found = measure_gap_surface(left, right, false);
    const double beyond = std::max(0.0, std::abs(height) - kRadius);
    CHECK(found.reference_is_a == (height <= 0.0));
    CHECK(found.reference_offset_sq == Near(aside * aside + beyond * beyond).margin(kRounding));
    CHECK_FALSE(found.crossing);
}

TEST_CASE("an edge beside a corner, and a corner beside a corner, have the faces' normal, too",
          "[narrow][edges][analytic]") {
    const double gap = GENERATE(0.004, -0.004);
    const double height = GENERATE(-0.04, 0.0, 0.04);
    const Vec3 at(gap, 0.01, height);
    const Feature edge = tip_sphere(Vec3::Zero(), {kX, kZ});
    const Feature corner = tip_sphere(Vec3::Zero(), {kX, kZ, kY});
    CAPTURE(gap, height);
    check_gap(edge, tip_sphere(at, {-kX, kZ, kY}), kX, gap);
    check_gap(edge, tip_sphere(at, {-kX, kZ, -kY}, 0.03), kX, gap);
    check_gap(corner, tip_sphere(at, {-kX, kZ, kY}), kX, gap);
}

TEST_CASE("an edge above an edge has the vertical for its normal", "[narrow][edges][analytic]") {
    const double gap = GENERATE(0.004, -0.004);
    CAPTURE(gap);
    const Feature below = tip_sphere(Vec3::Zero(), {kX, kZ});
    // boxes that lie on each other by 2 cm; the other one beyond or back over the first
    check_gap(below, tip_sphere(Vec3(-0.02, 0.01, gap), {-kX, -kZ}), kZ, gap);
    check_gap(below, tip_sphere(Vec3(-0.02, 0.01, gap), {kX, -kZ}), kZ, gap);
    check_gap(below, tip_sphere(Vec3(-0.02, 0.01, gap), {-kX, kY, -kZ}), kZ, gap);
}

TEST_CASE("a corner's edges cross another body's edge as any edge does",
          "[narrow][edges][analytic]") {
    // A ridge, down by 20 degrees along x, meets the upper edge, along y, of a box's corner at the
    // origin: the box is below, behind and to starboard of it (x <= 0, y <= 0, z <= 0).
    const double gap = GENERATE(0.004, -0.004);
    const double beside = GENERATE(0.04, -0.02);  // from the corner to the crossing; -: beyond it
    const Feature corner = tip_sphere(Vec3::Zero(), {kX, kY, kZ});
    const Mat3 turn = Eigen::AngleAxisd(20.0 * kDegree, kY).toRotationMatrix();
    const Vec3 n = turn * kZ, along = turn * kX;
    const double s = std::sqrt(0.5);
    const Feature ridge = tip_sphere(Vec3(0, -beside, 0) + gap * n + 0.03 * along,
                                     {turn * Vec3(0, s, -s), turn * Vec3(0, -s, -s)});
    const Gap found = measure_gap_surface(corner, ridge, false);
    CAPTURE(gap, beside);
    if (beside > 0.0) {
        REQUIRE(found.valid);
        CHECK(found.crossing);
        CHECK((found.normal - n).norm() < tolerance(kRounding));
        CHECK(found.gap == Near(gap).margin(kRounding));
        // the corner's edge to where they cross, and the ridge's
        const double corner_sq =
            found.reference_is_a ? found.reference_offset_sq : found.incident_offset_sq;
        const double ridge_sq =
            found.reference_is_a ? found.incident_offset_sq : found.reference_offset_sq;
        CHECK(corner_sq == Near(beside * beside).epsilon(1e-12));
        CHECK(ridge_sq == Near(0.03 * 0.03).epsilon(1e-12));
    } else {
        // beyond the corner there is no edge to cross
        CHECK_FALSE((found.valid && found.crossing));
    }
}

TEST_CASE("an edge on a face's corner, between two of its spheres, crosses the face's edges",
          "[narrow][edges][analytic]") {
    // A box's corner points down, 3 cm below an edge along y that presses on its side from -x: the
    // edge lies on the side from y = -3 to 3 cm. Its sphere is at y = -9 cm, beyond reach of it.
    const double gap = GENERATE(0.002, 0.0, -0.002);
    Feature corner =
        tip_sphere(Vec3(gap, 0, -0.03), {-kX, (kY - kZ).normalized(), (-kY - kZ).normalized()});
    Feature edge = tip_sphere(-0.09 * kY, {kX, -kZ});
    edge.patch_radius = corner.patch_radius = 0.075;
    CAPTURE(gap);
    check_gap(edge, corner, kX, gap);
    const Gap found = measure_gap_surface(edge, corner, true);
    CHECK(found.crossing);
    // the nearer of the two crossings, the other one is next to other spheres
    CHECK((found.reference_is_a ? found.reference_offset_sq : found.incident_offset_sq) ==
          Near(0.06 * 0.06));
    CHECK((found.reference_is_a ? found.incident_offset_sq : found.reference_offset_sq) ==
          Near(2 * 0.03 * 0.03));
    // where the corner is over all that the edge's sphere stands for it is the incident one
    edge.patch_radius = corner.patch_radius = 0.1;
    CHECK_FALSE(measure_gap_surface(edge, corner, true).crossing);
}

TEST_CASE("an edge that leans a little on a face is met where it crosses the face's side plane",
          "[narrow][edges][analytic]") {
    // Lower edges of two boxes cross at the origin, at 10 degrees, the second box tilted so that
    // its lower edge is foremost. The spheres are 5 cm from there, where the second edge is over
    // the first one's side, farther off by the lean.
    const double gap = GENERATE(0.002, 0.0, -0.002);
    const double lean = GENERATE(0.015, 0.005);
    CAPTURE(gap, lean);
    const Mat3 turn = (Eigen::AngleAxisd(-lean, kZ) * Eigen::AngleAxisd(10.0 * kDegree, kX) *
                       Eigen::AngleAxisd(10.0 * kDegree, kY))
                          .toRotationMatrix();
    const Vec3 line = turn * kY;
    Vec3 n = kY.cross(line).normalized();
    if (n.x() < 0.0) n = -n;
    Feature a = tip_sphere(-0.05 * kY, {kX, -kZ});
    Feature b = tip_sphere(gap * n + 0.05 * line, {turn * -kX, turn * -kZ});
    a.patch_radius = b.patch_radius = 0.075;
    check_gap(a, b, n, gap);
    CHECK(measure_gap_surface(a, b, true).crossing);
}

TEST_CASE("a corner behind one face and clear of another is not inside", "[narrow][edges]") {
    // a hull's edge between its side and a ramp, and the upper corner of a floe under the ramp that
    // heels by 5 degrees: 8 mm below the ramp's plane, 0.1 m inside the side's
    const Vec3 side = kY, ramp = -kZ;
    const Feature edge = tip_sphere(Vec3::Zero(), {side, ramp}, 0.1);
    const double heel = 5.0 * kDegree;
    const Mat3 turn = Eigen::AngleAxisd(heel, -kX).toRotationMatrix();
    const Feature corner = turned(tip_sphere(Vec3::Zero(), {turn.transpose() * kX, kY, kZ}), turn);
    Feature placed = corner;
    placed.center += Vec3(0.01, -0.1, -0.008);
    const Gap found = measure_gap_surface(edge, placed, true);
    CHECK_FALSE((found.valid && found.gap < -0.05));
}

TEST_CASE("of two faces that an edge is behind, the nearer one is the contact's",
          "[narrow][edges][analytic]") {
    // the other box is `in` m inside the first one's side and `down` m inside its top
    const Feature a = tip_sphere(Vec3::Zero(), {kX, kZ});
    check_gap(a, tip_sphere(Vec3(-0.02, 0, -0.01), {-kX, -kZ}), kZ, -0.01);
    check_gap(a, tip_sphere(Vec3(-0.01, 0, -0.02), {-kX, -kZ}), kX, -0.01);
}

TEST_CASE("crossed edges meet across both, with the distance of the two lines",
          "[narrow][edges][analytic]") {
    const double gap = GENERATE(0.004, 0.0, -0.004);
    const double angle = kDegree * GENERATE(30.0, 60.0, 90.0, 150.0);
    const double along_a = GENERATE(0.0, 0.02), along_b = GENERATE(0.0, -0.03);
    CAPTURE(gap, angle / kDegree, along_a, along_b);
    // a ridge along y, and a keel along a line turned by `angle` from it
    const Feature ridge =
        tip_sphere(along_a * kY, {(kX + kZ).normalized(), (kZ - kX).normalized()});
    const Vec3 line(-std::sin(angle), std::cos(angle), 0.0), across = line.cross(kZ);
    const Feature keel = tip_sphere(gap * kZ + along_b * line,
                                    {(across - kZ).normalized(), (-across - kZ).normalized()});
    check_gap(ridge, keel, kZ, gap);
    const Gap found = measure_gap_surface(ridge, keel, false);
    CHECK(found.crossing);
    const double a_sq = found.reference_is_a ? found.reference_offset_sq : found.incident_offset_sq;
    const double b_sq = found.reference_is_a ? found.incident_offset_sq : found.reference_offset_sq;
    CHECK(a_sq == Near(along_a * along_a).margin(kRounding));
    CHECK(b_sq == Near(along_b * along_b).margin(kRounding));
}

TEST_CASE("crossed edges that both slope meet along the common perpendicular of their lines",
          "[narrow][edges][analytic]") {
    const double gap = GENERATE(0.004, -0.004);
    const double slope = kDegree * GENERATE(10.0, 25.0);
    const Vec3 line_a(0, std::cos(slope), std::sin(slope)),
        line_b(std::cos(slope), 0, -std::sin(slope));
    Vec3 n = line_a.cross(line_b).normalized();
    if (n.z() < 0.0) n = -n;
    // roofs that are upright as seen along n: their faces at 45 degrees to it
    const Vec3 side_a = line_a.cross(n), side_b = line_b.cross(n);
    const Feature a =
        tip_sphere(0.01 * line_a, {(n + side_a).normalized(), (n - side_a).normalized()});
    const Feature b = tip_sphere(gap * n - 0.02 * line_b,
                                 {(side_b - n).normalized(), (-side_b - n).normalized()});
    check_gap(a, b, n, gap);
}

TEST_CASE("a corner over a face has the face's normal and the corner's height",
          "[narrow][edges][analytic]") {
    const double gap = GENERATE(0.004, 0.0, -0.004);
    const double tilt = kDegree * GENERATE(1.0, 20.0, 50.0);
    const double heading = kDegree * GENERATE(0.0, 40.0);
    CAPTURE(gap, tilt / kDegree, heading / kDegree);
    // a cube that was upright, tilted about the line x = y, so that its corner points down
    const Mat3 turn =
        (Eigen::AngleAxisd(heading, kZ) * Eigen::AngleAxisd(tilt, Vec3(1, -1, 0).normalized()))
            .toRotationMatrix();
    const Vec3 at(0.02, 0.01, gap);
    const Feature floor = face_sphere(Vec3::Zero(), kZ, 0.1);
    const Feature corner = tip_sphere(at, {turn * -kX, turn * -kY, turn * -kZ});
    // the corner is the cube's lowest point where all three of its faces look down
    REQUIRE(std::max({(turn * -kX).z(), (turn * -kY).z(), (turn * -kZ).z()}) < 0.0);
    check_gap(floor, corner, kZ, gap);
    const Gap found = measure_gap_surface(floor, corner, false);
    CHECK(found.reference_is_a);
    CHECK_FALSE(measure_gap_surface(corner, floor, false).reference_is_a);
    CHECK(found.reference_offset_sq == Near(at.x() * at.x() + at.y() * at.y()).margin(kRounding));
    // an edge that slopes over the face as the cube does
    check_gap(floor, tip_sphere(at, {turn * -kX, turn * -kZ}), kZ, gap);
}

TEST_CASE("a corner that looks away from a face is not what touches it", "[narrow][edges]") {
    const Feature floor = face_sphere(Vec3::Zero(), kZ, 0.1);
    check_refused(floor, tip_sphere(Vec3(0, 0, 0.002), {kX, kY, kZ}));
    // the cube leans on the edge beside this corner: its x face looks up by 30 degrees
    const Mat3 turn = Eigen::AngleAxisd(30.0 * kDegree, kY).toRotationMatrix();
    const Feature higher = tip_sphere(Vec3(0, 0, 0.002), {turn * -kX, turn * -kY, turn * -kZ});
    REQUIRE((turn * -kX).z() > 0.4);
    check_refused(floor, higher);
}

TEST_CASE("a direction along an edge is none of its normals", "[narrow][edges]") {
    const Feature edge = tip_sphere(Vec3::Zero(), {kX, kZ});  // along y
    check_refused(face_sphere(Vec3(0, 0.004, -0.05), -kY), edge);
    check_refused(tip_sphere(Vec3(-0.05, 0.004, 0), {-kY, kZ}), edge);
    check_refused(tip_sphere(Vec3(-0.05, 0.004, 0), {-kY, kX}), edge);
}
