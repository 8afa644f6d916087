// SPDX-License-Identifier: GPL-3.0-or-later
// Exports for contact codes. tests/interop has the codes themselves read them.
//
// Tolerances: 1e-15 and 1e-14 are rounding of one product; 1e-12 is that of an eigensolver.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/base/error.hpp"
#include "common/formats/rigid_body_file.hpp"
#include "common/formats/summary_file.hpp"
#include "preprocess/write/write_chrono.hpp"
#include "preprocess/write/write_exports.hpp"
#include "preprocess/write/write_liggghts.hpp"
#include "preprocess/write/write_yade.hpp"
#include "tests/support/make_sphere_sets.hpp"
#include "tests/support/tolerance.hpp"
#include "tests/support/write_text.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;
using test::text_of;
namespace fs = std::filesystem;

namespace {

constexpr double kDensity = 917.0;  // kg/m3

// Rounding of a rotation and of an eigensolver for 3x3 matrices: a few hundred times 2e-16.
constexpr double kRounding = 1e-13;

// A box of spheres, turned about no axis in particular and moved off the origin.
SphereSet turned_box(const Vec3& size = Vec3(0.7, 1.0, 0.4)) {
    SphereSet set = test::make_box_set(size, 0.05, 0.1);
    const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
    const Vec3 shift(3.0, -2.0, 1.0);
    for (Vec3& c : set.centers) c = turn * c + shift;
    for (Vec3& n : set.normals) n = turn * n;
    for (Vec3& v : set.mesh.vertices) v = turn * v + shift;
    set.solid = measure_mass(set.mesh);
    return set;
}

// The numbers of a text's rows behind its header, separated by anything.
std::vector<std::vector<double>> rows_of(std::string text, int header) {
    for (char& c : text)
        if (c == ',' || c == '\t') c = ' ';
    std::istringstream in(text);
    std::vector<std::vector<double>> rows;
    for (std::string line; std::getline(in, line);) {
        if (header-- > 0) continue;
        rows.emplace_back();
        std::istringstream words(line);
        for (std::string word; words >> word;) rows.back().push_back(std::stod(word));
    }
    return rows;
}

Mat3 diagonal(const Vec3& v) { return v.asDiagonal(); }

double reconstruction_error(const RigidBody& body) {
    const Mat3 r = body.axes.toRotationMatrix();
    return (r * diagonal(body.moments) * r.transpose() - body.inertia).norm() / body.inertia.norm();
}

class Folder {
public:
    // each test is a process of its own, and several run at a time
    Folder() : path_(fs::temp_directory_path() / ("ice-export-" + std::to_string(::getpid()))) {
        fs::remove_all(path_);
        fs::create_directories(path_);
    }
    ~Folder() { fs::remove_all(path_); }
    fs::path operator/(const std::string& name) const { return path_ / name; }
    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(path_))
            if (entry.is_regular_file()) names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    }

private:
    fs::path path_;
};

}  // namespace

TEST_CASE("a box of 3 x 2 x 1 m has the textbook moments along its own edges",
          "[export][analytic]") {
    const SphereSet set = test::make_box_set(Vec3(3, 2, 1), 0.25, 0.5);
    const RigidBody body = rigid_body(set.solid, kDensity);
    CHECK(body.mass == Near(kDensity * 6.0).epsilon(1e-14));
    CHECK(body.moments[0] == Near(body.mass / 12 * (4 + 1)).epsilon(1e-14));
    CHECK(body.moments[1] == Near(body.mass / 12 * (9 + 1)).epsilon(1e-14));
    CHECK(body.moments[2] == Near(body.mass / 12 * (9 + 4)).epsilon(1e-14));
    CHECK(body.axes.angularDistance(Eigen::Quaterniond::Identity()) < tolerance(1e-15));
}

TEST_CASE("a cube, whose axes are free, keeps those of the mesh", "[export]") {
    const SphereSet set = test::make_box_set(Vec3::Constant(0.3), 0.05, 0.1);
    const Mat3 r = rigid_body(set.solid, kDensity).axes.toRotationMatrix();
    for (int k = 0; k < 9; ++k)  // each entry 0, 1 or -1: a permutation of the directions
        CHECK(std::abs(r(k / 3, k % 3) * (1.0 - std::abs(r(k / 3, k % 3)))) < tolerance(1e-15));
    CHECK(r.determinant() == Near(1.0));
}

