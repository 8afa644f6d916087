// SPDX-License-Identifier: GPL-3.0-or-later
// The guarantees of docs/spherize.md for sphere sets, on every mesh of the project, in 3D and 2D.
//
// Tolerances: 1e-6 R is where the fill settles; 1e-12 is rounding of a sum; 2 % is a disc more or
// less along a side; 1e-6 degrees is rounding of an angle's inverse cosine near 1.
#include <algorithm>
#include <catch2/catch.hpp>

#include "preprocess/fill/fill_spheres.hpp"
#include "preprocess/load/read_mesh.hpp"
#include "preprocess/repair/make_solid.hpp"
#include "tests/preprocess/check_shares.hpp"
#include "tests/preprocess/lattice_solids.hpp"
#include "tests/preprocess/solid_oracle.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

TriangleMesh read_solid(const std::string& name) {
    const std::string file = ICE_SOURCE_DIR "/meshes/" + name;
    Repairs repairs;
    return make_solid(read_mesh(file, {}), file, {}, repairs);
}

void check_certificate(const SpheresReport& report) {
    CHECK(report.protrusion_max <= tolerance(1e-6) * report.radius);
    CHECK(report.covering_radius <= 0.65 * report.spacing);
    CHECK(report.normal_error_mean_deg <= 1.0);
    CHECK(report.warnings.empty());
}

}  // namespace

TEST_CASE("every mesh of the project: touch, cover, count, normals and shares are as promised",
          "[fill][guarantee]") {
    const auto [name, radius] =
        GENERATE(table<const char*, double>({{"paper-floe-2d.obj", 0.05},
                                             {"paper-floe-3d.obj", 0.05},
                                             {"paper-hull-2d.obj", 0.1},
                                             {"paper-hull-3d.obj", 0.1},
                                             {"icebreaker-100m.obj", 0.3}}));
    CAPTURE(name, radius);
    SpheresReport report;
    const SphereSet set = fill_spheres(read_solid(name), {radius}, report);
    check_certificate(report);
    test::check_shares(set);
    // each sphere of a hexagonal layer stands for sqrt(3) / 2 of the spacing squared
    const double ideal = set.solid.area / (std::sqrt(0.75) * set.spacing * set.spacing);
    CHECK(static_cast<double>(report.surface_spheres) <= 1.08 * ideal);
}

TEST_CASE("every mesh of the project as a lattice: inside, by its certificate, with exact shares",
          "[fill][guarantee]") {
    const auto [name, radius] = GENERATE(table<const char*, double>(
        {{"paper-floe-3d.obj", 0.04}, {"paper-hull-3d.obj", 0.1}, {"icebreaker-100m.obj", 0.5}}));
    CAPTURE(name, radius);
    SpheresReport report;
    const SphereSet set =
        fill_spheres(read_solid(name), {radius, 0.0, Arrangement::lattice}, report);
    CHECK(report.protrusion_max <= tolerance(1e-6) * radius);
    test::check_shares(set);
}

TEST_CASE("sections of every mesh of the project keep the same promises", "[fill][2d][guarantee]") {
    const auto [name, radius] =
        GENERATE(table<const char*, double>({{"paper-floe-2d.obj", 0.05},
                                             {"paper-hull-2d.obj", 0.1},
                                             {"paper-hull-3d.obj", 0.1},
                                             {"icebreaker-100m.obj", 0.1}}));
    CAPTURE(name, radius);
    const TriangleMesh solid = read_solid(name);
    SpheresReport report;
    const SphereSet set = fill_discs(slice_solid(solid, 0.0), solid.region_names, {radius}, report);
    check_certificate(report);
    test::check_shares(set);
    for (const Vec3& c : set.centers) REQUIRE(c.y() == 0.0);
    // an outline needs a disc for each spacing of its length, and one more for each piece
    CHECK(static_cast<double>(report.surface_spheres) * set.spacing <= 1.08 * set.solid.area);
    // by CGAL, in a prism so broad that its ends are far
    TriangleMesh broad = set.mesh;
    for (Vec3& v : broad.vertices) v.y() *= 1000.0;
    const auto answers = test::ask_oracle(broad, set.centers);
    for (std::size_t k = 0; k < set.size(); ++k) {
        REQUIRE(answers[k].inside);
        REQUIRE(answers[k].distance >= radius * (1 - tolerance(1e-6)));
        if (set.on_surface(k)) REQUIRE(answers[k].distance <= radius * (1 + tolerance(1e-6)));
    }
}

