// SPDX-License-Identifier: GPL-3.0-or-later
// Each rung of the repair ladder against volumes known in closed form, and what must be refused.
//
// Tolerances: 1e-14 to 1e-9 are rounding of a sum over triangles; 0.2 % and more are cells or caps
// in place of the surface.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "common/geometry/edge_table.hpp"
#include "common/geometry/mass_properties.hpp"
#include "common/geometry/surface_tree.hpp"
#include "preprocess/clean/find_self_intersections.hpp"
#include "preprocess/clean/orient_faces.hpp"
#include "preprocess/repair/check_solid.hpp"
#include "preprocess/repair/make_solid.hpp"
#include "preprocess/repair/winding_solid.hpp"
#include "tests/support/damage_mesh.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

const Vec3 kSize(4, 2, 1);

void add_body(TriangleMesh& mesh, TriangleMesh body, const Vec3& at, bool turned = false) {
    if (turned) flip(body);
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (const Vec3& v : body.vertices) mesh.vertices.push_back(v + at);
    for (const auto& t : body.triangles)
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    mesh.region.insert(mesh.region.end(), body.region.begin(), body.region.end());
}

// Leaves out the triangles whose middle the condition holds for.
template <class Condition>
TriangleMesh without(TriangleMesh mesh, const Condition& condition) {
    TriangleMesh out = mesh;
    out.triangles.clear();
    out.region.clear();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
        if (condition(middle)) continue;
        out.triangles.push_back(mesh.triangles[t]);
        out.region.push_back(mesh.region[t]);
    }
    return out;
}

bool has(const Repairs& repairs, const std::string& step) {
    return std::any_of(repairs.begin(), repairs.end(),
                       [&](const auto& r) { return r.first == step; });
}

struct Result {
    TriangleMesh mesh;
    Repairs repairs;
    std::vector<std::string> warnings;
    double volume = 0.0;
};

Result repair(const TriangleMesh& mesh, const SolidOptions& options = {}) {
    Result out;
    out.mesh = make_solid(mesh, "ship.obj", options, out.repairs, &out.warnings);
    out.volume = measure_mass(out.mesh).volume;
    CHECK(diagnose_edges(out.mesh).closed());
    return out;
}

SolidOptions mode(RepairMode m) {
    SolidOptions options;
    options.mode = m;
    return options;
}

bool on_top(const Vec3& p) { return p.z() > 0.49; }

}  // namespace

TEST_CASE("a closed box goes through untouched", "[repair][analytic]") {
    const Result r = repair(test::make_box_mesh(kSize));
    CHECK(r.volume == Near(8).epsilon(1e-14));
    CHECK(r.repairs.empty());
    CHECK(r.warnings.empty());
    const TriangleMesh box = test::make_box_mesh(kSize);
    REQUIRE(r.mesh.triangles.size() == 12);
    for (std::size_t t = 0; t < 12; ++t)
        for (int k = 0; k < 3; ++k) CHECK(r.mesh.corner(t, k) == box.corner(t, k));
}

TEST_CASE("an open deck is closed, named and said, whichever way the sides face",
          "[repair][analytic]") {
    TriangleMesh box = without(test::make_box_mesh(kSize), on_top);
    REQUIRE(box.triangles.size() == 10);
    const bool inward = GENERATE(false, true);
    if (inward) flip(box);
    const Result r = repair(box);
    CHECK(r.volume == Near(8).epsilon(1e-14));
    CHECK(has(r.repairs, "deck closed by a cap"));
    CHECK(has(r.repairs, "inside-out surfaces turned over") == inward);
    REQUIRE(r.warnings.size() == 1);
    CHECK_THAT(r.warnings[0], Catch::Contains("8 m2") && Catch::Contains("0.5)"));
    CHECK(r.mesh.region_names.back() == "deck");
    CHECK(std::count(r.mesh.region.begin(), r.mesh.region.end(), 1) == 2);
}

