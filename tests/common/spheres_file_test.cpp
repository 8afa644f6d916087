// SPDX-License-Identifier: GPL-3.0-or-later
// Tolerances: 1e-7 is a normal stored as floats.
#include "common/formats/spheres_file.hpp"

#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <functional>
#include <limits>

#include "common/formats/hdf5_file.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// A box of 1 x 0.8 x 0.2 m with one sphere per face and one inside.
SphereSet make_set() {
    SphereSet set;
    set.radius = set.spacing = 0.1;
    set.mode = "fill";
    set.source_mesh = "floe.obj";
    set.source_sha256 = std::string(64, 'a');
    set.created_by = "spherize 0.1.0";
    set.command_line = "spherize floe.obj -r 0.1";
    set.mesh = make_box({1.0, 0.8, 0.2});
    set.mesh.region_names = {"hull", "side"};
    set.mesh.region[3] = 1;
    set.solid = measure_mass(set.mesh);
    const Vec3 half(0.5, 0.4, 0.1);
    for (int k = 0; k < 6; ++k) {
        const Vec3 normal = (k % 2 ? -1.0 : 1.0) * Vec3::Unit(k / 2);
        set.centers.push_back(normal.cwiseProduct(half) - 0.1 * normal);
        set.normals.push_back(normal);
    }
    set.centers.push_back(Vec3::Zero());
    const std::size_t n = set.centers.size();
    set.surface_count = n - 1;
    set.radii.assign(n, 0.1);
    set.normal_spread.assign(n - 1, 0.25);
    set.areas.assign(n - 1, set.solid.area / 6.0);
    set.volumes.assign(n, set.solid.volume / static_cast<double>(n));
    set.regions.assign(n - 1, 1);
    set.creases = {{2, Vec3::UnitX()}, {2, Vec3::UnitY()}};
    return set;
}

// Message of reading a set that `spoil` has changed before writing.
std::string spoiled(const std::function<void(SphereSet&)>& spoil) {
    const TempFolder folder;
    SphereSet set = make_set();
    spoil(set);
    write_spheres(folder / "x.spheres.h5", set);
    return error_text([&] { read_spheres(folder / "x.spheres.h5"); });
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("a sphere set comes back as written, normals to float precision", "[formats]") {
    const TempFolder folder;
    const SphereSet set = make_set();
    write_spheres(folder / "x.spheres.h5", set);
    const SphereSet back = read_spheres(folder / "x.spheres.h5");
    CHECK(back.dimension == 3);
    CHECK(back.radius == 0.1);
    CHECK(back.mode == "fill");
    CHECK(back.source_mesh == "floe.obj");
    CHECK(back.command_line == set.command_line);
    CHECK(back.centers == set.centers);
    CHECK(back.radii == set.radii);
    CHECK(back.areas == set.areas);
    CHECK(back.volumes == set.volumes);
    CHECK(back.surface_count == set.surface_count);
    CHECK(back.regions == set.regions);
    CHECK(back.normal_spread == set.normal_spread);
    REQUIRE(back.creases.size() == 2);
    CHECK(back.creases[1].sphere == 2);
    CHECK(back.creases[1].normal == Vec3::UnitY());
    REQUIRE(back.normals.size() == set.surface_count);
    for (std::size_t k = 0; k < set.surface_count; ++k)
        CHECK((back.normals[k] - set.normals[k]).norm() < tolerance(1e-7));
    CHECK(back.solid.volume == set.solid.volume);
    CHECK(back.solid.inertia == set.solid.inertia);
    CHECK(back.mesh.vertices == set.mesh.vertices);
    CHECK(back.mesh.triangles == set.mesh.triangles);
    CHECK(back.mesh.region == set.mesh.region);
    CHECK(back.mesh.region_names == set.mesh.region_names);
}

TEST_CASE("writing a set twice, a second apart, gives equal bytes", "[formats]") {
    const TempFolder folder;
    write_spheres(folder / "a.spheres.h5", make_set());
    usleep(1100000);  // HDF5's time stamps have whole seconds
    write_spheres(folder / "b.spheres.h5", make_set());
    CHECK(read_bytes(folder / "a.spheres.h5") == read_bytes(folder / "b.spheres.h5"));
    CHECK(folder.file_count() == 2);
}

TEST_CASE("the message names the dataset that holds a NaN", "[formats]") {
    CHECK_THAT(spoiled([](SphereSet& s) { s.centers[2].y() = kNan; }),
               Catch::Contains("x.spheres.h5: /center: holds a NaN or infinity"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.volumes[0] = kNan; }),
               Catch::Contains("/volume: holds"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.mesh.vertices[0].x() = kNan; }),
               Catch::Contains("/mesh/vertices: holds"));
}

