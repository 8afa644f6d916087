// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh files that ask for more than to be read: other files, memory, time.
#include <catch2/catch.hpp>

#include "common/base/error.hpp"
#include "preprocess/load/read_mesh.hpp"
#include "preprocess/load/refuse_short_file.hpp"
#include "preprocess/repair/make_solid.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/mesh_texts.hpp"

using namespace ice;
using namespace ice::test;

namespace {

std::string refusal(const std::filesystem::path& file) {
    return error_text([&] { read_mesh(file, {}); });
}

// glTF whose buffer is in a file of that name.
std::string gltf_beside(const std::string& uri) {
    return gltf_json(1, "\"uri\":\"" + uri + "\",", R"([{"mesh":0,"name":"bow"}])");
}

}  // namespace

TEST_CASE("formats that nobody asked for are refused by name", "[load][security]") {
    const TempFolder folder;
    for (const char* name : {"hull.3ds", "hull.blend", "hull.zae", "hull.lws", "hull.STEP", "hull"})
        write_bytes(folder / name, obj_text(1));
    CHECK_THAT(refusal(folder / "hull.3ds"), Catch::Contains("format that is not read (.3ds)") &&
                                                 Catch::Contains("formats are OBJ, STL"));
    for (const char* name : {"hull.blend", "hull.zae", "hull.lws", "hull.STEP"})
        CHECK_THAT(refusal(folder / name), Catch::Contains("format that is not read"));
    CHECK_THAT(refusal(folder / "hull"), Catch::Contains("does not say its format"));
    write_bytes(folder / "hull.OBJ", obj_text(1));
    CHECK(refusal(folder / "hull.OBJ").empty());
    // what is inside does not decide: a LightWave scene, which names other files, is no OBJ
    write_bytes(folder / "scene.obj", "LWSC\n3\nLoadObjectLayer 1 other.lwo\n");
    CHECK_THAT(refusal(folder / "scene.obj"), Catch::Contains("mesh"));
}

TEST_CASE("a glTF buffer is read from the mesh's own folder and nowhere else", "[load][security]") {
    const TempFolder folder;
    std::filesystem::create_directories(folder / "mesh/parts");
    for (const char* place : {"outer.bin", "mesh/buffer.bin", "mesh/parts/buffer.bin"})
        write_bytes(folder / place, gltf_buffer(1));
    std::filesystem::create_symlink("../outer.bin", folder / "mesh/link.bin");
    const auto with = [&](const std::string& uri) {
        write_bytes(folder / "mesh/hull.gltf", gltf_beside(uri));
        return refusal(folder / "mesh/hull.gltf");
    };
    CHECK(with("buffer.bin").empty());
    CHECK(with("parts/buffer.bin").empty());
    CHECK_THAT(with("../outer.bin"), Catch::Contains("cannot be read as a mesh"));
    CHECK_THAT(with((folder / "outer.bin").string()), Catch::Contains("cannot be read as a mesh"));
    CHECK_THAT(with("link.bin"), Catch::Contains("cannot be read as a mesh"));
}

TEST_CASE("an OBJ may name material libraries anywhere: they are not needed", "[load][security]") {
    const TempFolder folder;
    write_bytes(folder / "hull.obj",
                "mtllib ../../../../../../etc/passwd\nmtllib /etc/passwd\n" + obj_text(1));
    CHECK(refusal(folder / "hull.obj").empty());
}

