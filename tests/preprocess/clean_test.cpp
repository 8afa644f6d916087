// SPDX-License-Identifier: GPL-3.0-or-later
// Welding and the diagnosis of what is no solid.
//
// Tolerances: 1e-14 is rounding of a sum over a box's triangles; 0.5 % and 1 % are facets in place
// of curved faces, of second order in their edges.
#include <catch2/catch.hpp>

#include "preprocess/clean/orient_faces.hpp"
#include "preprocess/clean/weld.hpp"
#include "preprocess/repair/check_solid.hpp"
#include "preprocess/repair/make_solid.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

// Every triangle with corners of its own, as in an STL file.
TriangleMesh unwelded(const TriangleMesh& mesh) {
    TriangleMesh out;
    out.region_names = mesh.region_names;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto first = static_cast<std::int32_t>(out.vertices.size());
        for (int k = 0; k < 3; ++k) out.vertices.push_back(mesh.corner(t, k));
        out.triangles.push_back({first, first + 1, first + 2});
        out.region.push_back(mesh.region[t]);
    }
    return out;
}

}  // namespace

TEST_CASE("welding gives a box its 8 corners back, equal corners are no repair", "[clean]") {
    TriangleMesh mesh = unwelded(test::make_box_mesh(Vec3(1, 0.8, 0.3)));
    const WeldCounts counts = weld(mesh);
    CHECK(mesh.vertices.size() == 8);
    CHECK(mesh.triangles.size() == 12);
    CHECK(counts.equal_vertices == 28);
    CHECK(counts.near_vertices == 0);
    CHECK(diagnose_solid(mesh).good());
}

TEST_CASE("degenerate and repeated triangles are dropped and counted", "[clean]") {
    TriangleMesh mesh = test::make_box_mesh(Vec3(1, 1, 1));
    const auto t = mesh.triangles[0];
    mesh.triangles.push_back({t[1], t[2], t[0]});  // the same one, other corner first
    mesh.triangles.push_back({0, 0, 1});
    mesh.region.resize(14, 0);
    const WeldCounts counts = weld(mesh);
    CHECK(counts.duplicate_triangles == 1);
    CHECK(counts.degenerate_triangles == 1);
    CHECK(diagnose_solid(mesh).good());
}

TEST_CASE("vertices a ten-millionth of the size apart are one", "[clean]") {
    TriangleMesh mesh = unwelded(test::make_box_mesh(Vec3(10, 2, 2)));
    for (std::size_t k = 0; k < mesh.vertices.size(); k += 2) mesh.vertices[k].x() += 1e-6;
    CHECK(weld(mesh).near_vertices > 0);
    CHECK(mesh.vertices.size() == 8);
}

TEST_CASE("each fault of a box is named and counted", "[clean][errors]") {
    TriangleMesh box = test::make_box_mesh(Vec3(1, 1, 1));
    SECTION("a missing triangle opens three edges") {
        box.triangles.pop_back();
        box.region.pop_back();
        const SolidDiagnosis d = diagnose_solid(box);
        CHECK(d.open_edges == 3);
        CHECK_FALSE(d.good());
        CHECK_THAT(d.text(), Catch::Contains("3 open edges"));
    }
    SECTION("a triangle turned over is inconsistent along three edges") {
        std::swap(box.triangles[0][1], box.triangles[0][2]);
        const SolidDiagnosis d = diagnose_solid(box);
        CHECK(d.inconsistent_edges == 3);
        CHECK_THAT(d.text(), Catch::Contains("face opposite ways"));
    }
    SECTION("a box turned inside out is known as that") {
        flip(box);
        const SolidDiagnosis d = diagnose_solid(box);
        CHECK(d.inside_out);
        CHECK_THAT(d.text(), Catch::Contains("inside out"));
    }
    SECTION("a corner pulled through the opposite face crosses it") {
        box.vertices[7] = Vec3(-2, -2, -2);
        const SolidDiagnosis d = diagnose_solid(box);
        CHECK(d.intersecting_pairs > 0);
        CHECK_THAT(d.text(), Catch::Contains("cross"));
    }
    SECTION("a fin glued to an edge crowds it") {
        box.vertices.emplace_back(3, 3, 3);
        box.triangles.push_back({0, 1, 8});
        box.region.push_back(0);
        CHECK(diagnose_solid(box).crowded_edges == 1);
    }
}

