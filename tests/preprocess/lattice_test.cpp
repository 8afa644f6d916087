// SPDX-License-Identifier: GPL-3.0-or-later
// The interior fill, point by point: CGAL's answers, the slow twin's, symmetry, threads.
//
// Tolerances: 1e-12 is rounding of a distance.
#include <bit>
#include <catch2/catch.hpp>
#include <map>

#include "common/base/parallel.hpp"
#include "preprocess/fill/clear_near.hpp"
#include "tests/preprocess/decide_blocks.hpp"
#include "tests/preprocess/lattice_solids.hpp"
#include "tests/preprocess/solid_oracle.hpp"
#include "tests/support/make_hull.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

bool is_set(const LatticeFrame& frame, const LatticeBits& bits, std::int64_t i, std::int64_t j,
            std::int64_t k) {
    const auto word = static_cast<std::size_t>(i / 64);
    return (bits[frame.row(j, k) * frame.words() + word] >> (i % 64) & 1) != 0;
}

struct Site {
    Vec3 at;
    bool set;
};

std::vector<Site> sites(const LatticeFrame& frame, const LatticeBits& bits) {
    std::vector<Site> out;
    for (std::int64_t k = 0; k < frame.count[2]; ++k)
        for (std::int64_t j = 0; j < frame.count[1]; ++j)
            for (std::int64_t i = 0; i < frame.count[0]; ++i)
                out.push_back({frame.point(i, j, k), is_set(frame, bits, i, j, k)});
    return out;
}

std::vector<Vec3> places(const std::vector<Site>& all) {
    std::vector<Vec3> out;
    for (const Site& site : all) out.push_back(site.at);
    return out;
}

// A frame whose rows pass through points with whole coordinates.
LatticeFrame whole_frame(double step, std::int64_t half) {
    LatticeFrame frame;
    frame.count = {2 * half + 1, 2 * half + 1, 2 * half + 1};
    frame.step = Vec3::Constant(step);
    frame.first = Vec3::Constant(-step * static_cast<double>(half));
    return frame;
}

void check_against_cgal(const TriangleMesh& mesh, LatticeKind kind, double radius,
                        double clearance) {
    const LatticeFill fill = fill_lattice_rows(mesh, {kind, radius, clearance, 3, false});
    const auto all = sites(fill.frame, fill.bits);
    const auto answers = test::ask_oracle(mesh, places(all));
    std::size_t unlike = 0, set = 0;
    for (std::size_t p = 0; p < all.size(); ++p) {
        const bool expected = answers[p].inside && answers[p].distance >= clearance * (1.0 - 1e-9);
        unlike += all[p].set != expected;
        set += expected;
    }
    CAPTURE(all.size());
    CHECK(unlike == 0);
    CHECK(set > 50);
    CHECK(fill.count == set);
}

}  // namespace

TEST_CASE("a lattice holds the points CGAL finds inside and clear, on straight solids",
          "[lattice][equivalence]") {
    const auto kind = GENERATE(LatticeKind::cubic, LatticeKind::hexagonal);
    // the floe is tangent to its spheres on all sides; the prism has a reflex edge
    check_against_cgal(test::make_box_mesh(Vec3(1, 0.8, 0.3)), kind, 0.05, 0.05);
    check_against_cgal(test::make_l_prism(), kind, 0.125, 0.125);
    check_against_cgal(test::make_l_prism(), kind, 0.11, 0.22);
}

TEST_CASE("a lattice holds the points CGAL finds inside and clear, on round solids",
          "[lattice][equivalence]") {
    const auto kind = GENERATE(LatticeKind::cubic, LatticeKind::hexagonal);
    check_against_cgal(test::make_globe(1.0, 16), kind, 0.07, 0.07);
    check_against_cgal(test::make_torus(1.0, 0.4, 40, 16), kind, 0.05, 0.05);
    check_against_cgal(test::make_wigley(10, 2, 1, 40, 12), kind, 0.08, 0.08);
    check_against_cgal(test::make_hull({10, 2, 1.8}, 3000), kind, 0.1, 0.1);
}

