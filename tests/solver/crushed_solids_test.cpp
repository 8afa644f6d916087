// SPDX-License-Identifier: GPL-3.0-or-later
// Convex solids that are crushed: cuts and sections by hand, random cuts by their volumes, and
// floes that press on each other.
//
// Tolerances: 1e-12 and 1e-9 are rounding of volumes and areas of solids of a metre.
#include "solver/scene/crushed_solids.hpp"

#include <unistd.h>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "common/formats/checkpoint_file.hpp"
#include "solver/narrow/feature/contact_polygon.hpp"
#include "solver/narrow/feature/section_area.hpp"
#include "solver/record/solid_overlap.hpp"
#include "solver/shape/cut_solid.hpp"
#include "tests/support/make_prisms.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

ConvexPiece solid_box(const Vec3& size) { return make_convex_piece(test::make_box_mesh(size)); }

// A sixth of the sum of (corner x next) . first over the faces' triangles.
double volume_of(const ConvexPiece& piece) {
    double sum = 0.0;
    for (const std::vector<std::int32_t>& loop : piece.loops)
        for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
            const Vec3 a = piece.corners[static_cast<std::size_t>(loop[0])],
                       b = piece.corners[static_cast<std::size_t>(loop[k])],
                       c = piece.corners[static_cast<std::size_t>(loop[k + 1])];
            sum += a.dot(b.cross(c)) / 6.0;
        }
    return sum;
}

// Corners behind all planes, faces through their planes, edges between their planes.
void require_solid(const ConvexPiece& piece) {
    REQUIRE(!piece.empty());
    REQUIRE(piece.corners.size() + piece.plane_count() == piece.edges.size() + 2);
    for (std::size_t k = 0; k < piece.plane_count(); ++k) {
        for (std::size_t n = 0; n < piece.corners.size(); ++n)
            REQUIRE(piece.normals[k].dot(piece.corners[n]) <= piece.offsets[k] + 1e-9);
        for (const std::int32_t n : piece.loops[k])
            REQUIRE(piece.normals[k].dot(piece.corners[static_cast<std::size_t>(n)]) >=
                    piece.offsets[k] - 1e-5);  // the frusta's planes, of points a metre apart
    }
    for (std::size_t k = 0; k < piece.edges.size(); ++k) {
        const SolidEdge& e = piece.edges[k];
        const Vec3 along = Vec3(piece.normals[static_cast<std::size_t>(e.left)])
                               .cross(piece.normals[static_cast<std::size_t>(e.right)]);
        REQUIRE(along.dot(piece.edge_along[k]) > 0.0);
    }
}

RelativePose shifted(const Vec3& by) { return {Mat3::Identity(), by}; }

double section_of(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                  const Vec3& n, double reach = 0.0) {
    SectionWork work;
    return section_area(a, b, pose, n, reach, work);
}

// Lower floe 1, held, and upper floe 2 of the paper's size on it.
World floe_on_floe(double pressure, const Vec3& at, const Quaternion& turn) {
    Case p = test::empty_space(0.01);
    p.contact.crushing_pressure = pressure;
    p.contact.friction_ice_ice = 0.0;
    p.floes[0].hold = Hold::always;
    World w = test::plate_world(p, Vec3(4, 2, 1), 0.25, 0.5, 100.0);
    const auto plate = test::add_shape(w, test::make_box_set(Vec3(4, 4, 1), 0.25, 0.5));
    const auto floe = test::add_shape(w, test::make_box_set(test::kPaperFloe, 0.05, 0.1));
    add_floe(w.scene, plate, 900.0, Vec3(0, 0, -0.5), Quaternion::Identity(), 0, true);
    add_floe(w.scene, floe, 900.0, at, turn, 0, false);
    return w;
}

void push_down(World& w, double speed) {
    w.scene.bodies.momentum[2] = w.scene.bodies.mass[2] * Vec3(0, 0, -speed);
    update_derived(w.scene.bodies, 2);
}

}  // namespace

