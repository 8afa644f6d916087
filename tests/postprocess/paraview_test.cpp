// SPDX-License-Identifier: GPL-3.0-or-later
// Tolerances: 1e-5 m is a place stored as a float.
#include <catch2/catch.hpp>

#include "common/formats/hdf5_file.hpp"
#include "postprocess/paraview/write_paraview.hpp"
#include "postprocess/paraview/xdmf.hpp"
#include "tests/postprocess/make_folder.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;
using namespace ice::paraview;

namespace {

// The grid of a part at a time, as XDMF text; "" where it is not there.
std::string grid_at(const std::string& text, const std::string& part, const std::string& time) {
    const std::string name = "<Grid Name=\"" + part + "\" GridType=\"Uniform\">";
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
        const std::string grid = text.substr(at, text.find("</Grid>", at) - at);
        if (grid.find("<Time Value=\"" + time + "\"/>") != std::string::npos) return grid;
    }
    return "";
}

// The array that an element of a grid names.
template <class T>
std::vector<T> array_of(const Hdf5File& file, const std::string& grid, const std::string& element) {
    const std::size_t at = grid.find(element), item = grid.find("<DataItem", at);
    REQUIRE(at != std::string::npos);
    const std::size_t begin = grid.find(".h5:", item) + 4;
    const std::string path = grid.substr(begin, grid.find('<', begin) - begin);
    const auto values = file.read<T>(path);
    // the text says how many there are
    const std::size_t size = grid.find("Dimensions=\"", item) + 12;
    std::uint64_t count = 1;
    for (const std::uint64_t n : file.shape(path)) count *= n;
    const std::string said = grid.substr(size, grid.find('"', size) - size);
    const std::size_t space = said.find(' ');
    CHECK(std::stoull(said) * (space == std::string::npos ? 1 : std::stoull(said.substr(space))) ==
          count);
    return values;
}

}  // namespace

TEST_CASE("a grid without cells is left out, names are quoted", "[paraview]") {
    const TempFolder folder;
    ArrayFile arrays(folder / "a.h5");
    const Grid empty{arrays.add("/p", std::vector<float>{}, 3),
                     arrays.add("/c", std::vector<std::int32_t>{}),
                     {}};
    const Grid one{arrays.add("/q", std::vector<float>{1, 2, 3}, 3),
                   arrays.add("/d", std::vector<std::int32_t>{0}),
                   {}};
    XdmfFile file;
    file.add("a & \"b\" < c", 1.0, empty);
    CHECK(count(file.text(), "<Grid") == 0);
    file.add("a & \"b\" < c", 2.0, one);
    file.add("still", one);
    CHECK(count(file.text(), "Name=\"a &amp; &quot;b&quot; &lt; c\"") == 2);
    CHECK(count(file.text(), "<Time") == 1);
    CHECK(tag_fault(file.text()).empty());
}

TEST_CASE("a run of 45 frames exported with every 10th gives 4 files with 5 times", "[paraview]") {
    const TempFolder folder;
    const RunData run = make_run();
    CHECK(write_paraview(run, folder / "pv", {10}) == 5);
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "pv")) {
        CAPTURE(entry.path());
        CHECK(entry.is_regular_file());
        ++files;
    }
    CHECK(files == 4);
    for (const char* name : {"run.xdmf", "shapes.xdmf"})
        CHECK(tag_fault(read_bytes(folder / "pv" / name)).empty());
    const std::string text = read_bytes(folder / "pv/run.xdmf");
    for (const char* part : {"water", "hull: bottom", "floes", "bodies"}) {
        CAPTURE(part);
        CHECK(count(text, "<Grid Name=\"" + std::string(part) + "\" GridType=\"Uniform\"") == 5);
        CHECK_FALSE(grid_at(text, part, "4").empty());
    }
    // no floe touches the hull at first
    CHECK(grid_at(text, "contacts", "0").empty());
    CHECK_FALSE(grid_at(text, "contacts", "4").empty());
    write_paraview(run, folder / "dots", {.points_only = true});
    const std::string dots = read_bytes(folder / "dots/run.xdmf");
    CHECK(count(dots, "Triangle") == 45);  // the water
    CHECK(count(dots, "<Grid Name=\"bodies\" GridType=\"Uniform\"") == 45);
}

