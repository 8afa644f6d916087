// SPDX-License-Identifier: GPL-3.0-or-later
// The separating axes of convex pieces: boxes by hand, random ones against all directions that the
// meshes have.
//
// Tolerances: 1e-15 and 1e-12 m are rounding of products of lengths of a metre; 1e-9 m is that of a
// normal made of two edges that are almost parallel.
#include "solver/narrow/feature/separating_axis.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/support/every_instruction_set.hpp"
#include "tests/support/make_prisms.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

constexpr double kWidest = std::numeric_limits<double>::infinity();

RelativePose random_pose(test::Dice& dice, double apart) {
    return {Eigen::AngleAxisd(3.1 * dice.number(), dice.vector().normalized()).toRotationMatrix(),
            apart * dice.vector()};
}

struct Body {
    TriangleMesh mesh;
    ConvexPiece piece;
    std::vector<Vec3> normals;                                 // of the triangles
    std::vector<std::pair<std::int32_t, std::int32_t>> edges;  // the mesh's, diagonals included

    explicit Body(TriangleMesh m) : mesh(std::move(m)), piece(make_convex_piece(mesh)) {
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            normals.push_back(mesh.area_vector(t).normalized());
            for (std::size_t k = 0; k < 3; ++k) {
                const std::int32_t from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
                if (from < to) edges.emplace_back(from, to);
            }
        }
    }
    Vec3 at(std::int32_t vertex) const { return mesh.vertices[static_cast<std::size_t>(vertex)]; }
};

// Brute force: the gap along any direction is that of all vertices; the widest over the normals of
// all triangles and over all products of two edges of the meshes, either way.
double widest_gap(const Body& a, const Body& b, const RelativePose& pose, bool only_faces) {
    std::vector<Vec3> of_b;
    for (const Vec3& v : b.mesh.vertices) of_b.push_back(pose.rotation * v + pose.translation);
    const auto gap_along = [&](const Vec3& n) {
        double most = -kWidest, least = kWidest;
        for (const Vec3& v : a.mesh.vertices) most = std::max(most, n.dot(v));
        for (const Vec3& v : of_b) least = std::min(least, n.dot(v));
        return least - most;
    };
    double widest = -kWidest;
    for (const Vec3& n : a.normals) widest = std::max(widest, gap_along(n));
    for (const Vec3& n : b.normals) widest = std::max(widest, gap_along(-(pose.rotation * n)));
    for (const auto& [i, j] : a.edges)
        for (const auto& [k, l] : b.edges) {
            const Vec3 ea = (a.at(j) - a.at(i)).normalized();
            const Vec3 kb = of_b[static_cast<std::size_t>(k)],
                       lb = of_b[static_cast<std::size_t>(l)];
            const Vec3 across = ea.cross((lb - kb).normalized());
            if (across.norm() < 1e-6) continue;
            for (const double sign : {-1.0, 1.0}) {
                const Vec3 n = sign * across.normalized();
                const double gap = gap_along(n);
                // on a face of the Minkowski difference both edges are foremost along n
                if (only_faces && std::abs(n.dot(kb - a.at(i)) - gap) > 1e-9) continue;
                widest = std::max(widest, gap);
            }
        }
    return widest;
}

bool same_bits(const SeparatingAxes& l, const SeparatingAxes& r) {
    return l.face_a == r.face_a && l.face_b == r.face_b && l.edges == r.edges &&
           l.plane_a == r.plane_a && l.plane_b == r.plane_b && l.edge_a == r.edge_a &&
           l.edge_b == r.edge_b;
}

std::vector<Body> random_bodies(unsigned seed, int count) {
    test::Dice dice{std::mt19937(seed)};
    std::vector<Body> out;
    for (int k = 0; k < count; ++k) out.emplace_back(test::make_random_frustum(dice, 3 + k % 3));
    for (const Body& body : out) REQUIRE_FALSE(body.piece.empty());
    return out;
}

}  // namespace