TEST_CASE("moments and quaternion give the inertia tensor back to 1e-12", "[export][property]") {
    const Vec3 size = GENERATE(Vec3(0.7, 1.0, 0.4), Vec3(0.5, 0.5, 0.3), Vec3(0.4, 0.4, 0.4),
                               Vec3(20.0, 0.3, 0.3));
    const RigidBody body = rigid_body(turned_box(size).solid, kDensity);
    CHECK(reconstruction_error(body) < tolerance(1e-12));
    CHECK(body.moments[0] <= body.moments[1]);
    CHECK(body.moments[1] <= body.moments[2]);
    CHECK(body.axes.norm() == Near(1.0).epsilon(1e-15));
    CHECK(body.axes.w() >= 0.0);
    const double m = kDensity * size.prod();
    const Vec3 square = size.cwiseProduct(size);
    Vec3 expected = m / 12.0 * (Vec3::Constant(square.sum()) - square);
    std::sort(expected.data(), expected.data() + 3);
    CHECK((body.moments - expected).norm() < tolerance(1e-12) * expected.norm());
}

TEST_CASE("LIGGGHTS gets the spheres about the centre of mass, along the mesh's axes", "[export]") {
    const SphereSet set = turned_box();
    const RigidBody body = rigid_body(set.solid, kDensity);
    const auto rows =
        rows_of(text_of([&](const Sink& sink) { write_liggghts_spheres(set, body, sink); }), 0);
    REQUIRE(rows.size() == set.size());
    Vec3 middle = Vec3::Zero();
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Vec3 c(rows[k][0], rows[k][1], rows[k][2]);
        REQUIRE(c == set.centers[k] - body.centroid);  // digits lose nothing
        REQUIRE(rows[k][3] == set.radii[k]);
        middle += c / static_cast<double>(rows.size());
    }
    CHECK(middle.norm() < tolerance(kRounding));  // a box and its spheres have the same centre
}

TEST_CASE("LIGGGHTS is given mass and tensor in its order, and no leave to move the spheres",
          "[export]") {
    const RigidBody body = rigid_body(turned_box().solid, kDensity);
    const std::string text = liggghts_text(body, 240, "floe", "floe.liggghts.txt");
    std::istringstream after(text.substr(text.find("inertia_tensor") + 14));
    std::vector<double> tensor;
    for (std::string word; tensor.size() < 6 && after >> word;) tensor.push_back(std::stod(word));
    const Mat3& i = body.inertia;
    CHECK(tensor == std::vector<double>{i(0, 0), i(0, 1), i(0, 2), i(1, 1), i(1, 2), i(2, 2)});
    CHECK(std::stod(text.substr(text.find("\n    mass ") + 10)) == body.mass);
    CHECK_THAT(text, Catch::Contains("fix floe all particletemplate/multisphere") &&
                         Catch::Contains("density constant 917 &") &&
                         Catch::Contains("nspheres 240 ntry") &&
                         Catch::Contains("use_density type 1\n"));
}

TEST_CASE("Chrono and YADE get the spheres along the principal axes, the pose leads back",
          "[export]") {
    const SphereSet set = turned_box();
    const RigidBody body = rigid_body(set.solid, kDensity);
    const auto chrono =
        rows_of(text_of([&](const Sink& sink) { write_chrono_spheres(set, body, sink); }), 1);
    const auto yade =
        rows_of(text_of([&](const Sink& sink) { write_yade_spheres(set, body, sink); }), 1);
    REQUIRE(chrono.size() == set.size());
    REQUIRE(yade.size() == set.size());
    for (std::size_t k = 0; k < set.size(); ++k) {
        const Vec3 c(chrono[k][0], chrono[k][1], chrono[k][2]);
        REQUIRE((body.axes * c + body.centroid - set.centers[k]).norm() < tolerance(kRounding));
        // turned back, the box lies along its axes: its longest edge has the smallest moment
        REQUIRE(std::abs(c.x()) <= 0.45 + tolerance(kRounding));
        REQUIRE(std::abs(c.y()) <= 0.30 + tolerance(kRounding));
        REQUIRE(std::abs(c.z()) <= 0.15 + tolerance(kRounding));
        REQUIRE(chrono[k][3] == set.radii[k]);
        REQUIRE(yade[k].size() == 5);
        REQUIRE(std::equal(chrono[k].begin(), chrono[k].end(), yade[k].begin()));
        REQUIRE(yade[k][4] == 0.0);
    }
    CHECK(text_of([&](const Sink& sink) {
              write_chrono_spheres(set, body, sink);
          }).starts_with("x,y,z,r\n"));
}