TEST_CASE("a plane cuts a box into the solid that geometry gives", "[shape][analytic]") {
    const ConvexPiece whole = solid_box(Vec3(2, 1, 0.6));
    const ConvexPiece shorter = cut_piece(whole, {Vec3::UnitX(), 0.3});
    require_solid(shorter);
    CHECK(shorter.plane_count() == 6);
    CHECK(shorter.corners.size() == 8);
    CHECK(volume_of(shorter) == Near(1.3 * 1.0 * 0.6).margin(1e-12));
    // an upper corner, by the plane at `depth` below it: a pyramid of 9/2 sqrt(3) depth^3 / 9
    const double depth = 0.2;
    const Vec3 n = Vec3(1, 1, 1).normalized();
    const ConvexPiece clipped = cut_piece(whole, {n, n.dot(Vec3(1, 0.5, 0.3)) - depth});
    require_solid(clipped);
    CHECK(clipped.plane_count() == 7);
    CHECK(clipped.corners.size() == 10);
    const double side = depth * std::numbers::sqrt3;  // along each of the three edges
    CHECK(volume_of(whole) - volume_of(clipped) == Near(side * side * side / 6.0).margin(1e-12));
}

TEST_CASE("a half-space that holds the whole solid, or nothing of it, cuts nothing",
          "[shape][analytic]") {
    const ConvexPiece whole = solid_box(Vec3(2, 1, 0.6));
    CHECK(cut_piece(whole, {Vec3::UnitX(), 1.0}).corners.size() == 8);
    CHECK(volume_of(cut_piece(whole, {Vec3::UnitX(), 1.0})) == volume_of(whole));
    CHECK(cut_piece(whole, {Vec3::UnitX(), -1.1}).empty());
    ConvexPiece solid = whole;
    CHECK_FALSE(crush_solid(solid, Vec3::UnitX(), Vec3(-1.1, 0, 0)));
    CHECK(volume_of(solid) == volume_of(whole));
    // a plane within 0.1 mm of corners keeps clear of them
    const ConvexPiece clear = cut_piece(whole, {Vec3::UnitX(), 1.0 - 5e-5});
    CHECK(volume_of(clear) == volume_of(whole));
}

TEST_CASE("the two parts of a solid on the sides of a plane are the solid", "[shape]") {
    test::Dice dice{std::mt19937(7)};
    int cut = 0;
    for (int k = 0; k < 2000; ++k) {
        const ConvexPiece whole = make_convex_piece(test::make_random_frustum(dice, 3 + k % 8));
        REQUIRE(!whole.empty());
        const Vec3 n = dice.vector().normalized();
        const double offset = 0.8 * dice.number();
        bool clear = true;  // of corners, which the plane would avoid
        for (std::size_t c = 0; c < whole.corners.size(); ++c)
            clear = clear && std::abs(n.dot(whole.corners[c]) - offset) > 2e-4;
        if (!clear) continue;
        const ConvexPiece below = cut_piece(whole, {n, offset}),
                          above = cut_piece(whole, {-n, -offset});
        if (below.empty() || above.empty()) {
            CHECK(volume_of(below.empty() ? above : below) == volume_of(whole));
            continue;
        }
        require_solid(below);
        require_solid(above);
        CHECK(volume_of(below) + volume_of(above) == Near(volume_of(whole)).margin(1e-9));
        CHECK(slice_area(whole, n, offset) ==
              Near(section_of(below, above, shifted(Vec3::Zero()), n, 1e-9)).margin(1e-6));
        ++cut;
    }
    CHECK(cut > 1000);
}

TEST_CASE("a solid that is crushed a thousand times stays one, and never grows", "[shape]") {
    test::Dice dice{std::mt19937(11)};
    for (int body = 0; body < 20; ++body) {
        ConvexPiece solid = make_convex_piece(test::make_random_frustum(dice, 4 + body % 5));
        double volume = volume_of(solid);
        const double whole = volume;
        Vec3 n = dice.vector().normalized();
        for (int k = 0; k < 1000; ++k) {
            // as a floe that turns against another one: by small angles, now and then from
            // elsewhere
            n = (k % 100 == 0 ? dice.vector() : Vec3(n + 0.01 * dice.vector())).normalized();
            double most = -10.0;
            for (std::size_t c = 0; c < solid.corners.size(); ++c)
                most = std::max(most, n.dot(solid.corners[c]));
            crush_solid(solid, n, (most - 1e-3) * n);
            require_solid(solid);
            REQUIRE(solid.plane_count() <= 34);
            REQUIRE(volume_of(solid) <= volume + 1e-9);
            volume = volume_of(solid);
        }
        CHECK(volume < whole);
        CHECK(volume > 0.1 * whole);
    }
}