TEST_CASE("exported corners are position + rotation of the mesh, states and forces the frame's",
          "[paraview][analytic]") {
    const TempFolder folder;
    const RunData run = make_run();
    write_paraview(run, folder / "pv", {1});
    const RunFrame& frame = run.frames[40];
    const std::string text = read_bytes(folder / "pv/run.xdmf");
    const Hdf5File file(folder / "pv/arrays.h5", Hdf5File::Mode::read);

    const std::string floes = grid_at(text, "floes", "4");
    const auto points = array_of<float>(file, floes, "<Geometry");
    const TriangleMesh& mesh = run.header.shapes[1].mesh;
    REQUIRE(points.size() == 6 * 8 * 3);
    for (std::size_t b = 0; b < 6; ++b)
        for (std::size_t v = 0; v < 8; ++v) {
            const Vec3 expected = frame.position[b] + frame.orientation[b] * mesh.vertices[v];
            const float* p = points.data() + 3 * (8 * b + v);
            CHECK((Vec3(p[0], p[1], p[2]) - expected).norm() < tolerance(1e-5));
        }
    const auto triangles = array_of<std::int32_t>(file, floes, "<Topology");
    REQUIRE(triangles.size() == 6 * 12 * 3);
    CHECK(triangles[3 * 12] == 8 + mesh.triangles[0][0]);
    const auto body = array_of<std::int32_t>(file, floes, "Name=\"body\"");
    const auto state = array_of<std::int32_t>(file, floes, "Name=\"state\"");
    const auto force = array_of<float>(file, floes, "Name=\"contact_force_N\"");
    REQUIRE(body.size() == 6 * 12);
    REQUIRE(force.size() == 6 * 12 * 3);
    CHECK(body[0] == 1);
    CHECK(body[71] == 6);
    CHECK(state[0] == static_cast<int>(frame.state[0]));
    for (std::size_t b = 0; b < 6; ++b)
        for (int d = 0; d < 3; ++d)
            CHECK(force[3 * (12 * b + 11) + static_cast<std::size_t>(d)] ==
                  static_cast<float>(frame.contact_force[b][d]));

    const std::string bodies = grid_at(text, "bodies", "4");
    const auto turn = array_of<float>(file, bodies, "Name=\"orientation\"");
    REQUIRE(turn.size() == 6 * 4);
    CHECK(turn[0] == static_cast<float>(frame.orientation[0].w()));
    const auto hull = array_of<float>(file, grid_at(text, "hull: bottom", "4"), "<Geometry");
    float aft = hull[0];
    for (std::size_t k = 0; k < hull.size(); k += 3) aft = std::min(aft, hull[k]);
    CHECK(aft == Near(4.0));  // 0 m + 1 m/s * 4 s
    const auto water = array_of<float>(file, grid_at(text, "water", "4"), "<Geometry");
    for (std::size_t k = 2; k < water.size(); k += 3) CHECK(water[k] == 0.0F);
    // from astern of the ship at the start to ahead of the bow at the end, 4.4 s later
    CHECK(std::min({water[0], water[3], water[6], water[9]}) < 0.0F);
    CHECK(std::max({water[0], water[3], water[6], water[9]}) > 12.4F);
    const auto contacts = array_of<float>(file, grid_at(text, "contacts", "4"), "<Geometry");
    REQUIRE(contacts.size() == 3 * frame.hull_contacts.size());
    for (std::size_t k = 0; k < frame.hull_contacts.size(); ++k) {
        const Vec3 expected = Vec3(4.0, 0.0, 0.0) + frame.hull_contacts[k].point;
        const float* p = contacts.data() + 3 * k;
        CHECK((Vec3(p[0], p[1], p[2]) - expected).norm() < tolerance(1e-5));
    }
}

TEST_CASE("a floe that is not there is a point in ParaView", "[paraview]") {
    const TempFolder folder;
    RunData run = make_run({.floes = 2, .frames = 2});
    run.frames[1].state[1] = FloeState::absent;
    write_paraview(run, folder / "pv", {1});
    const Hdf5File file(folder / "pv/arrays.h5", Hdf5File::Mode::read);
    const std::string floes = grid_at(read_bytes(folder / "pv/run.xdmf"), "floes", "0.1");
    const auto points = array_of<float>(file, floes, "<Geometry");
    for (std::size_t v = 0; v < 16; ++v) {
        const float* p = points.data() + 3 * v;
        const double far = (Vec3(p[0], p[1], p[2]) - run.frames[1].position[v / 8]).norm();
        CHECK((far < tolerance(1e-5)) == (v >= 8));
    }
}

TEST_CASE("forces of a 2D run are named per metre of breadth", "[paraview]") {
    const TempFolder folder;
    write_paraview(make_run({.dimension = 2}), folder / "pv", {40});
    const std::string text = read_bytes(folder / "pv/run.xdmf");
    CHECK(count(text, "\"contact_force_N_per_m\"") > 0);
    CHECK(count(text, "\"contact_force_N\"") == 0);
    CHECK_THAT(read_bytes(folder / "pv/view.py"), Catch::Contains("UNIT = \"_N_per_m\""));
}

TEST_CASE("0 floes are exported as no surfaces, a run without frames is an error", "[paraview]") {
    const TempFolder folder;
    CHECK(write_paraview(make_run({.floes = 0, .frames = 2}), folder / "pv", {1}) == 2);
    CHECK(count(read_bytes(folder / "pv/run.xdmf"), "Name=\"floes\"") == 0);
    RunData none = make_run();
    none.frames.clear();
    CHECK_THAT(error_text([&] { write_paraview(none, folder / "pv", {1}); }),
               Catch::Contains("no frames to export"));
    write_bytes(folder / "file", "");
    CHECK_THAT(error_text([&] { write_paraview(make_run(), folder / "file", {1}); }),
               Catch::Contains("cannot be created"));
}
