// SPDX-License-Identifier: GPL-3.0-or-later
// From specification to field: keys, shared shapes, spheres, equal bytes.
//
// Tolerances: 1e-12 is rounding of a sum over triangles; 1e-9 that of sums over shares, with a
// reserve; 1e-6 is a normal stored as a float.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"
#include "common/formats/field_file.hpp"
#include "preprocess/field/plan_floes.hpp"
#include "preprocess/fill/measure_certificate.hpp"
#include "tests/preprocess/field_support.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

const std::string kBrick =
    "pattern = \"brick\"\nseed = 2\n[ice]\nthickness = \"300 mm\"\nchamfer = 0.02\n"
    "[spheres]\nradius = 0.05\n[floes]\nsize = [1.0, 0.8]\ncount = [4, 3]\ngap = [0.1, 0.2]\n"
    "[edges]\nbreadth = 1\n";
const std::string kVoronoi =
    "pattern = \"voronoi\"\n[ice]\nthickness = 1\n[spheres]\nspacing = 1\n[area]\nsize = [40, 30]\n"
    "[floes]\nmean_size = 5\nconcentration = 0.8\n";

Field make(const std::string& text, FieldReport& report) {
    const FieldSpec spec = field_spec(text);
    return make_field(spec, plan_field(spec, report.warnings), report);
}