TEST_CASE("a deck that follows a sheer line", "[repair]") {
    TriangleMesh hull = test::make_wigley(10, 2, 1, 40, 10);
    for (Vec3& v : hull.vertices) v.z() += 0.01 * v.x() * v.x();  // 0.25 m of sheer at the ends
    const double volume = measure_mass(hull).volume;
    const std::size_t sides = hull.triangles.size() - 80;
    hull.triangles.resize(sides + 2);  // all of the deck but one strip at the stern
    hull.region.resize(sides + 2);
    const Result r = repair(hull);
    CHECK(r.volume == Near(volume).epsilon(1e-3));
    CHECK(has(r.repairs, "deck closed by a cap"));
}

TEST_CASE("a triangle missing from a flat side is put back exactly", "[repair][analytic]") {
    for (std::size_t t = 0; t < 12; ++t) {
        TriangleMesh box = test::make_box_mesh(kSize);
        box.triangles.erase(box.triangles.begin() + static_cast<std::ptrdiff_t>(t));
        box.region.pop_back();
        const Result r = repair(box);
        CHECK(r.volume == Near(8).epsilon(1e-14));
        CHECK(has(r.repairs, "openings in flat faces closed"));
    }
}

TEST_CASE("faces turned at random, repeated and unwelded are one box again", "[repair][analytic]") {
    std::mt19937 random(5);
    TriangleMesh box = test::make_box_mesh(kSize);
    test::Damage damage;
    damage.turn = damage.duplicate = damage.split = true;
    const Result r = repair(test::damage_mesh(box, damage, random));
    CHECK(r.volume == Near(8).epsilon(1e-4));  // cracks of 3e-6 of the diagonal
    CHECK(r.mesh.vertices.size() == 8);
    CHECK(has(r.repairs, "triangles turned to agree with their neighbours"));
}

TEST_CASE("half a hull open along its centre plane is mirrored", "[repair][analytic]") {
    TriangleMesh half = test::make_box_mesh(kSize);
    for (Vec3& v : half.vertices) v.y() += 1.0;  // y from 0 to 2
    half = without(half, [](const Vec3& p) { return p.y() < 1e-9; });
    SECTION("closed otherwise") {}
    SECTION("with an open deck") { half = without(half, on_top); }
    SECTION("inside out") { flip(half); }
    const Result r = repair(half);
    CHECK(r.volume == Near(16).epsilon(1e-14));
    CHECK(has(r.repairs, "half hull mirrored across y = 0"));
}

TEST_CASE("overlapping bodies are united, each volume counted once", "[repair][analytic]") {
    TriangleMesh mesh;
    add_body(mesh, test::make_box_mesh(Vec3(2, 2, 2)), Vec3::Zero());
    SECTION("two boxes corner in corner") {
        add_body(mesh, test::make_box_mesh(Vec3(2, 2, 2)), Vec3(1.5, 0.1, 0.2),
                 GENERATE(false, true));
        const Result r = repair(mesh);
        CHECK(r.volume == Near(16 - 0.5 * 1.9 * 1.8).epsilon(1e-12));
        CHECK(has(r.repairs, "overlapping parts united"));
        CHECK(find_self_intersections(r.mesh).empty());
    }
    SECTION("a rudder through the side keeps its region") {
        TriangleMesh rudder = test::make_box_mesh(Vec3(1, 0.2, 0.5));
        rudder.region.assign(rudder.triangles.size(), 1);
        mesh.region_names.emplace_back("rudder");
        add_body(mesh, rudder, Vec3(-1.25, 0, -0.3));
        const Result r = repair(mesh);
        CHECK(r.volume == Near(8 + 0.75 * 0.2 * 0.5).epsilon(1e-12));
        double area = 0.0;
        for (std::size_t t = 0; t < r.mesh.triangles.size(); ++t)
            if (r.mesh.region[t] == 1) area += r.mesh.area_vector(t).norm();
        CHECK(area == Near(0.1 + 0.75 * 1.4).epsilon(1e-12));
    }
    SECTION("a superstructure without a bottom stands in the deck") {
        add_body(mesh,
                 without(test::make_box_mesh(Vec3(1, 1, 1)),
                         [](const Vec3& p) { return p.z() < -0.49; }),
                 Vec3(0, 0, 1.3));
        CHECK(repair(mesh).volume == Near(8 + 0.8).epsilon(1e-12));
    }
}

