// SPDX-License-Identifier: GPL-3.0-or-later
// Units and axes that nobody gave: what is guessed, and what must be left alone.
//
// Tolerances: 1e-12 is rounding of sums over triangles.
#include <catch2/catch.hpp>

#include "preprocess/load/choose_frame.hpp"
#include "preprocess/load/half_hull.hpp"
#include "preprocess/load/hull_axes.hpp"
#include "preprocess/load/main_parts.hpp"
#include "preprocess/load/read_mesh.hpp"
#include "preprocess/load/symmetry.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

TriangleMesh mapped(TriangleMesh mesh, const Mat3& by) {
    for (Vec3& v : mesh.vertices) v = by * v;
    if (by.determinant() < 0.0)
        for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

Mat3 rows(const Vec3& a, const Vec3& b, const Vec3& c) {
    Mat3 m;
    m << a.transpose(), b.transpose(), c.transpose();
    return m;
}

// A hull with its bow at +x: a Wigley hull drawn out to full breadth aft. 10 x 2 x 1 m.
TriangleMesh make_ship(double length = 10, double breadth = 2, double depth = 1) {
    TriangleMesh mesh = test::make_wigley(length, breadth, depth, 24, 8);
    for (Vec3& v : mesh.vertices) {
        if (v.x() >= 0.0) continue;
        const double along = 2.0 * v.x() / length;
        if (1.0 - along * along > 0.25) v.y() /= 1.0 - along * along;
    }
    return mesh;
}

// A floe of irregular outline, flat above and below.
TriangleMesh make_floe() {
    TriangleMesh mesh;
    const double outline[5][2] = {{0, 0}, {3.1, 0.2}, {4, 1.1}, {2.2, 1.9}, {0.3, 1.2}};
    for (const double z : {-0.2, 0.2})
        for (const auto& p : outline) mesh.vertices.emplace_back(p[0], p[1], z);
    for (int k = 0; k < 5; ++k) {
        const int n = (k + 1) % 5;
        mesh.triangles.push_back({k, n, n + 5});
        mesh.triangles.push_back({k, n + 5, k + 5});
        if (k > 0 && k < 4) {
            mesh.triangles.push_back({0, k + 1, k});
            mesh.triangles.push_back({5, k + 5, k + 6});
        }
    }
    mesh.region.assign(mesh.triangles.size(), 0);
    return mesh;
}

struct Chosen {
    Frame frame;
    ReadNotes notes;
};

Chosen choose(const TriangleMesh& mesh, const ReadOptions& options = {},
              const FileFrame& file = {}) {
    Chosen c;
    c.frame = choose_frame(mesh, file, options, c.notes);
    return c;
}

const Vec3 X = Vec3::UnitX(), Y = Vec3::UnitY(), Z = Vec3::UnitZ();

}  // namespace

TEST_CASE("boxes, floes and this repository's meshes are never turned", "[load][frame]") {
    for (const Vec3& size : {Vec3(1, 0.8, 0.3), Vec3(0.8, 1, 0.3), Vec3(0.3, 0.8, 1), Vec3(9, 1, 1),
                             Vec3(1, 9, 1), Vec3(1, 2, 9)}) {
        CAPTURE(size.transpose());
        CHECK(choose(test::make_box_mesh(size)).frame.matrix() == Mat3::Identity());
    }
    for (const Mat3& turn : {rows(X, Y, Z), rows(Y, X, Z), rows(X, Z, Y), rows(Z, Y, X)}) {
        CAPTURE(turn);
        CHECK(choose(mapped(make_floe(), turn)).frame.matrix() == Mat3::Identity());
    }
    CHECK(choose(make_floe()).notes.warnings.empty());
    CHECK(choose(test::make_globe(1, 12)).frame.matrix() == Mat3::Identity());
    for (const char* name : {"paper-floe-2d", "paper-floe-3d", "paper-hull-2d", "paper-hull-3d",
                             "hull-stem-25", "hull-stem-50", "icebreaker-100m"}) {
        CAPTURE(name);
        ReadNotes notes;
        const TriangleMesh mesh = read_mesh(
            std::filesystem::path(ICE_SOURCE_DIR) / "meshes" / (std::string(name) + ".obj"), {},
            &notes);
        CHECK(notes.warnings.empty());
        CHECK(choose(mesh).frame.matrix() == Mat3::Identity());
    }
}