TEST_CASE("a plane that is almost parallel to a face moves this face", "[shape][analytic]") {
    ConvexPiece solid = solid_box(Vec3(2, 1, 0.6));
    REQUIRE(crush_solid(solid, Vec3(1, 1e-3, 0).normalized(), Vec3(0.9, 0, 0)));
    CHECK(solid.plane_count() == 6);
    CHECK(volume_of(solid) == Near(1.9 * 1.0 * 0.6).margin(1e-12));
    REQUIRE(crush_solid(solid, Vec3(1, 0.1, 0).normalized(), Vec3(0.88, 0, 0)));
    CHECK(solid.plane_count() == 7);
}

TEST_CASE("a crushed solid meets a face at its deepest corner", "[shape]") {
    test::Dice dice{std::mt19937(5)};
    const ConvexPiece plate = solid_box(Vec3(20, 20, 20));
    for (int k = 0; k < 500; ++k) {
        ConvexPiece solid = solid_box(test::kPaperFloe);
        for (int cut = 0; cut < 30; ++cut) {
            const Vec3 n = dice.vector().normalized();
            double most = 0.0;
            for (std::size_t c = 0; c < solid.corners.size(); ++c)
                most = std::max(most, n.dot(solid.corners[c]));
            crush_solid(solid, n, (most - 0.01) * n);
        }
        // its lowest corner 1 cm deep in the plate, which is too large to have another axis
        const Mat3 turn =
            Eigen::AngleAxisd(3.1 * dice.number(), dice.vector().normalized()).toRotationMatrix();
        double lowest = 0.0;
        for (std::size_t c = 0; c < solid.corners.size(); ++c)
            lowest = std::min(lowest, (turn * solid.corners[c]).z());
        const RelativePose pose{turn, Vec3(0, 0, 10.0 - 0.01 - lowest)};
        ContactPolygon met;
        ClippingWork work;
        make_contact_polygon(plate, solid, pose, find_axes(plate, solid, pose, 1.0),
                             IncidentFaces::all, 1.0, work, met);
        REQUIRE(met.corners.size() >= 3);
        double gap = 0.0;
        for (const PolygonCorner& c : met.corners) gap = std::min(gap, c.gap);
        CHECK(gap == Near(-0.01).margin(1e-12));
    }
}

TEST_CASE("sections of faces, corners and crossing edges are those of solid geometry",
          "[shape][analytic]") {
    const ConvexPiece cube = solid_box(Vec3(1, 1, 1)), plate = solid_box(Vec3(4, 4, 1));
    const double depth = GENERATE(0.01, 0.1);
    // a face on a face, half beside it
    CHECK(section_of(plate, cube, shifted(Vec3(2, 0.2, 1 - depth)), Vec3::UnitZ()) ==
          Near(0.5).margin(1e-12));
    // faces that just touch count within the reach
    CHECK(section_of(plate, cube, shifted(Vec3(0, 0, 1)), Vec3::UnitZ(), 1e-3) ==
          Near(1.0).margin(1e-12));
    // an edge of 90 degrees, 1 m long
    const Mat3 on_edge(Eigen::AngleAxisd(0.25 * std::numbers::pi, Vec3::UnitX()));
    const double half = std::sqrt(0.5);
    CHECK(section_of(plate, cube, {on_edge, Vec3(0, 0, 0.5 + half - depth)}, Vec3::UnitZ()) ==
          Near(2.0 * depth).margin(1e-9));
    // a cube's corner: an equilateral triangle
    const Mat3 on_corner =
        Quaternion::FromTwoVectors(Vec3(-1, -1, -1), Vec3(0, 0, -1)).toRotationMatrix();
    CHECK(section_of(plate, cube, {on_corner, Vec3(0, 0, 0.5 + 0.5 * std::numbers::sqrt3 - depth)},
                     Vec3::UnitZ()) ==
          Near(1.5 * std::numbers::sqrt3 * depth * depth).margin(1e-9));
    // two crossing edges of 90 degrees: each is 2 depth long in the other
    const Mat3 across(Eigen::AngleAxisd(0.25 * std::numbers::pi, Vec3::UnitY()));
    const Vec3 apart(0, 0, 2.0 * half - depth);
    const RelativePose pose{on_edge.transpose() * across, on_edge.transpose() * apart};
    const Vec3 n = on_edge.transpose() * Vec3::UnitZ();
    CHECK(section_of(cube, cube, pose, n) == Near(2.0 * depth * depth).margin(1e-9));
    const RelativePose back{pose.rotation.transpose(),
                            -(pose.rotation.transpose() * pose.translation)};
    CHECK(section_of(cube, cube, back, -(pose.rotation.transpose() * n)) ==
          Near(2.0 * depth * depth).margin(1e-9));
}