TEST_CASE("what would have to be guessed is refused, with place, size and remedy",
          "[repair][errors]") {
    TriangleMesh mesh = test::make_box_mesh(kSize);
    SECTION("a missing side") {
        mesh = without(mesh, [](const Vec3& p) { return p.y() > 0.99; });
    }
    SECTION("a missing transom") {
        mesh = without(mesh, [](const Vec3& p) { return p.x() < -1.99; });
    }
    SECTION("a missing bottom") {
        mesh = without(mesh, [](const Vec3& p) { return p.z() < -0.49; });
    }
    SECTION("half of the faces") { mesh = test::truncate_mesh(mesh, 0.5); }
    SECTION("half a globe") {
        mesh = without(test::make_globe(1, 20), [](const Vec3& p) { return p.x() > 0; });
    }
    SECTION("the upper half of a globe, though its opening lies like a deck") {
        mesh = without(test::make_globe(1, 21), [](const Vec3& p) { return p.z() > 0.5; });
    }
    Repairs repairs;
    CHECK_THROWS_WITH(make_solid(mesh, "ship.obj", {}, repairs),
                      Catch::Contains("ship.obj") && Catch::Contains("m2") &&
                          Catch::Contains("too large to guess") &&
                          Catch::Contains("--repair wrap"));
}

TEST_CASE("a missing stem is refused, however little volume it had", "[repair][errors]") {
    TriangleMesh spindle = test::make_globe(1.0, 48);
    for (Vec3& v : spindle.vertices) v = Vec3(8.0 * v.z(), v.y(), -v.x());
    const TriangleMesh blunt = without(spindle, [](const Vec3& p) { return p.x() > 7.85; });
    CHECK_THROWS_WITH(repair(blunt),
                      Catch::Contains("opening of") && Catch::Contains("too large to guess"));
    // The same opening amidships is closed, and said. A flat cap loses less than 1.4 x 0.4 x 0.02
    // m3, 0.03 % of the spindle's 33.5 m3; 1 % tells it from a cap that bulges or sags.
    const TriangleMesh opened =
        without(spindle, [](const Vec3& p) { return p.z() > 0.98 && std::abs(p.x()) < 0.7; });
    CHECK(repair(opened).volume == Near(measure_mass(spindle).volume).epsilon(0.01));
}

TEST_CASE("a file that seems cut off gets no deck", "[repair][errors]") {
    SolidOptions options;
    options.suspect = "the file seems cut off: no face uses its last 4 vertices";
    Repairs repairs;
    CHECK_THROWS_WITH(
        make_solid(without(test::make_box_mesh(kSize), on_top), "ship.obj", options, repairs),
        Catch::Contains("no face uses its last 4 vertices"));
}

TEST_CASE("strict refuses what is not closed and outward", "[repair][errors]") {
    Repairs repairs;
    const auto strict = [&](const TriangleMesh& mesh) {
        return make_solid(mesh, "ship.obj", mode(RepairMode::strict), repairs);
    };
    TriangleMesh box = test::make_box_mesh(kSize);
    CHECK(strict(box).triangles.size() == 12);
    CHECK_THROWS_WITH(strict(without(box, on_top)), Catch::Contains("4 open edges"));
    TriangleMesh turned = box;
    std::swap(turned.triangles[0][1], turned.triangles[0][2]);
    CHECK_THROWS_WITH(strict(turned), Catch::Contains("face opposite ways"));
    flip(box);
    CHECK_THROWS_WITH(strict(box), Catch::Contains("inside out"));
}

TEST_CASE("a globe without 2 % of its faces has its volume within 1 %", "[repair]") {
    const TriangleMesh globe = test::make_globe(1, 20);
    std::mt19937 random(11);
    TriangleMesh torn = globe;
    for (std::size_t k = 0; k < globe.triangles.size() / 50; ++k)
        torn.triangles.erase(torn.triangles.begin() +
                             static_cast<std::ptrdiff_t>(random() % torn.triangles.size()));
    torn.region.resize(torn.triangles.size());
    // the cap of one missing triangle is that triangle; only where neighbours are missing does it
    // cut the globe
    CHECK(repair(torn).volume == Near(measure_mass(globe).volume).epsilon(0.01));
}