TEST_CASE("boxes face to face, and edge across edge, are as far apart as they stand",
          "[narrow][analytic]") {
    const Body box(test::make_box_mesh(Vec3(2, 2, 2)));
    const double gap = GENERATE(0.3, 0.0, -0.2, -0.7);
    SeparatingAxes axes =
        find_axes(box.piece, box.piece, {Mat3::Identity(), Vec3(2.0 + gap, 0.3, -0.1)}, kWidest);
    CHECK(axes.widest() == Near(gap).margin(1e-15));
    CHECK(axes.face_a == Near(gap).margin(1e-15));
    CHECK(axes.face_b == Near(gap).margin(1e-15));
    CHECK((box.piece.normals[static_cast<std::size_t>(axes.plane_a)] - Vec3::UnitX()).norm() == 0);
    CHECK((box.piece.normals[static_cast<std::size_t>(axes.plane_b)] + Vec3::UnitX()).norm() == 0);

    // an upper edge along y, seen along (1, 0, 1), and one of the other box at right angles to it
    const Vec3 n = Vec3(1, 0, 1).normalized();
    Mat3 turn;  // its edge lies along x cross y of its faces, n crossed with y
    turn.col(0) = (-n - Vec3::UnitY()).normalized();
    turn.col(1) = (-n + Vec3::UnitY()).normalized();
    turn.col(2) = turn.col(0).cross(turn.col(1));
    const RelativePose pose{turn, Vec3(1, 0, 1) + gap * n - turn * Vec3(1, 1, 0)};
    axes = find_axes(box.piece, box.piece, pose, kWidest);
    CHECK(axes.edges == Near(gap).margin(1e-15));
    CHECK(axes.edges > std::max(axes.face_a, axes.face_b) - tolerance(1e-12));
    CHECK((edge_axis(box.piece, box.piece, pose, axes.edge_a, axes.edge_b) - n).norm() <
          tolerance(1e-15));
}

TEST_CASE("a hundred thousand random pairs overlap and separate as brute force says, to 1e-9 m",
          "[narrow][equivalence]") {
    const std::vector<Body> bodies = random_bodies(11, 60);
    test::Dice dice{std::mt19937(12)};
    int overlaps = 0, separate = 0, by_edges = 0;
    for (int k = 0; k < 100000; ++k) {
        const Body& a = bodies[static_cast<std::size_t>(k) % bodies.size()];
        const Body& b = bodies[static_cast<std::size_t>(k / 7 + 3 * k) % bodies.size()];
        const RelativePose pose = random_pose(dice, 1.6);
        const SeparatingAxes axes = find_axes(a.piece, b.piece, pose, kWidest);
        const double found = axes.widest();
        by_edges += axes.edges > std::max(axes.face_a, axes.face_b);
        if (found <= 0.0) {
            ++overlaps;  // no direction separates them sooner
            REQUIRE(std::abs(found - widest_gap(a, b, pose, false)) < tolerance(1e-9));
        } else {
            ++separate;
            REQUIRE(std::abs(found - widest_gap(a, b, pose, true)) < tolerance(1e-9));
        }
    }
    CHECK(overlaps > 20000);
    CHECK(separate > 20000);
    CHECK(by_edges > 10000);
}

TEST_CASE("moved along its axis by the penetration depth a pair just touches",
          "[narrow][property]") {
    const std::vector<Body> bodies = random_bodies(13, 20);
    test::Dice dice{std::mt19937(14)};
    for (int k = 0; k < 2000; ++k) {
        const Body& a = bodies[static_cast<std::size_t>(k) % 20];
        const Body& b = bodies[static_cast<std::size_t>(k / 3) % 20];
        RelativePose pose = random_pose(dice, 1.0);
        const SeparatingAxes axes = find_axes(a.piece, b.piece, pose, kWidest);
        const double depth = -axes.widest();
        if (depth <= 0.0) continue;
        const Vec3 n =
            axes.edges == -depth ? edge_axis(a.piece, b.piece, pose, axes.edge_a, axes.edge_b)
            : axes.face_a == -depth
                ? a.piece.normals[static_cast<std::size_t>(axes.plane_a)]
                : Vec3(-(pose.rotation * b.piece.normals[static_cast<std::size_t>(axes.plane_b)]));
        pose.translation += depth * n;
        REQUIRE(find_axes(a.piece, b.piece, pose, kWidest).widest() == Near(0.0).margin(1e-12));
    }
}