TEST_CASE("a hull drawn in any upright way comes out with its bow ahead and its deck up",
          "[load][frame]") {
    const TriangleMesh ship = make_ship();
    CHECK(choose(ship).frame.matrix() == Mat3::Identity());
    CHECK(choose(ship).notes.warnings.empty());

    // rows: the file's axes in the ship frame
    struct Case {
        Mat3 drawn;
        const char *up, *forward;
    };
    for (const Case& c : {Case{rows(Y, -X, Z), "z", "-y"}, Case{rows(-Y, X, Z), "z", "+y"},
                          Case{rows(X, Z, -Y), "y", "+x"}, Case{rows(Y, Z, X), "y", "+z"},
                          Case{rows(-Y, Z, -X), "y", "-z"}}) {
        CAPTURE(c.up, c.forward);
        REQUIRE(c.drawn.determinant() == Near(1.0));
        const Chosen chosen = choose(mapped(ship, c.drawn));
        CHECK(chosen.frame.matrix() * c.drawn == Mat3::Identity());
        CHECK(chosen.notes.guessed.at("up").substr(0, 1) == c.up);
        CHECK(chosen.notes.guessed.at("forward").substr(0, 2) == c.forward);
        CHECK(chosen.notes.warnings.empty());
    }
    CHECK(choose(mapped(ship, rows(Y, Z, X))).notes.guessed.at("forward") ==
          "+z, because the hull is longest along z and finer at that end");
    CHECK(choose(mapped(ship, rows(Y, Z, X))).notes.guessed.at("up") ==
          "y, because the hull is symmetric across x and longest along z");
}

TEST_CASE("doubt about a hull's axes is a warning, not a turn", "[load][frame]") {
    const auto only_warning = [](const Chosen& c) {
        REQUIRE(c.notes.warnings.size() == 1);
        return c.notes.warnings[0];
    };
    // stern first
    const Chosen astern = choose(mapped(make_ship(), Vec3(-1, -1, 1).asDiagonal()));
    CHECK(astern.frame.matrix() == Mat3::Identity());
    CHECK(only_warning(astern) == "the bow seems to point to -x: give --forward -x if so");
    // double-ended, along y
    const Chosen ended = choose(mapped(test::make_wigley(10, 2, 1, 24, 8), rows(-Y, X, Z)));
    CHECK(ended.frame.forward == Direction{1, true});
    CHECK(only_warning(ended).find("which end is the bow") != std::string::npos);
    // and along x, which forward has anyway
    const Chosen along_x = choose(test::make_wigley(10, 2, 1, 24, 8));
    CHECK(along_x.frame.matrix() == Mat3::Identity());
    CHECK(along_x.notes.guessed.at("forward") == "+x");
    CHECK(only_warning(along_x) ==
          "which end is the bow cannot be seen: give --forward -x if it is at -x");
    // full shoulders against a transom, stern first
    const TriangleMesh paper =
        read_mesh(std::filesystem::path(ICE_SOURCE_DIR) / "meshes" / "paper-hull-3d.obj", {});
    CHECK(only_warning(choose(mapped(paper, Vec3(-1, -1, 1).asDiagonal()))) ==
          "the bow seems to point to -x: give --forward -x if so");
    // deeper than wide with y up: could be a bevelled floe
    const Chosen deep = choose(mapped(make_ship(10, 1, 2), rows(X, Z, -Y)));
    CHECK(deep.frame.matrix() == Mat3::Identity());
    CHECK(only_warning(deep).find("give --up y") != std::string::npos);
    // standing on its transom
    const Chosen standing = choose(mapped(make_ship(), rows(-Z, Y, X)));
    CHECK(standing.frame.matrix() == Mat3::Identity());
    CHECK(only_warning(standing).find("longest along z") != std::string::npos);
}