TEST_CASE("a lattice holds the points CGAL finds inside and clear, at any angle",
          "[lattice][equivalence]") {
    const auto seed = GENERATE(1u, 2u, 3u, 4u);
    check_against_cgal(test::turned(test::make_box_mesh(Vec3(1, 0.8, 0.3)), seed),
                       LatticeKind::hexagonal, 0.04, 0.04);
    check_against_cgal(test::turned(test::make_l_prism(), seed), LatticeKind::cubic, 0.12, 0.12);
    check_against_cgal(test::turned(test::make_torus(1.0, 0.3, 30, 10), seed),
                       LatticeKind::hexagonal, 0.05, 0.05);
}

TEST_CASE("rows along edges, through corners and grazing faces wind as CGAL says",
          "[lattice][degenerate]") {
    // all coordinates are multiples of the step: only points on the surface are left open
    const TriangleMesh mesh = GENERATE(
        test::make_l_prism(), test::make_box_mesh(Vec3(2, 2, 2)),
        test::make_prism({{0, -2}, {2, 0}, {0, 2}, {-2, 0}}, 1.0),                     // edges only
        test::make_prism({{-2, -1}, {0, 1}, {2, -1}, {2, 1}, {0, 2}, {-2, 1}}, 2.0));  // a notch
    const LatticeFrame frame = whole_frame(0.25, 11);
    const auto all = sites(frame, rows_inside(mesh, frame));
    const auto answers = test::ask_oracle(mesh, places(all));
    std::size_t open = 0;
    for (std::size_t p = 0; p < all.size(); ++p) {
        if (answers[p].distance > 1e-12)
            REQUIRE(all[p].set == answers[p].inside);
        else
            ++open;
    }
    CHECK(open > 100);
}

TEST_CASE("an octahedron on lattice points, unwelded, has no leaking row",
          "[lattice][degenerate]") {
    const TriangleMesh welded = test::make_globe(2.0, 2);  // corners on the axes
    TriangleMesh soup;
    for (std::size_t t = 0; t < welded.triangles.size(); ++t) {
        const auto n = static_cast<std::int32_t>(soup.vertices.size());
        for (int c = 0; c < 3; ++c) soup.vertices.push_back(welded.corner(t, c));
        soup.triangles.push_back({n, n + 1, n + 2});
    }
    const LatticeFrame frame = whole_frame(0.25, 12);
    const LatticeBits bits = rows_inside(soup, frame);
    CHECK(bits == rows_inside(welded, frame));
    for (const Site& site : sites(frame, bits)) {
        const double depth = 2.0 - site.at.lpNorm<1>();
        if (std::abs(depth) > 1e-9) REQUIRE(site.set == (depth > 0.0));
    }
}

TEST_CASE("shells that overlap are inside once", "[lattice][analytic]") {
    TriangleMesh other = test::make_box_mesh(Vec3(2, 2, 2));
    for (Vec3& v : other.vertices) v += Vec3(1, 0.5, 0.5);
    const LatticeFrame frame = whole_frame(0.19, 12);
    const TriangleMesh both = test::joined(test::make_box_mesh(Vec3(2, 2, 2)), other);
    for (const Site& site : sites(frame, rows_inside(both, frame))) {
        const bool first = site.at.cwiseAbs().maxCoeff() < 1.0;
        const bool second = (site.at - Vec3(1, 0.5, 0.5)).cwiseAbs().maxCoeff() < 1.0;
        REQUIRE(site.set == (first || second));
    }
}