TEST_CASE("a search that has enough has looked at fewer kinds, and one plane is as all of them",
          "[narrow][property]") {
    const std::vector<Body> bodies = random_bodies(15, 10);
    test::Dice dice{std::mt19937(16)};
    int short_ones = 0;
    for (int k = 0; k < 1000; ++k) {
        const ConvexPiece& a = bodies[static_cast<std::size_t>(k) % 10].piece;
        const ConvexPiece& b = bodies[static_cast<std::size_t>(k / 3) % 10].piece;
        const RelativePose pose = random_pose(dice, 2.0);
        const SeparatingAxes all = find_axes(a, b, pose, kWidest);
        const SeparatingAxes some = find_axes(a, b, pose, 0.1);
        REQUIRE((some.widest() > 0.1) == (all.widest() > 0.1));
        REQUIRE(some.face_a == all.face_a);
        REQUIRE(gap_along_plane(a, b, pose, all.plane_a, -1) == all.face_a);
        REQUIRE(gap_along_plane(a, b, pose, -1, all.plane_b) == all.face_b);
        if (some.widest() <= 0.1) REQUIRE(same_bits(some, all));
        short_ones += some.plane_b < 0;
    }
    CHECK(short_ones > 100);
}

TEST_CASE("mirror images have the same gaps, bit for bit", "[narrow][property]") {
    const auto mirrored = [](TriangleMesh mesh) {
        for (Vec3& v : mesh.vertices) v.y() = -v.y();
        for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
        return mesh;
    };
    test::Dice dice{std::mt19937(17)};
    for (int k = 0; k < 500; ++k) {
        const Body a(test::make_random_frustum(dice, 3 + k % 4)),
            b(test::make_random_frustum(dice, 4));
        const Body c(mirrored(a.mesh)), d(mirrored(b.mesh));
        const RelativePose pose = random_pose(dice, 1.0);
        RelativePose image = pose;
        for (const auto& [row, col] : {std::pair{0, 1}, {1, 0}, {1, 2}, {2, 1}})
            image.rotation(row, col) *= -1.0;
        image.translation.y() *= -1.0;
        const SeparatingAxes port = find_axes(a.piece, b.piece, pose, kWidest);
        const SeparatingAxes starboard = find_axes(c.piece, d.piece, image, kWidest);
        REQUIRE(port.face_a == starboard.face_a);
        REQUIRE(port.face_b == starboard.face_b);
        REQUIRE(port.edges == starboard.edges);
    }
}

TEST_CASE("every instruction set finds the reference's axes, bit for bit", "[narrow][simd]") {
    std::vector<Body> bodies = random_bodies(18, 6);
    test::Dice dice{std::mt19937(19)};
    bodies.emplace_back(test::make_box_mesh(Vec3(2, 1, 0.5)));  // parallel edges and equal gaps
    bodies.emplace_back(test::make_random_frustum(dice, 17));
    test::on_every_instruction_set([&] {
        test::Dice poses{std::mt19937(20)};
        for (int k = 0; k < 800; ++k) {
            const ConvexPiece& a = bodies[static_cast<std::size_t>(k) % 8].piece;
            const ConvexPiece& b = bodies[static_cast<std::size_t>(k / 8) % 8].piece;
            RelativePose pose = random_pose(poses, 1.5);
            if (k % 5 == 0) pose.rotation = Mat3::Identity();
            const double enough = k % 3 == 0 ? 0.05 : kWidest;
            REQUIRE(
                same_bits(find_axes(a, b, pose, enough), reference::find_axes(a, b, pose, enough)));
        }
    });
}
