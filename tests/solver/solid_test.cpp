// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes as planes, corners and edges.
//
// Tolerances: 1e-15 is rounding of a unit vector or of a sum of edges, 1e-12 that of a difference
// of products of lengths of a metre.
#include "solver/shape/solid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/make_meshes.hpp"
#include "tests/support/make_prisms.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

std::vector<Vec3> ring(int corners, double radius, double z) {
    std::vector<Vec3> out;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / corners;
        out.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    return out;
}

// Every corner behind every plane, loops in their planes and anticlockwise, edges between the
// planes that they name.
void check_consistent(const ConvexPiece& piece) {
    for (std::size_t k = 0; k < piece.plane_count(); ++k) {
        const Vec3 n = piece.normals[k];
        CHECK(n.norm() == Near(1.0).epsilon(1e-15));
        for (std::size_t c = 0; c < piece.corners.size(); ++c)
            CHECK(n.dot(piece.corners[c]) <= piece.offsets[k] + tolerance(1e-12));
        const auto& loop = piece.loops[k];
        Vec3 area = Vec3::Zero();
        for (std::size_t c = 0; c < loop.size(); ++c) {
            const Vec3 p = piece.corners[static_cast<std::size_t>(loop[c])],
                       q = piece.corners[static_cast<std::size_t>(loop[(c + 1) % loop.size()])];
            CHECK(n.dot(p) == Near(piece.offsets[k]).margin(1e-12));
            area += 0.5 * p.cross(q);
        }
        CHECK(area.dot(n) > 0.0);
    }
    for (std::size_t k = 0; k < piece.edges.size(); ++k) {
        const SolidEdge& e = piece.edges[k];
        const Vec3 along = piece.edge_along[k];
        CHECK(along.dot(piece.edge_left[k].cross(piece.edge_right[k])) > 0.0);
        CHECK(piece.edge_left[k] == piece.normals[static_cast<std::size_t>(e.left)]);
        CHECK(piece.edge_right[k] == piece.normals[static_cast<std::size_t>(e.right)]);
        CHECK(std::abs(along.dot(piece.edge_left[k])) < tolerance(1e-12));
        const Vec3 begin = piece.corners[static_cast<std::size_t>(e.begin)],
                   end = piece.corners[static_cast<std::size_t>(e.end)];
        CHECK(piece.edge_middle[k] == 0.5 * (begin + end));
        CHECK((end - begin).normalized() == along);
    }
}

}  // namespace

TEST_CASE("a box has six planes, eight corners and twelve edges", "[shape][analytic]") {
    const Vec3 size(4.0, 3.0, 0.5);
    const ConvexPiece box = make_convex_piece(test::make_box_mesh(size));
    REQUIRE(box.plane_count() == 6);
    REQUIRE(box.corners.size() == 8);
    REQUIRE(box.edges.size() == 12);
    check_consistent(box);
    for (std::size_t k = 0; k < 6; ++k) {
        CHECK(box.offsets[k] == 0.5 * size.dot(box.normals[k].cwiseAbs()));
        CHECK(box.loops[k].size() == 4);
    }
    double length = 0.0;
    for (std::size_t k = 0; k < 12; ++k)
        length +=
            2.0 * (box.corners[static_cast<std::size_t>(box.edges[k].end)] - box.edge_middle[k])
                      .dot(box.edge_along[k]);
    CHECK(length == Near(4.0 * size.sum()).epsilon(1e-15));
    // the last block is filled up with what is there
    CHECK(box.normals.blocks()[0].x[7] == box.normals[5].x());
    CHECK(box.offsets.size() == 8);
}

TEST_CASE("prisms, frusta and chamfered plates are what their outlines say", "[shape][analytic]") {
    const int sides = GENERATE(3, 4, 6, 13);
    const auto n = static_cast<std::size_t>(sides);
    const ConvexPiece prism =
        make_convex_piece(test::make_ring_mesh(ring(sides, 2.0, -0.5), ring(sides, 2.0, 0.5)));
    CHECK(prism.plane_count() == n + 2);
    CHECK(prism.corners.size() == 2 * n);
    CHECK(prism.edges.size() == 3 * n);
    check_consistent(prism);
    // three rings: the sides lean in above and below the middle one
    TriangleMesh plate = test::make_ring_mesh(ring(sides, 1.9, -0.5), ring(sides, 2.0, 0.0));
    const TriangleMesh upper = test::make_ring_mesh(ring(sides, 2.0, 0.0), ring(sides, 1.9, 0.5));
    const auto first = static_cast<std::int32_t>(plate.vertices.size());
    plate.vertices.insert(plate.vertices.end(), upper.vertices.begin(), upper.vertices.end());
    for (const auto& t : upper.triangles)
        plate.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    // what they have in common, level at z = 0, is inside
    std::erase_if(plate.triangles, [&](const auto& t) {
        return std::all_of(t.begin(), t.end(), [&](std::int32_t v) {
            return plate.vertices[static_cast<std::size_t>(v)].z() == 0.0;
        });
    });
    const ConvexPiece chamfered = make_convex_piece(plate);
    CHECK(chamfered.plane_count() == 2 * n + 2);
    CHECK(chamfered.corners.size() == 3 * n);
    CHECK(chamfered.edges.size() == 5 * n);
    check_consistent(chamfered);
}

TEST_CASE("vertices that are floats do not make a face several planes", "[shape][degenerate]") {
    test::Dice dice{std::mt19937(3)};
    int planes = 0;
    for (int k = 0; k < 100; ++k) {
        TriangleMesh mesh = test::make_ring_mesh(ring(6, 3.0, -0.5), ring(6, 3.0, 0.5));
        const Vec3 shift = 10.0 * dice.vector();
        const Mat3 turn =
            Eigen::AngleAxisd(3.0 * dice.number(), dice.vector().normalized()).toRotationMatrix();
        for (Vec3& v : mesh.vertices) v = (turn * v + shift).cast<float>().cast<double>();
        const ConvexPiece piece = make_convex_piece(mesh);
        REQUIRE_FALSE(piece.empty());
        planes += static_cast<int>(piece.plane_count());
    }
    CHECK(planes == 800);
}

TEST_CASE("a mesh with a dent, a curved one and a flat one are no convex piece",
          "[shape][degenerate]") {
    TriangleMesh dented = test::make_box_mesh(Vec3(1, 1, 1));
    dented.vertices.front() *= 0.2;
    CHECK(make_convex_piece(dented).empty());
    CHECK(make_convex_piece(test::make_globe(1.0, 20)).empty());
    CHECK(make_convex_piece(test::make_box_mesh(Vec3(1, 1, 0))).empty());
    CHECK(make_convex_piece(TriangleMesh()).empty());
    // a dent of a hundredth of a millimetre per metre is one, of a tenth of that rounding
    for (const double dent : {1e-5, 1e-7}) {
        TriangleMesh roof = test::make_ring_mesh(ring(4, 1.0, 0.0), ring(4, 1.0, 1.0));
        roof.vertices.push_back(Vec3(0, 0, 1.0 - dent));
        std::erase_if(roof.triangles, [](const auto& t) {
            return std::all_of(t.begin(), t.end(), [](std::int32_t v) { return v > 3; });
        });
        for (std::int32_t k = 0; k < 4; ++k) roof.triangles.push_back({4 + k, 4 + (k + 1) % 4, 8});
        CHECK(make_convex_piece(roof).empty() == (dent > 1e-6));
    }
}