TEST_CASE("a double skin that crosses itself: filled in the envelope, plating in the material",
          "[repair][analytic]") {
    // an outer box, and an inner skin that faces inwards and cuts through the outer one's bottom
    TriangleMesh mesh;
    add_body(mesh, test::make_box_mesh(Vec3(4, 2, 2)), Vec3::Zero());
    add_body(mesh, test::make_box_mesh(Vec3(3.6, 1.6, 1.8)), Vec3(0, 0, 0.15), true);
    SolidOptions options;
    SECTION("envelope") {
        CHECK(repair(mesh, options).volume == Near(16 + 3.6 * 1.6 * 0.05).epsilon(1e-9));
    }
    SECTION("material") {
        options.kind = SolidKind::material;
        const Result r = repair(mesh, options);
        CHECK(r.volume == Near(16 - 3.6 * 1.6 * 1.75).epsilon(1e-9));
        CHECK(has(r.repairs, "overlapping parts united"));
    }
}

TEST_CASE("a fin without thickness is dropped, and said", "[repair][analytic]") {
    TriangleMesh box = test::make_box_mesh(kSize);
    box.vertices.push_back(box.vertices[0] + Vec3(-1, -1, -1));
    box.triangles.push_back({box.triangles[0][0], box.triangles[0][1], 8});
    box.region.push_back(0);
    const Result r = repair(box);
    CHECK(r.volume == Near(8).epsilon(1e-14));
    CHECK(has(r.repairs, "loose parts without volume dropped"));
}

TEST_CASE("shrink-wrapping is a choice of the user's, and says by how much it is off", "[repair]") {
    const TriangleMesh open =
        without(test::make_box_mesh(kSize), [](const Vec3& p) { return p.y() > 0.99; });
    const Result r = repair(open, mode(RepairMode::wrap));
    CHECK(r.volume == Near(8).epsilon(0.1));
    REQUIRE(r.warnings.size() == 2);
    CHECK_THAT(r.warnings[1], Catch::Contains("winding number"));
}

TEST_CASE("the contour from winding numbers is closed, crosses nothing and keeps the volume",
          "[repair]") {
    const TriangleMesh globe = test::make_globe(1, 30);
    const WindingSolid solid = winding_solid(globe, SolidKind::envelope);
    CHECK(diagnose_solid(solid.mesh).text() == "");
    CHECK(measure_mass(solid.mesh).volume == Near(measure_mass(globe).volume).epsilon(0.002));
}

TEST_CASE("a contour keeps the edges and corners of a box that lies athwart its cells",
          "[repair]") {
    TriangleMesh box = test::make_box_mesh(kSize);
    const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized());
    for (Vec3& v : box.vertices) v = turn * v;
    const WindingSolid solid = winding_solid(box, SolidKind::material);
    CHECK(diagnose_solid(solid.mesh).text() == "");
    const SurfaceTree contour(solid.mesh);
    double sum = 0.0;
    int count = 0;
    for (const MeshEdge& e : edge_table(box)) {
        const Vec3 a = box.vertices[static_cast<std::size_t>(e.a)];
        const Vec3 b = box.vertices[static_cast<std::size_t>(e.b)];
        for (int k = 0; k <= 100; ++k, ++count)
            sum += contour.closest(a + 0.01 * k * (b - a)).distance / solid.cell;
    }
    // without moved vertices cells cut off 0.2 of their edge on average
    CHECK(sum / count < 0.03);
    for (const Vec3& corner : box.vertices)
        CHECK(contour.closest(corner).distance < 0.1 * solid.cell);
}

TEST_CASE("openings are listed by size with their place", "[repair][check]") {
    const TriangleMesh box = without(test::make_box_mesh(kSize), on_top);
    const auto openings = find_openings(box);
    REQUIRE(openings.size() == 1);
    CHECK(openings[0].edges == 4);
    CHECK(openings[0].perimeter == Near(12));
    CHECK(openings[0].at.z() == Near(0.5));
    const std::string text = describe_mesh(box);
    CHECK_THAT(text, Catch::Contains("10 in 1 parts") && Catch::Contains("4 open edges") &&
                         Catch::Contains("12 m around"));
}