TEST_CASE("the JSON for Chrono holds the body to the last digit", "[export]") {
    const Folder folder;
    const SphereSet set = turned_box();
    const RigidBody body = rigid_body(set.solid, kDensity);
    std::ofstream(folder / "body.json") << rigid_body_text(body, "x.csv", "frame", set.size());
    const auto json = read_json_numbers(folder / "body.json");
    CHECK(json.at("mass_kg") == body.mass);
    CHECK(json.at("spheres") == static_cast<double>(set.size()));
    RigidBody read;
    read.inertia = body.inertia;
    for (int k = 0; k < 3; ++k) {
        const std::string at = "." + std::to_string(k);
        read.moments[k] = json.at("moments_kg_m2" + at);
        CHECK(json.at("centroid_m" + at) == body.centroid[k]);
    }
    read.axes = Eigen::Quaterniond(json.at("quaternion_wxyz.0"), json.at("quaternion_wxyz.1"),
                                   json.at("quaternion_wxyz.2"), json.at("quaternion_wxyz.3"));
    CHECK(reconstruction_error(read) < tolerance(1e-12));
    CHECK(json.at("quaternion_xyzw.3") == body.axes.w());
    CHECK(json.at("inertia_mesh_axes_kg_m2.xz") == body.inertia(0, 2));
}

TEST_CASE("each format is two files at most, and a repeated format the same ones", "[export]") {
    const Folder folder;
    const auto written = write_exports(
        turned_box(), {"csv", "vtp", "yade", "liggghts", "chrono", "csv"}, kDensity, folder / "f");
    const std::vector<std::string> expected{"f.chrono.csv",  "f.chrono.json",  "f.csv",
                                            "f.liggghts.in", "f.liggghts.txt", "f.vtp",
                                            "f.yade.py",     "f.yade.txt"};
    CHECK(folder.files() == expected);
    CHECK(written.size() == expected.size());
}

TEST_CASE("an export that cannot be finished leaves none of its files", "[export][errors]") {
    const Folder folder;
    fs::create_directories(folder / "f.yade.py.part");  // in the way of the last file
    CHECK_THROWS_WITH(write_exports(turned_box(), {"csv", "yade"}, kDensity, folder / "f"),
                      Catch::Contains("f.yade.py") && Catch::Contains("cannot be written"));
    CHECK(folder.files().empty());
}

TEST_CASE("a 2D set and a single sphere are refused by name where they mean nothing",
          "[export][errors]") {
    const SphereSet flat = test::make_box_set(Vec3(1.0, 1.0, 0.4), 0.05, 0.1, 2);
    for (const char* format : {"yade", "liggghts", "chrono"})
        CHECK_THROWS_WITH(check_exports(flat, {format}, "f"),
                          Catch::Contains(format) && Catch::Contains("--slice"));
    CHECK_NOTHROW(check_exports(flat, {"csv", "vtp"}, "f"));
    const SphereSet ball = test::make_ball_set(0.1);
    CHECK_THROWS_WITH(check_exports(ball, {"liggghts"}, "f"), Catch::Contains("two spheres"));
    CHECK_NOTHROW(check_exports(ball, {"yade", "chrono"}, "f"));
}

TEST_CASE("a name that a script cannot quote is refused, one with spaces is not",
          "[export][errors]") {
    const SphereSet set = turned_box();
    CHECK_THROWS_WITH(check_exports(set, {"yade"}, "my \"hull\""), Catch::Contains("--output"));
    CHECK_THROWS_WITH(check_exports(set, {"liggghts"}, "a\nb"), Catch::Contains("--output"));
    CHECK_NOTHROW(check_exports(set, {"csv", "vtp"}, "my \"hull\""));
    CHECK_NOTHROW(check_exports(set, {"yade", "liggghts", "chrono"}, "folder \"x\"/my hull"));
}
