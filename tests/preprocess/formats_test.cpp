// SPDX-License-Identifier: GPL-3.0-or-later
// Every format: the same tetrahedron, its volume and where its centroid comes to lie.
#include <zlib.h>

#include <catch2/catch.hpp>

#include "common/base/error.hpp"
#include "common/geometry/mass_properties.hpp"
#include "preprocess/clean/weld.hpp"
#include "preprocess/load/gunzip.hpp"
#include "preprocess/load/read_mesh.hpp"
#include "tests/support/fbx_texts.hpp"
#include "tests/support/mesh_texts.hpp"
#include "tests/support/temporary_file.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;
using test::TemporaryFile;

namespace {

// zlib's own one-step compression with a gzip header.
std::string gzip(const std::string& bytes) {
    z_stream stream{};
    REQUIRE(deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 9, Z_DEFAULT_STRATEGY) == Z_OK);
    std::string out(deflateBound(&stream, bytes.size()) + 64, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

struct Read {
    double volume;
    Vec3 centroid;
    ReadNotes notes;
    std::vector<std::string> regions;
};

Read read(const std::string& suffix, const std::string& bytes, const ReadOptions& options = {}) {
    Read r;
    const TemporaryFile file(suffix, bytes);
    TriangleMesh mesh = read_mesh(file.path(), options, &r.notes);
    weld(mesh);
    const MassProperties mass = measure_mass(mesh);
    r.volume = mass.volume;
    r.centroid = mass.centroid;
    r.regions = mesh.region_names;
    return r;
}

// rounding of sums of a dozen terms
constexpr double kRounding = 1e-13;

void check(const Read& r, const Vec3& centroid, double volume = 1.0) {
    CHECK(r.volume == Near(volume).epsilon(kRounding));
    CHECK((r.centroid - centroid).norm() < tolerance(kRounding) * centroid.norm());
}

bool warned(const Read& r, const std::string& words) {
    for (const std::string& warning : r.notes.warnings)
        if (warning.find(words) != std::string::npos) return true;
    return false;
}

const Vec3 kAsDrawn(0.25, 0.5, 0.75);
const Vec3 kFromYUp(0.25, -0.75, 0.5);  // file y is up, file x forward: port is file -z

}  // namespace

TEST_CASE("formats without metadata keep metres and axes, compressed or not",
          "[load][formats][analytic]") {
    const std::pair<const char*, std::string> files[] = {
        {".obj", test::obj_text(1)}, {".stl", test::stl_text(1)},  {".STL", test::stl_bytes(1)},
        {".ply", test::ply_text(1)}, {".ply", test::ply_bytes(1)}, {".off", test::off_text(1)}};
    for (const auto& [suffix, bytes] : files) {
        CAPTURE(suffix);
        check(read(suffix, bytes), kAsDrawn);
        const Read packed = read(std::string(suffix) + ".gz", gzip(bytes));
        check(packed, kAsDrawn);
        CHECK(packed.notes.guessed.at("units") == "m, as the file has them");
        CHECK(packed.notes.guessed.at("up") == "z");
        CHECK(packed.notes.guessed.at("forward") == "+x");
    }
}

TEST_CASE("Collada's unit and up axis are used once, and options replace them",
          "[load][formats][analytic]") {
    const std::string mm = "<unit name=\"millimeter\" meter=\"0.001\"/>";
    const Read z_up = read(".dae", test::dae_text(1000, mm + "<up_axis>Z_UP</up_axis>"));
    check(z_up, kAsDrawn);
    CHECK(z_up.notes.guessed.at("units") == "mm, as the Collada file says");
    CHECK(z_up.notes.guessed.at("up") == "z, as the Collada file says");
    CHECK(z_up.regions == std::vector<std::string>{"hull", "bow"});

    check(read(".dae", test::dae_text(1000, mm + "<up_axis>Y_UP</up_axis>")), kFromYUp);
    check(read(".dae.gz", gzip(test::dae_text(1, ""))), kFromYUp);  // its defaults: 1 m, y up
    // x up, forward +y: port is x cross y = z
    check(read(".dae", test::dae_text(1, "<up_axis>X_UP</up_axis>")), Vec3(0.5, 0.75, 0.25));

    ReadOptions options;
    options.scale = 0.01;
    options.up = "y";
    options.forward = "+x";
    const Read told = read(".dae", test::dae_text(100, mm + "<up_axis>Z_UP</up_axis>"), options);
    check(told, kFromYUp);
    CHECK(told.notes.guessed.empty());
}

TEST_CASE("a node's translation is in file units, and a reflecting node turns its triangles over",
          "[load][formats][analytic]") {
    // 2 m along x and 1 m along y, in millimetres; then x -> -x
    const std::string asset = "<unit meter=\"0.001\"/><up_axis>Z_UP</up_axis>";
    check(read(".dae", test::dae_text(1000, asset, "1 0 0 2000 0 1 0 1000 0 0 1 0 0 0 0 1")),
          kAsDrawn + Vec3(2, 1, 0));
    check(read(".dae", test::dae_text(1000, asset, "-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1")),
          Vec3(-0.25, 0.5, 0.75));
    check(read(".gltf", test::gltf_text(1, R"([{"children":[1],"scale":[2,2,2]},)"
                                           R"({"mesh":0,"name":"bow","scale":[1,1,-1]}])")),
          Vec3(0.5, 1.5, 1.0), 8.0);
    check(read(".fbx", test::fbx_text(100, test::fbx_settings(2, 1, 1, -1, 0, 1), "1,-1,1")),
          Vec3(0.25, -0.5, 0.75));
}

TEST_CASE("glTF is metres and y up, its parts are its nodes", "[load][formats][analytic]") {
    for (const auto& [suffix, bytes] :
         {std::pair{".gltf", test::gltf_text(1)}, std::pair{".glb", test::glb_bytes(1)},
          std::pair{".gltf.gz", gzip(test::gltf_text(1))},
          std::pair{".glb.gz", gzip(test::glb_bytes(1))}}) {
        CAPTURE(suffix);
        const Read r = read(suffix, bytes);
        check(r, kFromYUp);
        CHECK(r.notes.guessed.at("units") == "m, as glTF defines");
        CHECK(r.notes.guessed.at("up") == "y, as glTF defines");
        CHECK(r.regions == std::vector<std::string>{"hull", "bow"});
    }
    ReadOptions options;
    options.up = "z";
    check(read(".gltf", test::gltf_text(1), options), kAsDrawn);
}

TEST_CASE("FBX says its unit in centimetres, and its axes", "[load][formats][analytic]") {
    const Read maya = read(".fbx", test::fbx_text(100, test::fbx_settings(1, 1, 2, 1, 0, 1)));
    check(maya, kFromYUp);
    CHECK(maya.notes.guessed.at("units") == "cm, as the FBX file says");
    CHECK(maya.notes.guessed.at("up") == "y, as the FBX file says");
    CHECK(maya.regions == std::vector<std::string>{"hull", "bow"});

    const Read binary = read(".fbx", test::fbx_bytes(100, 1.0));
    check(binary, kFromYUp);
    CHECK(binary.notes.guessed == maya.notes.guessed);
    CHECK(binary.regions == maya.regions);
    check(read(".fbx.gz", gzip(test::fbx_bytes(1, 100.0))), kFromYUp);

    check(read(".fbx", test::fbx_text(1000, test::fbx_settings(2, 1, 1, -1, 0, 0.1))), kAsDrawn);
    check(read(".fbx", test::fbx_text(1, test::fbx_settings(2, 1, 1, -1, 0, 100))), kAsDrawn);
    // y down, x forward: port is -y cross x = z
    const Read down = read(".fbx", test::fbx_text(100, test::fbx_settings(1, -1, 2, -1, 0, 1)));
    check(down, Vec3(0.25, 0.75, -0.5));
    CHECK(down.notes.guessed.at("up") == "-y, as the FBX file says");
    CHECK_FALSE(warned(down, "left-handed"));

    const Read left = read(".fbx", test::fbx_text(100, test::fbx_settings(1, 1, 2, -1, 0, 1)));
    CHECK(warned(left, "left-handed"));

    ReadOptions options;
    options.scale = 1.0;
    options.up = "z";
    check(read(".fbx", test::fbx_text(1, test::fbx_settings(1, 1, 2, 1, 0, 1)), options), kAsDrawn);
}

TEST_CASE("damaged, nameless and bursting gzip files are refused", "[load][formats][errors]") {
    const std::string packed = gzip(test::stl_bytes(1));
    const auto refused = [](const std::string& suffix, const std::string& bytes,
                            const std::string& words) {
        CHECK_THROWS_WITH(read(suffix, bytes), Catch::Contains(words));
    };
    refused(".stl.gz", packed.substr(0, packed.size() / 2), "ends too early");
    refused(".stl.gz", packed.substr(0, packed.size() - 4), "ends too early");
    refused(".stl.gz", "", "no complete gzip file");
    refused(".stl.gz", test::stl_text(1), "does not begin as one");
    std::string bent = packed;
    bent[packed.size() - 6] = static_cast<char>(bent[packed.size() - 6] ^ 1);  // the check sum
    refused(".stl.gz", bent, "no complete gzip file");
    refused(".gz", packed, "does not say the format inside");

    const TemporaryFile zeros(".stl.gz", gzip(std::string(3'000'000, '\0')));
    CHECK(gunzip(zeros.path(), 3'000'000) == std::vector<char>(3'000'000, '\0'));
    CHECK_THROWS_WITH(gunzip(zeros.path(), 2'999'999),
                      Catch::Contains("unpacks to more than 2999999 bytes"));
}

TEST_CASE("files that end too early are refused, whatever assimp makes of them",
          "[load][formats][errors]") {
    const auto refused = [](const std::string& suffix, const std::string& bytes,
                            const std::string& words) {
        CHECK_THROWS_WITH(read(suffix, bytes), Catch::Contains(words));
    };
    const std::string ply = test::ply_text(1), header = ply.substr(0, 37);
    refused(".ply", header, "PLY header has no end");
    refused(".ply.gz", gzip(header), "PLY header has no end");
    // 40 bytes less: the faces, and the end of the last vertex
    refused(".ply", ply.substr(0, ply.size() - 40), "face 1 refers to no vertex");
    refused(".ply", ply.substr(0, ply.size() - 2) + "9\n", "face 4 refers to no vertex");
}

TEST_CASE("the stem of a mesh is its name without format and compression", "[load][formats]") {
    CHECK(mesh_stem("a/hull.stl") == "hull");
    CHECK(mesh_stem("a/hull.v2.stl.GZ") == "hull.v2");
}