TEST_CASE("1e5 and more points are decided as the slow twin decides them",
          "[lattice][equivalence]") {
    const auto kind = GENERATE(LatticeKind::cubic, LatticeKind::hexagonal);
    const double radius = kind == LatticeKind::cubic ? 0.034 : 0.04;
    const double clearance = GENERATE(1.0, 2.0) * radius;
    const TriangleMesh mesh = GENERATE(
        test::make_hull({10, 2, 1.8}, 4000),
        test::turned(test::make_box_mesh(Vec3(8, 3, 3)), 5));  // triangles long enough to be split
    const LatticeFill fill = fill_lattice_rows(mesh, {kind, radius, clearance, 3, false});
    const SurfaceTree tree(mesh);
    CHECK(fill.frame.rows() * static_cast<std::size_t>(fill.frame.count[0]) > 100000);
    CHECK(fill.bits == test::BlockDecider(tree, fill.frame, clearance).decide());
}

TEST_CASE("slivers and triangles without area change nothing", "[lattice][degenerate]") {
    // the long edge of each face is split at a point off it by rounding, or not at all
    TriangleMesh mesh = test::make_box_mesh(Vec3(3, 2, 1));
    const LatticeFill plain = fill_lattice_rows(mesh, {LatticeKind::cubic, 0.05, 0.05, 3, false});
    const double off = GENERATE(0.0, 1e-15, 1e-12);
    const std::size_t count = mesh.triangles.size();
    for (std::size_t t = 0; t < count; ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        const Vec3 middle = 0.5 * (mesh.corner(t, 0) + mesh.corner(t, 1)) +
                            off * (mesh.corner(t, 2) - mesh.corner(t, 0));
        const auto m = static_cast<std::int32_t>(mesh.vertices.size());
        mesh.vertices.push_back(middle);
        mesh.triangles[t] = {a, m, c};
        mesh.triangles.push_back({m, b, c});
        mesh.triangles.push_back({a, b, m});  // the sliver
    }
    const LatticeFill fill = fill_lattice_rows(mesh, {LatticeKind::cubic, 0.05, 0.05, 3, false});
    CHECK(fill.count == 30 * 20 * 10);
    CHECK(fill.bits == plain.bits);
}

TEST_CASE("a hexagonal lattice touches twelve neighbours and fills 0.74 of a large box",
          "[lattice][analytic]") {
    const double radius = 0.05;
    const LatticeFill fill = fill_lattice_rows(test::make_box_mesh(Vec3(4, 3, 3)),
                                               {LatticeKind::hexagonal, radius, radius, 3, true});
    const LatticeFrame& frame = fill.frame;
    const auto j0 = frame.count[1] / 2 + GENERATE(0, 1), k0 = frame.count[2] / 2 + GENERATE(0, 1);
    const Vec3 middle = frame.point(frame.count[0] / 2, j0, k0);
    std::vector<Vec3> centers(fill.count);
    expand(fill, centers);
    int touching = 0;
    for (const Vec3& c : centers) {
        const double distance = (c - middle).norm();
        if (distance == 0.0) continue;
        REQUIRE(distance >= 2 * radius * (1 - tolerance(1e-12)));
        touching += distance < 2 * radius * (1 + 1e-12);
    }
    CHECK(touching == 12);
    // centres fill the box less R on all sides, give or take half a layer at each face
    const double expected = 3.9 * 2.9 * 2.9 / (4 * std::sqrt(2.0) * std::pow(radius, 3));
    CHECK(static_cast<double>(fill.count) == Near(expected).epsilon(0.05));
}