TEST_CASE("a section with a hole and a second body has discs and shares on all of its loops",
          "[fill][2d][guarantee]") {
    // a square of 1 x 1 m, beside it a frame of 2 x 2 m with a hole of 1 x 1 m
    Section section = slice_solid(test::make_box_mesh(Vec3(1, 1, 1)), 0.0);
    const auto aside = [](Section s) {
        for (SectionEdge& edge : s.loops[0]) {
            edge.a.x() -= 3.0;
            edge.b.x() -= 3.0;
        }
        return s.loops[0];
    };
    std::vector<SectionEdge> hole = aside(section);
    std::reverse(hole.begin(), hole.end());
    for (SectionEdge& edge : hole) {
        std::swap(edge.a, edge.b);
        edge.normal = -edge.normal;
    }
    section.loops.push_back(aside(slice_solid(test::make_box_mesh(Vec3(2, 2, 2)), 0.0)));
    section.loops.push_back(hole);
    SpheresReport report;
    const SphereSet set = fill_discs(section, {"hull"}, {0.05}, report);
    check_certificate(report);
    test::check_shares(set);
    CHECK(set.solid.volume == Near(4.0).epsilon(1e-12));
    CHECK(set.solid.area == Near(8.0 + 4.0 + 4.0).epsilon(1e-12));
    double outer = 0.0, inner = 0.0, beside = 0.0;
    for (std::size_t k = 0; k < set.surface_count; ++k) {
        const Vec3 c = set.centers[k];
        const double square = std::max(std::abs(c.x() + 3.0), std::abs(c.z()));
        (c.x() > -1.5 ? beside : square > 0.75 ? outer : inner) += set.areas[k];
    }
    CHECK(outer == Near(8.0).epsilon(0.02));
    CHECK(inner == Near(4.0).epsilon(0.02));
    CHECK(beside == Near(4.0).epsilon(0.02));
}

TEST_CASE(
    "polygons of any turn have a disc in each corner and no more discs than their outline asks",
    "[fill][2d][guarantee]") {
    // the discs stand on the polygon of the same angles round a circle that is R less
    const int corners = GENERATE(3, 5, 6, 8, 12, 100, 1000);
    const double inscribed = 2.0 * std::cos(std::numbers::pi / corners), radius = 0.1;
    CAPTURE(corners);
    std::vector<std::array<double, 2>> outline;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / corners + 0.1;
        outline.push_back({2.0 * std::cos(angle), 2.0 * std::sin(angle)});
    }
    SpheresReport report;
    const SphereSet set = fill_discs(slice_solid(test::make_prism(outline, 0.5), 0.0), {"hull"},
                                     {radius, 0.0, Arrangement::conforming, true}, report);
    const double side =
        2.0 * (inscribed - radius) * std::tan(std::numbers::pi / corners) / set.spacing;
    // a side is cut into equal parts, where it turns by less than 20 degrees together with others
    const double wanted = corners > 18 ? corners * side : corners * std::ceil(side - 1e-9);
    CHECK(static_cast<double>(set.size()) <= 1.01 * wanted + 1.0);
    if (corners > 18) return;
    int met = 0;
    for (const double spread : set.normal_spread)
        met += std::abs(spread - std::numbers::pi / corners) < 1e-6;
    CHECK(met == corners);
    CHECK(report.normal_error_mean_deg < tolerance(1e-6));
}