TEST_CASE("slices have the area of the section, and none beside the solid", "[shape][analytic]") {
    const ConvexPiece solid = solid_box(Vec3(2, 1, 0.6));
    CHECK(slice_area(solid, Vec3::UnitZ(), 0.1) == Near(2.0).margin(1e-12));
    CHECK(slice_area(solid, Vec3::UnitX(), -0.9) == Near(0.6).margin(1e-12));
    const Vec3 n = Vec3(0, 1, 1).normalized();
    CHECK(slice_area(solid, n, 0.0) == Near(2.0 * 0.6 * std::numbers::sqrt2).margin(1e-12));
    CHECK(slice_area(solid, Vec3::UnitZ(), 0.31) == 0.0);
}

TEST_CASE("a floe that presses its face on another one is stopped by pressure x face",
          "[step][crushing][analytic]") {
    World w = floe_on_floe(1e3, Vec3(0.1, 0.2, 0.1499), Quaternion::Identity());
    push_down(w, 1.0);
    const double mass = w.scene.bodies.mass[2], force = 1e3 * 1.0 * 0.8;
    for (int k = 1; k <= 10; ++k) {
        step(w);
        // lengths of sphere sets are floats
        CHECK(w.scene.bodies.momentum[2].z() == Near(-mass + k * force * 0.01).epsilon(1e-7));
        // what the step left is cut off, but for the overlap that position correction leaves
        const ConvexPiece* left = w.scene.crushed_solids.solid_of(2);
        REQUIRE(left);
        CHECK(volume_of(*left) ==
              Near(0.8 * (w.scene.bodies.position[2].z() + 0.15)).margin(0.8 * 0.02 * 0.05));
    }
    CHECK(w.scene.crushed_solids.solid_of(1) == nullptr);  // the broader one stays
    CHECK(measure_overlaps(w.scene, {}).deepest < 0.02 * 0.05 + 1e-9);
}

TEST_CASE("an edge that is driven into a floe meets pressure x section at every depth",
          "[step][crushing][analytic]") {
    // the edge along y, of 90 degrees turned by `tilt` from upright
    const double tilt = GENERATE(0.0, 0.3);
    const double angle = 0.25 * std::numbers::pi + tilt;
    const double low = 0.5 * std::sin(angle) + 0.15 * std::cos(angle);
    World w =
        floe_on_floe(2e5, Vec3(0, 0, low), Quaternion(Eigen::AngleAxisd(angle, Vec3::UnitY())));
    w.scene.bodies.mass[2] *= 1e9;  // so heavy that nothing slows or turns it
    for (Inertia& inertia : w.scene.bodies.inertias) {
        inertia.body *= 1e9;
        inertia.inverse /= 1e9;
    }
    const double speed = 0.5;
    push_down(w, speed);
    // horizontal lengths that each metre of depth cuts of the edge's two faces
    const double breadth = std::tan(angle) + 1.0 / std::tan(angle);
    for (int k = 0; k < 27; ++k) {
        const double depth = speed * w.time;
        step(w);
        double force = 0.0;
        for (const Constraint& c : w.constraints) force += c.total_normal() / 0.01;
        CAPTURE(depth, tilt);
        // The section is that at the step's beginning. Surfaces count 1 mm outside each other,
        // sides included, and overlap of 1 mm may be left.
        const double area = 0.8 * depth * breadth;
        CHECK(force / 2e5 == Near(area).margin(0.8 * 2e-3 * breadth + 2e-3 * depth * breadth));
    }
    CHECK(measure_overlaps(w.scene, {}).deepest < speed * 0.01);
}

TEST_CASE("a tilted face meets pressure x section, whatever corners are still open",
          "[step][crushing][analytic]") {
    // tilted about y: two corners are in the lower floe, two above it
    const double tilt = 0.02, depth = 0.004;
    World w = floe_on_floe(1e3, Vec3(0, 0, 0.15 - depth + 0.5 * std::sin(tilt)),
                           Quaternion(Eigen::AngleAxisd(tilt, Vec3::UnitY())));
    push_down(w, 2.0);  // the open corners are within the step's reach
    step(w);
    double bound = 0.0, force = 0.0;
    std::size_t open = 0;
    for (const Constraint& c : w.constraints) {
        open += c.gap > 1e-3;
        if (c.gap <= 1e-3) bound += c.max_impulse / 0.01;
        force += c.total_normal() / 0.01;
    }
    CHECK(open == 2);
    // the half edge of the face's lower end: its thickness is taken for upright
    const double lowest =
        -(0.5 * std::sin(tilt) + 0.15 * std::cos(tilt)) + 0.15 - depth + 0.5 * std::sin(tilt);
    const double area = 0.8 * (1e-3 - lowest) / std::tan(tilt);
    CHECK(bound == Near(1e3 * area).epsilon(0.02));
    CHECK(force >= bound * (1.0 - 1e-9));
}