TEST_CASE("a hull upside down is doubted, and --up turns it", "[load][frame]") {
    const Mat3 over = rows(X, -Y, -Z);
    for (const char* name : {"paper-hull-3d", "hull-stem-25", "hull-stem-50", "icebreaker-100m"}) {
        CAPTURE(name);
        const TriangleMesh drawn = mapped(read_mesh(std::filesystem::path(ICE_SOURCE_DIR) /
                                                        "meshes" / (std::string(name) + ".obj"),
                                                    {}),
                                          over);
        const Chosen chosen = choose(drawn);
        CHECK(chosen.frame.matrix() == Mat3::Identity());
        REQUIRE(chosen.notes.warnings.size() == 1);
        CHECK(chosen.notes.warnings[0] ==
              "the hull is broader at the bottom than at the top: it may be upside down; give --up "
              "-z if so");
        ReadOptions options;
        options.up = "-z";
        CHECK(choose(drawn, options).frame.matrix() * over == Mat3::Identity());
        CHECK(choose(drawn, options).notes.warnings.empty());
    }
    // in a file with y up
    const FileFrame file{"FBX", 1.0, Direction{1, true}, Direction{0, true}, false};
    const TriangleMesh along_y = mapped(make_ship(), rows(X, -Z, Y));
    REQUIRE(choose(along_y, {}, file).notes.warnings.size() == 1);
    CHECK_THAT(choose(along_y, {}, file).notes.warnings[0], Catch::Contains("give --up -y if so"));
    ReadOptions options;
    options.up = "-y";
    CHECK(choose(along_y, options, file).frame.matrix() * rows(X, -Z, Y) == Mat3::Identity());
}

TEST_CASE("a pontoon with a house on it is not upside down", "[load][frame]") {
    TriangleMesh barge = test::make_box_mesh(Vec3(20, 6, 2));
    TriangleMesh house = test::make_box_mesh(Vec3(4, 4, 3));
    for (Vec3& v : house.vertices) v += Vec3(-6, 0, 2.5);
    const auto n = static_cast<std::int32_t>(barge.vertices.size());
    barge.vertices.insert(barge.vertices.end(), house.vertices.begin(), house.vertices.end());
    for (const auto& t : house.triangles) {
        barge.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
        barge.region.push_back(0);
    }
    CHECK_FALSE(narrows_upwards(barge, {}, true));
    // with raked ends, and the same upside down
    for (Vec3& v : barge.vertices)
        if (v.z() < -0.5) v.x() *= 0.8;
    CHECK_FALSE(narrows_upwards(barge, {}, true));
    TriangleMesh raked = test::make_box_mesh(Vec3(20, 6, 2));
    for (Vec3& v : raked.vertices)
        if (v.z() < 0.0) v.x() *= 0.8;
    CHECK_FALSE(narrows_upwards(raked, {}, true));
    CHECK(narrows_upwards(raked, {}, false));
    CHECK_FALSE(narrows_upwards(TriangleMesh{}, {}, true));
}

TEST_CASE("an open half hull in other axes is named", "[load][frame]") {
    // the port half of an open hull: the keel, stem and stern lie in the centre plane
    TriangleMesh whole = make_ship();
    for (Vec3& v : whole.vertices) v.z() += 0.3;  // the open deck in no plane of the axes
    TriangleMesh half;
    half.vertices = whole.vertices;
    for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
        const bool port =
            (whole.corner(t, 0).y() + whole.corner(t, 1).y() + whole.corner(t, 2).y()) > 1e-9;
        if (port && whole.area_vector(t).normalized().z() < 0.999)
            half.triangles.push_back(whole.triangles[t]);
    }
    half.region.assign(half.triangles.size(), 0);
    CHECK(choose(half).notes.warnings.empty());
    CHECK(is_open_half(half));
    const Chosen turned = choose(mapped(half, rows(X, Z, -Y)));
    CHECK(turned.frame.matrix() == Mat3::Identity());
    REQUIRE(turned.notes.warnings.size() == 1);
    CHECK(turned.notes.warnings[0].find("open along z = 0") != std::string::npos);
}