TEST_CASE("wrong lengths, radii, normals and indices are each named", "[formats]") {
    CHECK_THAT(spoiled([](SphereSet& s) { s.radii.pop_back(); }),
               Catch::Contains("/radius: has another length than /center"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.radii[1] = 0.0; }),
               Catch::Contains("/radius: holds a radius that is not positive"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.normals[0] *= 0.9; }),
               Catch::Contains("/normal: holds a normal that is no unit vector"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.mesh.triangles[0][0] = 8; }),
               Catch::Contains("/mesh/triangles: points outside the vertices"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.mesh.triangles[0][0] = -1; }),
               Catch::Contains("/mesh/triangles: points outside the vertices"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.regions[0] = 2; }),
               Catch::Contains("/region: points outside /region_names"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.mesh.region.pop_back(); }),
               Catch::Contains("/mesh/region: has another length"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.solid.volume = -1.0; }),
               Catch::Contains("/solid: has a volume of -1 m3"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.solid.inertia.setZero(); }),
               Catch::Contains("/solid: has a moment of inertia of 0 m5"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.solid.inertia *= -1.0; }),
               Catch::Contains("/solid: has a moment of inertia of -"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.solid.inertia(1, 1) *= 10.0; }),
               Catch::Contains("one is above the sum of the others"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.solid.inertia(0, 1) += 1e-3; }),
               Catch::Contains("/solid: has an inertia that is not symmetric"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.solid.inertia(0, 0) = kNan; }),
               Catch::Contains("/solid: has an inertia that is no number"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.solid.centroid.x() = kNan; }),
               Catch::Contains("/solid: has a centroid that is no number"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.solid.area = kNan; }),
               Catch::Contains("/solid: has a surface of nan m2"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.dimension = 4; }),
               Catch::Contains("dimension: is neither 2 nor 3"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.radius = kNan; }),
               Catch::Contains("radius: is not positive"));
}

TEST_CASE("a set that contradicts its own mesh is refused with both values", "[formats]") {
    // box of 1 x 0.8 x 0.2 m: volume 0.16 m3, area 2.32 m2, I_xx = V (b^2 + c^2) / 12
    CHECK_THAT(spoiled([](SphereSet& s) { s.solid.volume *= 1.5; }),
               Catch::Contains("x.spheres.h5: /: has a volume of 0.24 m3 where the mesh has 0.16"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.solid.area *= 1.5; }),
               Catch::Contains("has an area of 3.48 m2 where the mesh has 2.32"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.solid.centroid.z() = 0.01; }),
               Catch::Contains("has a centroid 0.01 m off the mesh's centroid"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.solid.inertia *= 1.1; }),
               Catch::Contains("has an inertia of 0.00997333 m5 where the mesh has 0.00906667"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.volumes[3] *= 2.0; }),
               Catch::Contains("has shares of the volume that add up to 0.182857 of 0.16 m3"));
    CHECK_THAT(spoiled([](SphereSet& s) { s.areas[0] = 0.0; }),
               Catch::Contains("has shares of the area that add up to 1.93333 of 2.32 m2"));
    CHECK_THAT(spoiled([](SphereSet& s) {
                   s.centers[6] = {0.6, 0.0, 0.0};
               }),
               Catch::Contains("has sphere 6 at (0.6, 0, 0) m outside its mesh"));
}