std::string bytes_of(const std::string& text, int threads) {
    set_thread_count(threads);
    FieldReport report;
    const TemporaryFile file(".h5", "");
    write_field(file.path(), make(text, report));
    std::ifstream in(file.path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string complaint(const std::string& text) {
    try {
        field_spec(text);
    } catch (const Error& error) {
        CHECK(error.code() == ExitCode::bad_input);
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("equal floes share a shape, wherever they lie", "[field]") {
    FieldReport report;
    const Field field = make(kBrick, report);
    CHECK(field.shapes.size() == 4);  // whole, half, side, end
    // sides 5.3 m long in pieces of up to 4 m, an end of 2.8 m
    REQUIRE(field.floes.size() == 14 + 4 + 1);
    CHECK(report.floes == 14);
    CHECK(report.fixed == 5);
    CHECK_FALSE(field.floes[13].fixed);
    CHECK(field.floes[14].fixed);
    // first column of three whole floes, then a half one
    CHECK(field.floes[0].shape == field.floes[2].shape);
    CHECK(field.floes[3].shape != field.floes[2].shape);
    CHECK(field.floes[0].position[0] == Near(0.5));
    CHECK(field.floes[0].position[1] == Near(-1.0));
    CHECK(field.radius == 0.05);
    CHECK(field.spacing == 0.1);
    CHECK(field.specification == kBrick);
    CHECK(field.seed == 2);
}

TEST_CASE("a shape's spheres touch its faces, and their shares add up", "[field][property]") {
    FieldReport report;
    const bool fill = GENERATE(false, true);
    std::string text = kVoronoi;
    if (fill) text.replace(text.find("spacing"), 7, "mode = \"fill\"\nspacing");
    const Field field = make(text, report);
    CHECK(report.spheres > field.floes.size() * 20);
    for (const SphereSet& shape : field.shapes) {
        CHECK((fill ? shape.size() > shape.surface_count : shape.size() == shape.surface_count));
        CHECK(shape.solid.centroid.norm() < tolerance(1e-12));
        double area = 0.0, volume = 0.0;
        Vec3 moment = Vec3::Zero();
        for (const double a : shape.areas) area += a;
        for (std::size_t k = 0; k < shape.size(); ++k) {
            volume += shape.volumes[k];
            moment += shape.volumes[k] * shape.centers[k];
            // none reaches beyond the flat faces; 1e-9: settled to 1e-10 of the radius
            REQUIRE(std::abs(shape.centers[k].z()) <= 0.5 - 0.25 + tolerance(1e-9));
        }
        CHECK(area == Near(shape.solid.area).epsilon(1e-9));
        CHECK(volume == Near(shape.solid.volume).epsilon(1e-9));
        CHECK(moment.norm() < tolerance(1e-9) * shape.solid.volume);
        for (std::size_t k = 0; k < shape.surface_count; ++k)
            REQUIRE((shape.centers[k].z() > 0.2499 || shape.centers[k].z() < -0.2499 ||
                     std::abs(shape.normals[k].z()) < tolerance(1e-6)));
    }
}

TEST_CASE("floes are covered as spherize covers solids, by its own certificate",
          "[field][property]") {
    // 0.634 spacings are seen with and without the quick fill; chamfered and concave ones as well
    for (const std::string& text :
         {kVoronoi, kBrick,
          std::string("pattern = \"cusps\"\n[ice]\nthickness = 1\nchamfer = 0.1\n[spheres]\n"
                      "spacing = 0.7\n[area]\nsize = [20, 24]\n[floes]\nbreaking_length = 5\n"
                      "breaking_width = 8\n")}) {
        FieldReport report;
        const Field field = make(text, report);
        for (const SphereSet& shape : field.shapes) {
            const SurfaceTree tree(shape.mesh);
            const SphereFinder finder(shape);
            SpheresReport certificate;
            measure_certificate(tree, finder, survey_surface(tree, shape, finder, false), false,
                                shape, certificate);
            REQUIRE(certificate.covering_radius < 0.75 * field.spacing);
            REQUIRE(certificate.protrusion_max < tolerance(1e-9));
        }
    }
}

namespace {

// A plane n . x <= offset, and where three of them meet.
struct Plane {
    Vec3 normal;
    double offset;
};
Vec3 meeting_point(const Plane& a, const Plane& b, const Plane& c) {
    Mat3 rows;
    rows << a.normal.transpose(), b.normal.transpose(), c.normal.transpose();
    return rows.inverse() * Vec3(a.offset, b.offset, c.offset);
}

// Planes of a prism's sides, each once, moved inwards by a radius.
std::vector<Plane> inner_sides(const SphereSet& shape) {
    std::vector<Plane> out;
    for (std::size_t t = 0; t < shape.mesh.triangles.size(); ++t) {
        const Vec3 a = shape.mesh.corner(t, 0), n = (shape.mesh.corner(t, 1) - a)
                                                        .cross(shape.mesh.corner(t, 2) - a)
                                                        .normalized();
        const Plane plane{n, n.dot(a) - shape.radius};
        const bool known = std::any_of(out.begin(), out.end(), [&](const Plane& other) {
            return other.normal.dot(n) > 0.99999 &&
                   std::abs(other.offset - plane.offset) < 1e-6 * shape.radius;
        });
        if (std::abs(n.z()) < 1e-9 && !known) out.push_back(plane);
    }
    return out;
}

// Has a sphere at `place` all these normals? A face within 1e-5 radii of a sphere is touched, and
// three whose normals span a volume of 0.1 hold it within ten times as much of their corner.
bool stands_for(const SphereSet& shape, const Vec3& place, const std::vector<Vec3>& normals) {
    for (std::size_t k = 0; k < shape.surface_count; ++k) {
        if ((shape.centers[k] - place).norm() > 1e-4 * shape.radius) continue;
        const auto knows = [&](const Vec3& n) {
            return std::any_of(shape.creases.begin(), shape.creases.end(), [&](const auto& c) {
                return c.sphere == static_cast<std::int32_t>(k) && c.normal.dot(n) > 0.9999;
            });
        };
        if (std::all_of(normals.begin(), normals.end(), knows)) return true;
    }
    return false;
}

// Checks every place of a prism where a sphere touches two sides that turn by more than 6 degrees
// and the top or the bottom, convex or not; their number.
std::size_t check_corners(const SphereSet& shape, double thickness) {
    constexpr double kLeastTurn = 0.1;  // its sine: corners.hpp
    const SurfaceTree tree(shape.mesh);
    const std::vector<Plane> sides = inner_sides(shape);
    std::size_t corners = 0;
    for (std::size_t k = 0; k < 2 * sides.size() * sides.size(); ++k) {
        const Plane &one = sides[k / 2 % sides.size()], &next = sides[k / 2 / sides.size()];
        const double z = k % 2 ? 1.0 : -1.0;
        // each pair once
        if (one.normal.cross(next.normal).z() < kLeastTurn) continue;
        const Plane end{z * Vec3::UnitZ(), 0.5 * thickness - shape.radius};
        const Vec3 place = meeting_point(one, next, end);
        const auto touches = [&](const Plane& p) {
            return tree.closest(place + shape.radius * p.normal).distance < 1e-6 * shape.radius;
        };
        if (!tree.closest(place).inside || !tree.is_clear(place, shape.radius * (1.0 - 1e-6)) ||
            !touches(one) || !touches(next) || !touches(end))
            continue;
        CAPTURE(place.transpose(), one.normal.transpose(), next.normal.transpose());
        CHECK(stands_for(shape, place, {one.normal, next.normal, end.normal}));
        ++corners;
    }
    return corners;
}

}  // namespace

TEST_CASE("a sphere sits in every corner of a floe that has room for it, chamfered or not",
          "[field][analytic]") {
    const std::string chamfer = GENERATE("", "chamfer = 0.1\n");
    std::string text = kVoronoi;
    text.replace(text.find("[spheres]"), 9, chamfer + "[spheres]\nradius = 0.25");
    FieldReport report;
    std::size_t corners = 0;
    for (const SphereSet& shape : make(text, report).shapes) corners += check_corners(shape, 1.0);
    CHECK(corners > 400);  // of some 50 floes, six above and below
    CHECK(report.corners == static_cast<std::int64_t>(corners));
}

TEST_CASE("the shipped fields have a sphere in every corner, whatever the seed",
          "[field][property]") {
    // lines that ended a hair short of a corner left it empty: 1 to 4 floes of each of the first
    // five seeds of the broken field, and one cusp of seeds 3, 4 and 5 of the channel
    const auto [file, seed] =
        GENERATE(table<const char*, const char*>({{"broken-field/floes.toml", "1"},
                                                  {"broken-field/floes.toml", "2"},
                                                  {"broken-field/floes.toml", "3"},
                                                  {"broken-field/floes.toml", "4"},
                                                  {"broken-field/floes.toml", "5"},
                                                  {"icebreaker-100m/channel.toml", "3"},
                                                  {"icebreaker-100m/channel.toml", "4"},
                                                  {"icebreaker-100m/channel.toml", "5"}}));
    CAPTURE(file, seed);
    const FieldSpec spec = read_field_spec(std::string(ICE_SOURCE_DIR "/cases/") + file,
                                           {std::string("seed=") + seed});
    FieldReport report;
    std::size_t corners = 0;
    const Field field = make_field(spec, plan_field(spec, report.warnings), report);
    for (const SphereSet& shape : field.shapes) corners += check_corners(shape, spec.thickness);
    // in a cusp a sphere may touch two faces and the edge in which the arc before it ends
    CHECK(report.corners >= static_cast<std::int64_t>(corners));
    CHECK(corners > 2000);
}

TEST_CASE("both ends of a side that is hardly longer than its corners have a sphere",
          "[field][analytic]") {
    // its spheres' centres are a fiftieth of a radius apart: the next side's line began in the
    // wrong one, left its edge and missed the other
    const TemporaryFile file(".csv",
                             "floe,x,y\n1,-0.199223,0.385854\n1,-0.199223,-0.652858\n"
                             "1,-0.114965,-0.640086\n1,0.388686,0.385854\n");
    FieldReport report;
    const Field field = make(
        "pattern = \"polygons\"\n[ice]\nthickness = 0.3\n[spheres]\nradius = 0.05\nspacing = "
        "0.12\n[floes]\nfile = \"" +
            file.path().string() + "\"\n",
        report);
    REQUIRE(field.shapes.size() == 1);
    CHECK(check_corners(field.shapes[0], 0.3) == 8);
    CHECK(report.corners == 8);
}

TEST_CASE("the sides of an arc meet in corners with spheres of their own", "[field][analytic]") {
    // a round floe of 4 m radius in 36 sides: they turn by 10 degrees
    std::string rows = "floe,x,y\n";
    for (int k = 0; k < 36; ++k) {
        const double angle = k * std::numbers::pi / 18.0;
        rows += "1," + std::to_string(4.0 * std::cos(angle)) + "," +
                std::to_string(4.0 * std::sin(angle)) + "\n";
    }
    const TemporaryFile file(".csv", rows);
    FieldReport report;
    const Field field = make(
        "pattern = \"polygons\"\n[ice]\nthickness = 1\n[spheres]\nradius = 0.25\nspacing = 0.7\n"
        "[floes]\nfile = \"" +
            file.path().string() + "\"\n",
        report);
    REQUIRE(field.shapes.size() == 1);
    CHECK(check_corners(field.shapes[0], 1.0) == 72);
}

TEST_CASE("a floe's top and bottom have the same spheres, and its creases normals of its faces",
          "[field][property]") {
    FieldReport report;
    for (const SphereSet& shape : make(kVoronoi, report).shapes) {
        for (std::size_t k = 0; k < shape.surface_count; ++k) {
            const Vec3 flip(1.0, 1.0, -1.0);
            const Vec3 image = shape.centers[k].cwiseProduct(flip);
            const auto twin =
                std::find_if(shape.centers.begin(), shape.centers.end(),
                             [&](const Vec3& c) { return (c - image).norm() < 1e-12; });
            REQUIRE(twin != shape.centers.end());
            const auto t = static_cast<std::size_t>(twin - shape.centers.begin());
            REQUIRE(shape.areas[t] == shape.areas[k]);
            REQUIRE((shape.normals[t] - shape.normals[k].cwiseProduct(flip)).norm() <
                    tolerance(1e-9));
        }
        REQUIRE(!shape.creases.empty());
        for (const CreaseNormal& crease : shape.creases) {
            double nearest = 0.0;  // cosine between the crease's normal and a face's
            for (std::size_t t = 0; t < shape.mesh.triangles.size(); ++t)
                nearest =
                    std::max(nearest, crease.normal.dot(shape.mesh.area_vector(t).normalized()));
            REQUIRE(nearest > 1.0 - tolerance(1e-9));
        }
    }
}

TEST_CASE("same seed, same bytes, whatever the number of threads", "[field][determinism]") {
    for (const std::string& text :
         {kBrick, kVoronoi,
          std::string("pattern = \"power-law\"\n[ice]\nthickness = 1\n[spheres]\nspacing = 1\n"
                      "[area]\nsize = [60, 40]\n[floes]\nexponent = 1.5\nsmallest = 2\n"
                      "largest = 15\nconcentration = 0.9\n")}) {
        const std::string once = bytes_of(text, 1);
        CHECK(bytes_of(text, 2) == once);
        CHECK(bytes_of(text, 3) == once);
        CHECK(bytes_of("title = \"x\"\n" + text, 2) != once);
    }
    CHECK(bytes_of("seed = 1\n" + kVoronoi, 2) != bytes_of("seed = 2\n" + kVoronoi, 2));
    set_thread_count(0);
}

TEST_CASE("a floe too small for a sphere is named by its size", "[field][errors]") {
    FieldReport report;
    std::string text = kVoronoi;
    text.replace(text.find("mean_size = 5"), 13, "mean_size = 0.3");
    text.replace(text.find("[40, 30]"), 8, "[4, 3]");
    CHECK_THROWS_WITH(make(text, report), Catch::Contains("spheres.radius: a floe of size 0.") &&
                                              Catch::Contains("no sphere of radius 0.25 m fits"));
}

TEST_CASE("mistakes in a specification come with line, suggestion and remedy", "[field][errors]") {
    CHECK_THAT(complaint(kBrick + "breadht = 3\n"),
               Catch::Contains(":14:1: error: unknown key 'edges.breadht'; did you mean "
                               "'edges.breadth'?"));
    CHECK_THAT(complaint("seed = 1\n[ice]\nthickness = \"3 kg\"\n"),
               Catch::Contains("ice.thickness = \"3 kg\" is not a number with a unit") &&
                   Catch::Contains("required key 'pattern' is missing"));
    CHECK_THAT(
        complaint("pattern = \"voronoi\"\n[ice]\nthickness = 1\n[floes]\nexponent = 2\n"),
        Catch::Contains(":5:1: error: floes.exponent means nothing to pattern \"voronoi\"") &&
            Catch::Contains("required key 'floes.mean_size' is missing for pattern "
                            "\"voronoi\""));
    CHECK_THAT(complaint("pattern = \"hexagons\"\n[ice]\nthickness = 1\n"),
               Catch::Contains("none of grid|brick|cusps|voronoi|power-law|polygons"));
    CHECK_THAT(complaint(kBrick + "[area]\nsize = [1, 2]\n"),
               Catch::Contains("area.size means nothing to pattern \"brick\""));
    std::string thick = kBrick;
    thick.replace(thick.find("0.05"), 4, "0.15");
    CHECK_THAT(complaint(thick), Catch::Contains("does not fit into ice of 0.3 m"));
    CHECK_THAT(complaint("pattern = \"polygons\"\n[ice]\nthickness = 1\n[floes]\nfile = \"no\"\n"),
               Catch::Contains("floes.file: file") && Catch::Contains("not found"));
    CHECK_THAT(complaint("pattern = \"cusps\"\n[ice]\nthickness = 1\n[area]\nsize = [9, 9]\n"
                         "[floes]\nbreaking_length = 4\nbreaking_width = 8\nbreaking_depth = 4\n"),
               Catch::Contains("cusps of one row would reach into those of the next"));
    CHECK(complaint(kBrick) == "");
}