TEST_CASE("options and files overrule what the mesh looks like", "[load][frame]") {
    const TriangleMesh drawn = mapped(make_ship(), rows(Y, Z, X));  // y up, bow at +z
    ReadOptions options;
    options.up = "z";
    options.forward = "+x";
    CHECK(choose(drawn, options).frame.matrix() == Mat3::Identity());
    CHECK_FALSE(choose(drawn, options).notes.guessed.contains("up"));
    CHECK_FALSE(choose(drawn, options).notes.guessed.contains("forward"));
    options = {};
    options.up = "y";
    CHECK(choose(drawn, options).frame.forward == Direction{2, true});
    options = {};
    options.forward = "-z";
    CHECK(choose(drawn, options).frame.up == Direction{1, true});
    CHECK(choose(drawn, options).frame.forward == Direction{2, false});
    // forward along y leaves z for up
    options.forward = "+y";
    CHECK(choose(drawn, options).frame.up == Direction{2, true});

    FileFrame file{"FBX", 0.01, Direction{1, true}, Direction{2, false}, false};
    CHECK(choose(drawn, {}, file).frame.forward == Direction{2, false});
    CHECK(choose(drawn, {}, file).notes.guessed.at("forward") == "-z, as the FBX file says");
    // its front across the hull is a habit of the program, not the bow
    const TriangleMesh along_x = mapped(make_ship(), rows(X, Z, -Y));
    CHECK(choose(along_x, {}, file).frame.forward == Direction{0, true});
    CHECK(choose(test::make_box_mesh(Vec3(1, 1, 3)), {}, file).frame.forward == Direction{0, true});
}

TEST_CASE("units are guessed from the length only where metres are impossible", "[load][frame]") {
    const auto units = [](double length) {
        return choose(test::make_box_mesh(Vec3(length, 0.5 * length, 0.2 * length)));
    };
    // a floe of 0.3 m, a ship of 500 m
    for (const double length : {0.05, 0.3, 1.0, 100.0, 500.0, 600.0}) {
        CAPTURE(length);
        CHECK(units(length).frame.metres == 1.0);
        CHECK(units(length).notes.warnings.empty());
        CHECK(units(length).notes.guessed.at("units") == "m, as the file has them");
    }
    for (const double length : {1000.0, 9000.0, 300000.0, 600000.0}) {
        CAPTURE(length);
        CHECK(units(length).frame.metres == 1e-3);
        CHECK(units(length).notes.warnings.empty());
    }
    CHECK(units(9000).notes.guessed.at("units") ==
          "mm, because the solid would be 9000 m long in metres");
    for (const double length : {0.01, 601.0, 999.0, 600001.0}) {
        CAPTURE(length);
        CHECK(units(length).frame.metres == 1.0);
        REQUIRE(units(length).notes.warnings.size() == 1);
        CHECK(units(length).notes.warnings[0].find("--units") != std::string::npos);
    }
    ReadOptions options;
    options.scale = 1.0;
    const Chosen told = choose(test::make_box_mesh(Vec3(9000, 900, 900)), options);
    CHECK(told.frame.metres == 1.0);
    CHECK_FALSE(told.notes.guessed.contains("units"));
    REQUIRE(told.notes.warnings.size() == 1);  // 9 km
    CHECK(told.notes.warnings[0] ==
          "the solid is 9e+03 m long: if that is wrong, correct --units or --scale");
}

TEST_CASE("a stray triangle, an island, a sea plane and a domain's box fool no guess of units",
          "[load][frame]") {
    // a ship of 10 m; with these things the box is 60 to 3000 m long, as of one in millimetres
    const TriangleMesh ship = make_ship();
    const auto with = [&](const TriangleMesh& more) {
        TriangleMesh mesh = ship;
        const auto n = static_cast<std::int32_t>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
        for (const auto& t : more.triangles) {
            mesh.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
            mesh.region.push_back(0);
        }
        return mesh;
    };
    const auto moved = [](TriangleMesh mesh, const Vec3& by) {
        for (Vec3& v : mesh.vertices) v += by;
        return mesh;
    };
    TriangleMesh stray;
    stray.vertices = {Vec3(3000, 0, 0), Vec3(3000, 1, 0), Vec3(3000, 0, 1)};
    stray.triangles = {{0, 1, 2}};
    stray.region = {0};
    TriangleMesh sea;
    sea.vertices = {Vec3(-900, -900, 0.3), Vec3(900, -900, 0.3), Vec3(900, 900, 0.3)};
    sea.triangles = {{0, 1, 2}};
    sea.region = {0};
    for (const TriangleMesh& more : {stray, sea, moved(test::make_globe(1, 12), Vec3(3000, 500, 0)),
                                     test::make_box_mesh(Vec3(2000, 1500, 1000))}) {
        std::int64_t left_out = 0;
        const auto main = main_parts(with(more), left_out);
        REQUIRE(main);
        CHECK(main->triangles.size() == ship.triangles.size());
        CHECK(left_out == 1);
        const Chosen chosen = choose(with(more));
        CHECK(chosen.frame.matrix() == Mat3::Identity());
        CHECK(chosen.notes.guessed.at("units") == "m, as the file has them");
        REQUIRE(chosen.notes.warnings.size() == 1);
        CHECK_THAT(chosen.notes.warnings[0], Catch::Contains("guessed without 1 part"));
    }
    // what lies beside it and touches nothing counts
    std::int64_t left_out = -1;
    const TriangleMesh pair = with(moved(ship, Vec3(0, 5, 0)));
    CHECK_FALSE(main_parts(pair, left_out));
    CHECK(left_out == 0);
}

