// SPDX-License-Identifier: GPL-3.0-or-later
// Reading mesh files.
//
// Tolerances: 1e-14 and 1e-13 are rounding of a sum over a cube's triangles, and of a scale.
#include <catch2/catch.hpp>

#include "common/base/error.hpp"
#include "preprocess/clean/weld.hpp"
#include "preprocess/load/read_mesh.hpp"
#include "preprocess/repair/check_solid.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/temporary_file.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using test::TemporaryFile;

namespace {

const std::string kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\n"
    "g bottom\nf 1 3 2\ng side\nf 1 2 4\nf 1 4 3\ng bow\nf 2 3 4\n";

double volume_of(TriangleMesh mesh) {
    weld(mesh);
    return measure_mass(mesh).volume;
}

}  // namespace

TEST_CASE("OBJ groups become regions of their triangles", "[load]") {
    const TemporaryFile file(".obj", kTetrahedron);
    const TriangleMesh mesh = read_mesh(file.path(), {});
    REQUIRE(mesh.triangles.size() == 4);
    CHECK(mesh.region_names == std::vector<std::string>{"hull", "bottom", "side", "bow"});
    int count[4] = {};
    for (const std::int32_t r : mesh.region) ++count[r];
    CHECK(count[0] == 0);
    CHECK(count[1] == 1);
    CHECK(count[2] == 2);
    CHECK(count[3] == 1);
    CHECK(volume_of(mesh) == Near(1.0).epsilon(1e-14));
}

TEST_CASE("decimals that a float cannot hold come back as written", "[load]") {
    const TemporaryFile file(".obj", "v 0.15 0.1 -0.3\nv 0.7 0 0\nv 0 1.44 0\nf 1 2 3\n");
    const TriangleMesh mesh = read_mesh(file.path(), {});
    CHECK(mesh.vertices[0] == Vec3(0.15, 0.1, -0.3));
    CHECK(mesh.vertices[2].y() == 1.44);
}

TEST_CASE("a mesh without groups is region 0, hull", "[load]") {
    const TemporaryFile file(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const TriangleMesh mesh = read_mesh(file.path(), {});
    CHECK(mesh.region == std::vector<std::int32_t>{0});
    CHECK(mesh.region_names == std::vector<std::string>{"hull"});
}

TEST_CASE("STL and PLY hold the same solid as OBJ", "[load]") {
    const std::string stl =
        "solid t\n"
        "facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 2 0\nvertex 1 0 "
        "0\nendloop\nendfacet\n"
        "facet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 "
        "3\nendloop\nendfacet\n"
        "facet normal -1 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 3\nvertex 0 2 "
        "0\nendloop\nendfacet\n"
        "facet normal 1 1 1\nouter loop\nvertex 1 0 0\nvertex 0 2 0\nvertex 0 0 "
        "3\nendloop\nendfacet\n"
        "endsolid t\n";
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 2 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    CHECK(volume_of(read_mesh(TemporaryFile(".stl", stl).path(), {})) == Near(1.0).epsilon(1e-14));
    CHECK(volume_of(read_mesh(TemporaryFile(".ply", ply).path(), {})) == Near(1.0).epsilon(1e-14));
}

TEST_CASE("scale, up and forward turn the file's axes into the ship's", "[load]") {
    const TemporaryFile file(".obj", kTetrahedron);
    ReadOptions options;
    options.scale = 0.001;
    CHECK(volume_of(read_mesh(file.path(), options)) == Near(1e-9).epsilon(1e-13));

    options = {};
    options.up = "y";
    options.forward = "-z";
    const TriangleMesh turned = read_mesh(file.path(), options);
    // file y is up, file -z forward, so port is up x forward = y x -z = -x
    CHECK(volume_of(turned) == Near(1.0).epsilon(1e-14));
    bool found = false;
    for (const Vec3& v : turned.vertices) found = found || v.isApprox(Vec3(-3, 0, 0));
    CHECK(found);

    options.forward = "+y";
    CHECK_THROWS_WITH(read_mesh(file.path(), options), Catch::Contains("up axis"));
}

TEST_CASE("option mirror y doubles half a box into a closed one", "[load]") {
    // the half with y >= 0 of a 2 x 2 x 2 box, open in the plane y = 0
    TriangleMesh half = test::make_box_mesh(Vec3(2, 1, 2));
    for (Vec3& v : half.vertices) v.y() += 0.5;
    TriangleMesh open;
    open.vertices = half.vertices;
    for (std::size_t t = 0; t < half.triangles.size(); ++t)
        if (half.area_vector(t).y() > -0.5) {
            open.triangles.push_back(half.triangles[t]);
            open.region.push_back(0);
        }
    const TemporaryFile file(".obj", "");
    test::write_obj(file.path(), open);
    ReadOptions options;
    options.mirror_y = true;
    ReadNotes notes;
    TriangleMesh whole = read_mesh(file.path(), options, &notes);
    weld(whole);
    CHECK(diagnose_solid(whole).good());
    CHECK(measure_mass(whole).volume == Near(8.0).epsilon(1e-14));
    for (const std::string& warning : notes.warnings)
        CHECK_THAT(warning, !Catch::Contains("both sides"));

    test::write_obj(file.path(), test::make_box_mesh(Vec3(2, 2, 2)));
    read_mesh(file.path(), options, &notes);
    REQUIRE(!notes.warnings.empty());
    CHECK_THAT(notes.warnings.back(), Catch::Contains("both sides of y = 0"));
}

TEST_CASE("bad mesh files are refused by name", "[load][errors]") {
    CHECK_THROWS_WITH(read_mesh("/nonexistent.obj", {}), Catch::Contains("not found"));
    CHECK_THROWS_WITH(read_mesh(TemporaryFile(".obj", "").path(), {}),
                      Catch::Contains("cannot be read"));
    CHECK_THROWS_WITH(read_mesh(TemporaryFile(".ply", "").path(), {}),
                      Catch::Contains("cannot be read"));
    CHECK_THROWS_WITH(read_mesh(TemporaryFile(".stl", "solid\n").path(), {}),
                      Catch::Contains("mesh"));
    CHECK_THROWS_WITH(
        read_mesh(TemporaryFile(".obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").path(), {}),
        Catch::Contains("not a finite number"));
}

TEST_CASE("the SHA-256 of a file is that of its bytes", "[load][analytic]") {
    CHECK(file_sha256(TemporaryFile(".txt", "abc").path()) ==
          "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST_CASE("a mesh in map coordinates is refused where floats are too coarse for it",
          "[load][errors]") {
    const auto tetrahedron_at = [](const std::string& x) {
        return "v " + x + "0 0 0\nv " + x + "4 0 0\nv " + x + "0 2 0\nv " + x +
               "0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    };
    const TemporaryFile near(".obj", tetrahedron_at("1")), far(".obj", tetrahedron_at("100")),
        map(".obj", tetrahedron_at("650000"));
    ReadNotes notes;
    read_mesh(near.path(), {}, &notes);
    CHECK(notes.warnings.empty());
    read_mesh(far.path(), {}, &notes);
    REQUIRE(notes.warnings.size() == 1);
    CHECK_THAT(notes.warnings[0], Catch::Contains("move it to the origin"));
    CHECK_THROWS_WITH(read_mesh(map.path(), {}), Catch::Contains("6.5e+06 m from its origin"));
}