TEST_CASE("a symmetric hull's fill is symmetric, bit for bit", "[lattice][property]") {
    const auto kind = GENERATE(LatticeKind::cubic, LatticeKind::hexagonal);
    const LatticeFill fill =
        fill_lattice_rows(test::make_hull({10, 1.93, 1.8}, 5000), {kind, 0.03, 0.03, 3, true});
    const LatticeFrame& frame = fill.frame;
    for (std::int64_t k = 0; k < frame.count[2]; ++k)
        for (std::int64_t j = 0; j < frame.count[1]; ++j) {
            const std::int64_t image = frame.count[1] - 1 - j;
            REQUIRE(frame.y(j) == -frame.y(image));
            REQUIRE(frame.z(j, k) == frame.z(image, k));
            REQUIRE(frame.start(j, k) == frame.start(image, k));
            for (std::size_t w = 0; w < frame.words(); ++w)
                REQUIRE(fill.bits[frame.row(j, k) * frame.words() + w] ==
                        fill.bits[frame.row(image, k) * frame.words() + w]);
        }
    CHECK(fill.count > 10000);
    // symmetry cost no points: the same lattice without it holds them all
    LatticeBits free = rows_inside(test::make_hull({10, 1.93, 1.8}, 5000), frame);
    clear_near(test::make_hull({10, 1.93, 1.8}, 5000), frame, 0.03 * (1 - 1e-9), free);
    CHECK(free == fill.bits);
}

TEST_CASE("the lattice has the same bits for 1, 2, 3 and 8 threads", "[lattice][determinism]") {
    const TriangleMesh hull = test::make_hull({50, 10, 9}, 20000);
    const auto fill_with = [&](int threads) {
        set_thread_count(threads);
        return fill_lattice_rows(hull, {LatticeKind::hexagonal, 0.1, 0.1, 3, true});
    };
    const LatticeFill one = fill_with(1);
    std::vector<Vec3> expected(one.count), centers(one.count);
    expand(one, expected);
    for (const int threads : {2, 3, 8}) {
        const LatticeFill other = fill_with(threads);
        CHECK(other.bits == one.bits);
        REQUIRE(other.count == one.count);
        expand(other, centers);
        CHECK(centers == expected);
    }
    set_thread_count(2);
}

TEST_CASE("runs name the points whose bits are set, in order", "[lattice][equivalence]") {
    const LatticeFill fill = fill_lattice_rows(test::make_torus(3.0, 1.0, 40, 16),
                                               {LatticeKind::hexagonal, 0.02, 0.02, 3, true});
    CHECK(fill.frame.words() > 2);  // runs cross the ends of words
    std::vector<Vec3> centers(fill.count), expected;
    expand(fill, centers);
    for (const Site& site : sites(fill.frame, fill.bits))
        if (site.set) expected.push_back(site.at);
    CHECK(centers == expected);
}

TEST_CASE("outer spheres are those without all six neighbours, four in 2D", "[lattice][analytic]") {
    const int dimension = GENERATE(2, 3);
    const LatticeFill fill = fill_lattice_rows(test::make_l_prism(),
                                               {LatticeKind::cubic, 0.125, 0.125, dimension, true});
    std::map<std::array<std::int64_t, 3>, bool> set;
    std::vector<bool> expected;
    for (const LatticeRun& run : fill.runs)
        for (std::int64_t i = run.first; i < run.first + run.count; ++i)
            set[{i, run.j, run.k}] = true;
    for (const LatticeRun& run : fill.runs)
        for (std::int64_t i = run.first; i < run.first + run.count; ++i) {
            int neighbours = 0;
            for (std::int64_t d : {-1, 1}) {
                neighbours += set.contains({i + d, run.j, run.k});
                neighbours += set.contains({i, run.j + d, run.k});
                neighbours += set.contains({i, run.j, run.k + d});
            }
            expected.push_back(neighbours < 2 * dimension);
        }
    const auto outer = outer_spheres(fill, dimension);
    CHECK(std::vector<bool>(outer.begin(), outer.end()) == expected);
    CHECK(fill.count == (dimension == 3 ? 8u : 1u) * (16 * 16 - 8 * 8));
}

TEST_CASE("a lattice of 1e9 points is refused, an empty mesh takes none", "[lattice][errors]") {
    CHECK_THROWS_WITH(place_lattice(test::make_box_mesh(Vec3(1000, 800, 300)),
                                    LatticeKind::hexagonal, 0.1, 3, true),
                      Catch::Contains("lattice points") && Catch::Contains("--units"));
    CHECK(fill_lattice_rows({}, {}).count == 0);
}