TEST_CASE("a model of 152 mm and a boat that lies athwart are doubted", "[load][frame]") {
    CHECK_THAT(choose(make_ship(152, 30, 20)).notes.guessed.at("length"),
               Catch::Contains("0.152 m if the file is in millimetres"));
    CHECK_FALSE(choose(make_ship()).notes.guessed.contains("length"));
    // 15.8 m along y, 6.7 m along x, no plane of symmetry
    TriangleMesh boat = test::make_globe(1, 16);
    for (Vec3& v : boat.vertices)
        v = Vec3(3.35 * v.x() + 0.8 * v.x() * v.y(), 7.9 * v.y(), 2.0 * v.z() + 0.5 * v.x());
    const Chosen athwart = choose(boat);
    REQUIRE_FALSE(athwart.notes.warnings.empty());
    CHECK_THAT(athwart.notes.warnings.front(), Catch::Contains("--forward"));
}

TEST_CASE("sides meshed unlike each other are still symmetric", "[load][frame]") {
    // starboard from a mesh of half the stations and levels
    const TriangleMesh fine = test::make_wigley(10, 2, 1, 48, 16);
    const TriangleMesh coarse = test::make_wigley(10, 2, 1, 24, 8);
    TriangleMesh mixed;
    for (const auto& [mesh, sign] : {std::pair{&fine, 1.0}, std::pair{&coarse, -1.0}})
        for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
            const Vec3 middle =
                (mesh->corner(t, 0) + mesh->corner(t, 1) + mesh->corner(t, 2)) / 3.0;
            if (middle.y() * sign <= 0.0) continue;
            const auto n = static_cast<std::int32_t>(mixed.vertices.size());
            for (int k = 0; k < 3; ++k) mixed.vertices.push_back(mesh->corner(t, k));
            mixed.triangles.push_back({n, n + 1, n + 2});
            mixed.region.push_back(0);
        }
    CHECK(asymmetry(mixed, 1) < 0.5 * kSymmetric);
    CHECK(asymmetry(mixed, 1) > 0.0);
    CHECK(asymmetry(mixed, 2) > 2.0 * kLopsided);
    CHECK(find_hull_axes(mixed).has_value());
}

TEST_CASE("the finer end has the narrower sections", "[load][frame][analytic]") {
    // breadth falls from 2 at x = 0 to 1 at x = 10: at 8 % (the mean) 1.92 and 1.08
    TriangleMesh wedge = test::make_box_mesh(Vec3(10, 2, 1));
    for (Vec3& v : wedge.vertices) {
        v.x() += 5.0;
        v.y() *= 1.0 - 0.05 * v.x();
    }
    CHECK(fineness_ratio(wedge, {}) == Near(1.92 / 1.08).epsilon(1e-12));
    // at 0.5 % 1.995 and 1.005
    CHECK(tip_ratio(wedge, {}) == Near(1.995 / 1.005).epsilon(1e-12));
    CHECK(fineness_ratio(TriangleMesh{}, {}) == 1.0);
    CHECK(tip_ratio(TriangleMesh{}, {}) == 1.0);
}
