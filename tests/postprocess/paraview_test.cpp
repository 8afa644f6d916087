// SPDX-License-Identifier: GPL-3.0-or-later
#include <zlib.h>

#include <catch2/catch.hpp>
#include <cstring>

#include "postprocess/paraview/vtp.hpp"
#include "postprocess/paraview/write_paraview.hpp"
#include "tests/postprocess/make_folder.hpp"

using namespace ice;
using namespace ice::test;
using namespace ice::paraview;

namespace {

std::string attribute(const std::string& element, const std::string& name) {
    const std::size_t at = element.find(" " + name + "=\"");
    REQUIRE(at != std::string::npos);
    const std::size_t begin = at + name.size() + 3;
    return element.substr(begin, element.find('"', begin) - begin);
}

// The values of an array of a .vtp text: finds its offset, reads the header, decompresses.
template <class T>
std::vector<T> values_of(const std::string& text, const std::string& name, const char* type) {
    const std::size_t at = text.find("Name=\"" + name + "\"");
    REQUIRE(at != std::string::npos);
    const std::size_t begin = text.rfind('<', at);
    const std::string element = text.substr(begin, text.find('>', at) - begin);
    CHECK(attribute(element, "type") == type);
    const std::size_t data = text.find("encoding=\"raw\">_") + 16;
    const std::size_t offset = data + std::stoul(attribute(element, "offset"));
    std::uint64_t header[4] = {};
    REQUIRE(offset + 8 <= text.size());
    std::memcpy(header, text.data() + offset, 8);
    if (header[0] == 0) return {};
    std::memcpy(header, text.data() + offset, 32);
    CHECK(header[0] == 1);
    CHECK(header[2] == 0);
    std::vector<T> values(header[1] / sizeof(T));
    uLongf size = header[1];
    REQUIRE(uncompress(reinterpret_cast<Bytef*>(values.data()), &size,
                       reinterpret_cast<const Bytef*>(text.data() + offset + 32),
                       header[3]) == Z_OK);
    CHECK(size == header[1]);
    return values;
}

}  // namespace

TEST_CASE("points, triangles and data of a .vtp file come back from the compressed blocks",
          "[paraview]") {
    VtpFile file;
    file.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    file.triangles = {0, 1, 2, 0, 2, 3};
    file.cell_data = {make_array("body", 1, std::vector<std::int32_t>{7, 8}),
                      make_array("force", 3, std::vector<float>{1, 2, 3, 4, 5, 6})};
    const std::string text = vtp_text(file);
    CHECK_THAT(text, Catch::Contains("NumberOfPoints=\"4\" NumberOfVerts=\"0\""));
    CHECK_THAT(text, Catch::Contains("NumberOfPolys=\"2\""));
    CHECK_THAT(text, Catch::Contains("header_type=\"UInt64\""));
    CHECK(values_of<float>(text, "Points", "Float32") == file.points);
    CHECK(values_of<std::int32_t>(text, "body", "Int32") == std::vector<std::int32_t>{7, 8});
    CHECK(values_of<float>(text, "force", "Float32") == std::vector<float>{1, 2, 3, 4, 5, 6});
    CHECK(text.ends_with("</AppendedData></VTKFile>\n"));
}

TEST_CASE("points without triangles become one vertex each, an empty file has no cells",
          "[paraview]") {
    VtpFile file;
    file.points = {1, 2, 3, 4, 5, 6};
    const std::string text = vtp_text(file);
    CHECK_THAT(text, Catch::Contains("NumberOfVerts=\"2\""));
    CHECK(values_of<std::int32_t>(text, "connectivity", "Int32") ==
          std::vector<std::int32_t>{0, 1});
    CHECK_THAT(vtp_text({}), Catch::Contains("NumberOfPoints=\"0\" NumberOfVerts=\"0\""));
}

TEST_CASE("a run of 45 frames exported with every 10th gives 5 files of each kind", "[paraview]") {
    const TempFolder folder;
    const RunData run = make_run();
    CHECK(write_paraview(run, folder / "pv", {10}) == 5);
    for (const char* name : {"run.pvd", "floes.pvd", "hull.pvd", "bodies.pvd", "shapes.vtm"}) {
        CAPTURE(name);
        CHECK(tag_fault(read_bytes(folder / "pv" / name)).empty());
    }
    const std::string list = read_bytes(folder / "pv/floes.pvd");
    CHECK(count(list, "<DataSet") == 5);
    CHECK_THAT(list, Catch::Contains("timestep=\"4\""));
    CHECK(count(read_bytes(folder / "pv/run.pvd"), "<DataSet") == 10);
    for (const char* kind : {"floes", "hull", "bodies"})
        CHECK(std::filesystem::exists(folder / "pv/frames" / (std::string(kind) + "_00004.vtp")));
    CHECK_FALSE(std::filesystem::exists(folder / "pv/frames/floes_00005.vtp"));
}

TEST_CASE("exported corners are position + rotation of the mesh, states and forces the frame's",
          "[paraview]") {
    const TempFolder folder;
    const RunData run = make_run();
    write_paraview(run, folder / "pv", {1});
    const RunFrame& frame = run.frames[40];
    const std::string text = read_bytes(folder / "pv/frames/floes_00040.vtp");
    const auto points = values_of<float>(text, "Points", "Float32");
    const TriangleMesh& mesh = run.header.shapes[1].mesh;
    REQUIRE(points.size() == 6 * 8 * 3);
    for (std::size_t b = 0; b < 6; ++b)
        for (std::size_t v = 0; v < 8; ++v) {
            const Vec3 expected = frame.position[b] + frame.orientation[b] * mesh.vertices[v];
            const float* p = points.data() + 3 * (8 * b + v);
            CHECK((Vec3(p[0], p[1], p[2]) - expected).norm() < 1e-5);
        }
    const auto body = values_of<std::int32_t>(text, "body", "Int32");
    const auto state = values_of<std::int32_t>(text, "state", "Int32");
    const auto force = values_of<float>(text, "contact_force", "Float32");
    REQUIRE(body.size() == 6 * 12);
    REQUIRE(force.size() == 6 * 12 * 3);
    CHECK(body[0] == 1);
    CHECK(body[71] == 6);
    CHECK(state[0] == static_cast<int>(frame.state[0]));
    CHECK(force[0] == static_cast<float>(frame.contact_force[0].x()));

    const std::string bodies = read_bytes(folder / "pv/frames/bodies_00040.vtp");
    const auto turn = values_of<float>(bodies, "orientation", "Float32");
    REQUIRE(turn.size() == 6 * 4);
    CHECK(turn[0] == static_cast<float>(frame.orientation[0].w()));
    const std::string hull = read_bytes(folder / "pv/frames/hull_00040.vtp");
    CHECK(values_of<float>(hull, "Points", "Float32")[0] == Approx(4.0));  // 0 m + 1 m/s * 4 s
}

TEST_CASE("0 floes are exported as empty surfaces, a run without frames is an error",
          "[paraview]") {
    const TempFolder folder;
    CHECK(write_paraview(make_run({.floes = 0, .frames = 2}), folder / "pv", {1}) == 2);
    RunData none = make_run();
    none.frames.clear();
    CHECK_THAT(error_text([&] { write_paraview(none, folder / "pv", {1}); }),
               Catch::Contains("no frames to export"));
    write_bytes(folder / "file", "");
    CHECK_THAT(error_text([&] { write_paraview(make_run(), folder / "file", {1}); }),
               Catch::Contains("cannot be created"));
}
