// SPDX-License-Identifier: GPL-3.0-or-later
// Files that end too early.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "common/base/error.hpp"
#include "preprocess/load/looks_cut_off.hpp"
#include "preprocess/load/refuse_short_file.hpp"
#include "tests/support/make_meshes.hpp"

using namespace ice;
namespace fs = std::filesystem;

namespace {

class File {
public:
    File(const std::string& name, const std::string& text)
        : path(fs::temp_directory_path() / ("ice-cut-off-" + name)) {
        std::ofstream(path, std::ios::binary) << text;
    }
    ~File() { fs::remove(path); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    fs::path path;
};

const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const std::string kOff =
    "OFF\n# a comment\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n"
    "3 0 3 2\n3 1 2 3\n";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
    "property float y\nproperty float z\nelement face 4\n"
    "property list uchar int vertex_indices\nend_header\n" +
    kOff.substr(kOff.find("0 0 0"));

// The same with numbers as bytes, of this machine's order.
std::string binary_ply() {
    std::string out = kPly.substr(0, kPly.find("end_header")) + "end_header\n";
    out.replace(out.find("ascii"), 5, "binary_little_endian");
    const auto put = [&](auto value) {
        out.append(reinterpret_cast<const char*>(&value), sizeof(value));
    };
    for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f}) put(x);
    for (const auto& t : {std::array{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
        put(std::uint8_t{3});
        for (const std::int32_t v : t) put(v);
    }
    return out;
}

}  // namespace

TEST_CASE("an OBJ whose last vertices no face uses, or whose last face is a piece, seems cut off",
          "[load][cut]") {
    CHECK(looks_cut_off(File("whole.obj", kObj).path).empty());
    CHECK(looks_cut_off(File("back.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -3\n").path).empty());
    CHECK_THAT(looks_cut_off(File("1.obj", kObj.substr(0, kObj.find("f 1 2 4"))).path),
               Catch::Contains("no face uses its last 1 vertices"));
    CHECK_THAT(looks_cut_off(File("2.obj", kObj.substr(0, kObj.size() - 3)).path),
               Catch::Contains("its last face has 2 corners"));
    CHECK(looks_cut_off("there-is-no-such-file.obj").empty());
}

TEST_CASE("an ASCII STL without endsolid seems cut off", "[load][cut]") {
    const std::string stl =
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
        "endloop\nendfacet\n";
    CHECK(looks_cut_off(File("a.stl", stl + "endsolid a\n").path).empty());
    CHECK_THAT(looks_cut_off(File("b.stl", stl).path), Catch::Contains("endsolid"));
}

TEST_CASE("a binary STL is refused with what its header promises", "[load][cut][errors]") {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "ice-cut-off.stl";
    const auto write = [&](std::size_t bytes) {
        std::string text(80, ' ');
        text.append("\x03\0\0\0", 4).append(150, '\0');
        std::ofstream(file, std::ios::binary) << text.substr(0, bytes);
    };
    write(84 + 149);
    CHECK_THROWS_WITH(refuse_short_file(file),
                      Catch::Contains("promises 3 triangles, 2 are whole"));
    write(50);
    CHECK_THROWS_WITH(refuse_short_file(file), Catch::Contains("is cut off"));
    write(84 + 150);
    CHECK_NOTHROW(refuse_short_file(file));
    std::filesystem::remove(file);
}

TEST_CASE("PLY and OFF files are refused wherever they are cut", "[load][cut][errors]") {
    const auto [name, text] = GENERATE(std::pair<std::string, std::string>("a.off", kOff),
                                       std::pair<std::string, std::string>("a.ply", kPly),
                                       std::pair<std::string, std::string>("b.ply", binary_ply()));
    CHECK_NOTHROW(refuse_short_file(File("whole-" + name, text).path));
    const std::size_t body = name == "a.off" ? text.find("0 0 0") : text.find("end_header") + 11;
    for (std::size_t size = body; size + 2 < text.size(); ++size) {
        const File cut("cut-" + name, text.substr(0, size));
        CHECK_THROWS_WITH(refuse_short_file(cut.path),
                          Catch::Contains(name) && Catch::Contains("is cut off"));
    }
}