TEST_CASE("nested XML entities do not multiply", "[load][security]") {
    const TempFolder folder;
    std::string text = dae_text(1, "");
    std::string doctype = "<!DOCTYPE x [<!ENTITY a0 \"1 \">";
    for (int k = 1; k < 40; ++k)  // 10^39 numbers
        doctype += fmt::format(
            "<!ENTITY a{0} \"&a{1};&a{1};&a{1};&a{1};&a{1};&a{1};&a{1};&a{1};"
            "&a{1};&a{1};\">",
            k, k - 1);
    doctype += "<!ENTITY file SYSTEM \"file:///etc/passwd\">]>";
    text.insert(text.find("?>") + 2, doctype);
    write_bytes(folder / "plain.dae", text);
    CHECK(refusal(folder / "plain.dae").empty());
    for (const char* entity : {"&a39;", "&file;"}) {
        std::string used = text;
        used.insert(used.find("float_array") + used.substr(used.find("float_array")).find('>') + 1,
                    entity);
        write_bytes(folder / "used.dae", used);
        CHECK_THAT(refusal(folder / "used.dae"), Catch::Contains("used.dae"));
    }
}

TEST_CASE("headers that promise what no file can hold are refused before memory is taken",
          "[load][security]") {
    const TempFolder folder;
    for (const char* count : {"4000000000", "9223372036854775807", "99999999999999999999"}) {
        write_bytes(folder / "a.ply",
                    "ply\nformat binary_little_endian 1.0\nelement vertex " + std::string(count) +
                        "\nproperty float x\nproperty float y\nproperty float z\n"
                        "element face 1\nproperty list uchar int v\nend_header\n" +
                        std::string(100, 'x'));
        CHECK_THAT(error_text([&] { refuse_short_file(folder / "a.ply"); }),
                   Catch::Contains("is cut off"));
        // rows of nothing take no room, however many: counting them must end
        write_bytes(folder / "b.ply", "ply\nformat binary_little_endian 1.0\nelement vertex " +
                                          std::string(count) + "\nend_header\n");
        CHECK_NOTHROW(refuse_short_file(folder / "b.ply"));
        CHECK_THAT(refusal(folder / "b.ply"), Catch::Contains("b.ply"));
        write_bytes(folder / "c.off", "OFF\n" + std::string(count) + " " + count + " 0\n0 0 0\n");
        CHECK_THAT(error_text([&] {
                       refuse_short_file(folder / "c.off");
                       read_mesh(folder / "c.off", {});
                   }),
                   Catch::Contains("c.off"));
    }
    std::string stl(80, ' ');
    append_bytes(stl, std::uint32_t{0xffffffff});
    write_bytes(folder / "d.stl", stl + std::string(50, '\0'));
    CHECK_THAT(refusal(folder / "d.stl"), Catch::Contains("d.stl"));
}

TEST_CASE("a mesh on which assimp crashes is refused", "[load][security]") {
    const TempFolder folder;
    write_bytes(folder / "a.off", "OFF\n1 1 2 3 0 0\n13 0 3 2\nA1 1 2 3");
    CHECK_THAT(refusal(folder / "a.off"),
               Catch::Contains("a.off") && Catch::Contains("the library that reads it"));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // memory is bounded
TEST_CASE("a mesh on which assimp never ends is refused", "[load][security]") {
    const TempFolder folder;
    std::string text = dae_text(1, "");
    text.insert(text.find("<p>") + 5,
                "\x1b[");  // no digit: it reads the same place again and again
    write_bytes(folder / "a.dae", text);
    CHECK_THAT(refusal(folder / "a.dae"),
               Catch::Contains("MB of memory to read") || Catch::Contains("s of processor time"));
}
#endif

TEST_CASE("a mesh of triangles without area is refused, not wrapped", "[load][repair][security]") {
    const TempFolder folder;
    write_bytes(folder / "a.obj",
                "v 0 0 0\nv 1 0 0\nv 0 \nv 2 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\n"
                "f 1 2 1 2 4\nf 1 4 3\nf 2 3 4\nv 0 0 3\nf 1 3 2\nf 1\nf 2 3 4\n");
    Repairs repairs;
    CHECK_THAT(
        error_text([&] { make_solid(read_mesh(folder / "a.obj", {}), "a.obj", {}, repairs); }),
        Catch::Contains("a.obj"));
}