TEST_CASE("the curved test hull and globe are solids with the right volume", "[clean][analytic]") {
    const TriangleMesh globe = test::make_globe(1.0, 40);
    const TriangleMesh hull = test::make_wigley(10, 2, 1, 60, 16);
    CHECK(diagnose_solid(globe).text() == "");
    CHECK(diagnose_solid(hull).text() == "");
    CHECK(measure_mass(globe).volume == Near(4.0 / 3.0 * 3.14159265).epsilon(0.005));  // facets
    // L B T (2/3)^2 of parabolic waterlines and sections
    CHECK(measure_mass(hull).volume == Near(10 * 2 * 1 * 4.0 / 9.0).epsilon(0.01));
}

namespace {

// Adds a box at a place, turned inside out when told so.
void add_box(TriangleMesh& mesh, const Vec3& size, const Vec3& at, bool turned) {
    TriangleMesh part = test::make_box_mesh(size);
    if (turned) flip(part);
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (const Vec3& v : part.vertices) mesh.vertices.push_back(v + at);
    for (const auto& t : part.triangles)
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    mesh.region.insert(mesh.region.end(), part.triangles.size(), 0);
}

double solid_volume(const TriangleMesh& mesh, SolidKind kind, Repairs& repairs) {
    SolidOptions options;
    options.kind = kind;
    const TriangleMesh solid = make_solid(mesh, "test", options, repairs);
    CHECK(diagnose_solid(solid).good());
    return measure_mass(solid).volume;
}

}  // namespace

TEST_CASE("shells inside a hull: filled in the envelope, voids or skins in the material",
          "[clean][analytic]") {
    TriangleMesh mesh;
    Repairs repairs;
    add_box(mesh, Vec3(2, 2, 2), Vec3::Zero(), false);
    SECTION("an inward box inside is a void") {
        add_box(mesh, Vec3(1, 1, 1), Vec3::Zero(), true);
        CHECK(solid_volume(mesh, SolidKind::material, repairs) == Near(7).epsilon(1e-14));
        CHECK(repairs.empty());
        CHECK(solid_volume(mesh, SolidKind::envelope, repairs) == Near(8).epsilon(1e-14));
        CHECK(repairs == Repairs{{"surfaces inside the envelope dropped", 1}});
    }
    SECTION("an outward box inside is a second skin, not a second volume") {
        add_box(mesh, Vec3(1, 1, 1), Vec3::Zero(), false);
        CHECK(solid_volume(mesh, SolidKind::material, repairs) == Near(8).epsilon(1e-14));
        CHECK(repairs == Repairs{{"surfaces inside the material dropped", 1}});
        CHECK(solid_volume(mesh, SolidKind::envelope, repairs) == Near(8).epsilon(1e-14));
    }
    SECTION("a body inside a void is material again") {
        add_box(mesh, Vec3(1, 1, 1), Vec3::Zero(), true);
        add_box(mesh, Vec3(0.5, 0.5, 0.5), Vec3::Zero(), false);
        CHECK(solid_volume(mesh, SolidKind::material, repairs) == Near(7.125).epsilon(1e-14));
        CHECK(solid_volume(mesh, SolidKind::envelope, repairs) == Near(8).epsilon(1e-14));
    }
    SECTION("all of it inside out is the same solid, and said") {
        add_box(mesh, Vec3(1, 1, 1), Vec3::Zero(), true);
        flip(mesh);
        CHECK(solid_volume(mesh, SolidKind::material, repairs) == Near(7).epsilon(1e-14));
        CHECK(repairs == Repairs{{"inside-out surfaces turned over", 2}});
    }
    SECTION("a second body that faces inwards adds its volume instead of taking it away") {
        add_box(mesh, Vec3(1, 1, 1), Vec3(5, 0, 0), true);
        CHECK(solid_volume(mesh, SolidKind::envelope, repairs) == Near(9).epsilon(1e-14));
        CHECK(repairs == Repairs{{"inside-out surfaces turned over", 1}});
        SolidOptions strict;
        strict.mode = RepairMode::strict;
        CHECK_THROWS_WITH(make_solid(mesh, "ship.obj", strict, repairs),
                          Catch::Contains("ship.obj") && Catch::Contains("inside out"));
    }
}

TEST_CASE("a closed mesh keeps coordinates nearer than the welding tolerance", "[clean]") {
    TriangleMesh mesh;
    add_box(mesh, Vec3(100, 100, 100), Vec3::Zero(), false);
    add_box(mesh, Vec3(1e-5, 1e-5, 1e-5), Vec3(200, 0, 0), false);  // tolerance 2e-4
    const WeldCounts counts = weld(mesh);
    CHECK(mesh.vertices.size() == 16);
    CHECK(counts.near_vertices + counts.degenerate_triangles == 0);
}