TEST_CASE("files that are no sphere set say so, with the remedy", "[formats]") {
    const TempFolder folder;
    const auto complaint = [&] { return error_text([&] { read_spheres(folder / "x.h5"); }); };
    CHECK_THAT(complaint(), Catch::Contains("file not found"));
    write_bytes(folder / "x.h5", "solid floe\n");
    CHECK_THAT(complaint(), Catch::Contains("is not an HDF5 file, or is truncated"));
    { Hdf5File file(folder / "x.h5", Hdf5File::Mode::create); }
    CHECK_THAT(complaint(), Catch::Contains("is not a sphere set"));
    CHECK_THAT(complaint(), Catch::Contains("make the file again with spherize"));
    for (const auto& [format, kind, use] :
         {std::array{"icesolve-field", "an ice field, made by icefield", "pattern = \"file\""},
          std::array{"icesolve-flow", "a flow around a hull, made by iceflow", "[flow]"},
          std::array{"icesolve-result", "the result of a run", "icepost report"}}) {
        {
            Hdf5File file(folder / "x.h5", Hdf5File::Mode::create);
            file.write_attribute("/", "format", format);
        }
        CHECK_THAT(complaint(),
                   Catch::Contains(fmt::format("x.h5: is {}, not a sphere set", kind)) &&
                       Catch::Contains(use));
    }
    {
        Hdf5File file(folder / "x.h5", Hdf5File::Mode::create);
        file.write_attribute("/", "format", "icesolve-spheres");
        file.write_attribute("/", "format_version", std::int64_t{2});
    }
    CHECK_THAT(complaint(), Catch::Contains("has a format_version this program does not know"));
}

TEST_CASE("a file cut off anywhere is refused with exit code 2 and does not crash", "[formats]") {
    const TempFolder folder;
    write_spheres(folder / "whole.h5", make_set());
    const std::string bytes = read_bytes(folder / "whole.h5");
    for (std::size_t part = 0; part < 16; ++part) {
        write_bytes(folder / "cut.h5", bytes.substr(0, bytes.size() * part / 16));
        try {
            read_spheres(folder / "cut.h5");
            FAIL("a cut file was accepted");
        } catch (const Error& error) {
            CHECK(error.code() == ExitCode::bad_input);
            CHECK_THAT(error.what(), Catch::Contains("cut.h5"));
        }
    }
}

TEST_CASE("a file with each dataset missing in turn names what is missing", "[formats]") {
    const TempFolder folder;
    write_spheres(folder / "whole.h5", make_set());
    std::string bytes = read_bytes(folder / "whole.h5");
    bytes.replace(bytes.find(std::string("sealed\0", 7)), 6, "hidden");  // else the seal says it
    for (const std::string name :
         {"center", "radius", "normal", "area", "volume", "layer", "region", "region_names"}) {
        // HDF5 keeps link names as zero-ended text; another last letter hides the link. Attributes
        // may have the same name, so each place is tried.
        bool named = false;
        for (std::size_t at = 0; !named; ++at) {
            at = bytes.find('\0' + name + '\0', at);
            if (at == std::string::npos) break;
            std::string without = bytes;
            without[at + name.size()] = 'X';
            write_bytes(folder / "x.h5", without);
            const std::string text = error_text([&] { read_spheres(folder / "x.h5"); });
            named = text.find("/" + name + ": is missing") != std::string::npos;
        }
        CAPTURE(name);
        CHECK(named);
    }
}

TEST_CASE("a file of version 1 without normal_spread reads as spread 0", "[formats]") {
    const TempFolder folder;
    write_spheres(folder / "x.h5", make_set());
    std::string bytes = read_bytes(folder / "x.h5");
    bytes.replace(bytes.find(std::string("sealed\0", 7)), 6, "hidden");
    const std::string name = "normal_spread";
    bytes[bytes.find('\0' + name + '\0') + name.size()] = 'X';
    write_bytes(folder / "x.h5", bytes);
    CHECK(read_spheres(folder / "x.h5").normal_spread == std::vector<double>(6, 0.0));
}

TEST_CASE("a set that cannot be written leaves no file", "[formats]") {
    const TempFolder folder;
    CHECK_THAT(error_text([&] { write_spheres(folder / "no/x.h5", make_set()); }),
               Catch::Contains("cannot be created"));
    CHECK(folder.file_count() == 0);
}