TEST_CASE("an overlap that cannot be cut opens", "[step][crushing]") {
    // the whole floe lies below the lower one's upper face: a cut would leave nothing of it
    World w = floe_on_floe(1.0, Vec3(0, 0, -0.2), Quaternion::Identity());
    const double begin = w.scene.bodies.position[2].z();
    push_down(w, 1e-3);
    for (int k = 0; k < 10; ++k) step(w);
    CHECK(w.scene.crushed_solids.solid_of(2) == nullptr);
    // Position correction opens half a radius of 0.05 m in 0.1 s: a tenth of it in each step of
    // 0.01 s. The margin has the floe's own way down in ten steps.
    CHECK(w.scene.bodies.position[2].z() - begin == Near(10 * 0.1 * 0.5 * 0.05).margin(2e-4));
}

TEST_CASE("what a floe has crushed off counts neither as ice nor as overlap", "[overlaps]") {
    World w = floe_on_floe(1e5, Vec3(0, 0, 0.1), Quaternion::Identity());
    CHECK(measure_overlaps(w.scene, {}).deepest == Near(0.05).margin(1e-9));
    w.scene.crushed_solids.cut(2, w.scene.shape_of(2).convex, -Vec3::UnitZ(), Vec3(0, 0, -0.12));
    CHECK(measure_overlaps(w.scene, {}).deepest == Near(0.02).margin(1e-9));
    w.scene.crushed_solids.cut(1, w.scene.shape_of(1).convex, Vec3::UnitZ(), Vec3(0, 0, 0.49));
    CHECK(measure_overlaps(w.scene, {}).deepest == Near(0.01).margin(1e-9));
    // another body in its slot is whole
    w.scene.crushed_solids.forget(2);
    CHECK(w.scene.crushed_solids.solid_of(2) == nullptr);
    CHECK(measure_overlaps(w.scene, {}).deepest == Near(0.04).margin(1e-9));
}

TEST_CASE("crushed solids come back from a checkpoint to the bit", "[checkpoint]") {
    test::Dice dice{std::mt19937(3)};
    const ConvexPiece whole = solid_box(test::kPaperFloe);
    CrushedSolids crushed;
    for (int k = 0; k < 50; ++k) {
        const Vec3 n = dice.vector().normalized();
        crushed.cut(k % 2 == 0 ? 2 : 5, whole, n, 0.3 * n);
    }
    const auto path = std::filesystem::temp_directory_path() /
                      ("crushed-solids-" + std::to_string(::getpid()) + ".h5");
    {
        CheckpointFile file(path, CheckpointFile::Direction::write);
        crushed.carry(file);
        file.finish();
    }
    CrushedSolids back;
    back.cut(1, whole, Vec3::UnitX(), Vec3(0.2, 0, 0));  // of another state, which is replaced
    CheckpointFile file(path, CheckpointFile::Direction::read);
    back.carry(file);
    std::filesystem::remove(path);
    CHECK(back.solid_of(1) == nullptr);
    for (const std::int32_t body : {2, 5}) {
        const ConvexPiece *a = crushed.solid_of(body), *b = back.solid_of(body);
        REQUIRE((a && b));
        REQUIRE(a->plane_count() == b->plane_count());
        CHECK(a->loops == b->loops);
        CHECK(a->offsets == b->offsets);
        for (std::size_t k = 0; k < a->corners.size(); ++k) CHECK(a->corners[k] == b->corners[k]);
        for (std::size_t k = 0; k < a->edges.size(); ++k)
            CHECK(a->edge_along[k] == b->edge_along[k]);
        // the next cut has the same result, too
        CrushedSolids* const both[] = {&crushed, &back};
        for (CrushedSolids* c : both) c->cut(body, whole, Vec3::UnitZ(), Vec3(0, 0, 0.05));
        CHECK(crushed.solid_of(body)->loops == back.solid_of(body)->loops);
    }
}
