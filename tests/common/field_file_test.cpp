// SPDX-License-Identifier: GPL-3.0-or-later
// Tolerances: 1e-7 is a normal stored as floats.
#include "common/formats/field_file.hpp"

#include <catch2/catch.hpp>
#include <functional>
#include <limits>

#include "common/formats/hdf5_file.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// A box with one sphere per face, and `inside` more.
SphereSet make_shape(const Vec3& size, int inside) {
    SphereSet set;
    set.radius = 0.1;
    set.spacing = 0.2;
    set.mode = "fill";
    set.mesh = make_box(size);
    set.mesh.region_names = {"ice"};
    set.solid = measure_mass(set.mesh);
    for (int k = 0; k < 6; ++k) {
        const Vec3 normal = (k % 2 ? -1.0 : 1.0) * Vec3::Unit(k / 2);
        set.centers.push_back(normal.cwiseProduct(0.5 * size) - 0.1 * normal);
        set.normals.push_back(normal);
    }
    set.surface_count = 6;
    for (int k = 0; k < inside; ++k) set.centers.emplace_back(0.01 * k, 0.0, 0.0);
    set.radii.assign(set.size(), 0.1);
    set.volumes.assign(set.size(), set.solid.volume / static_cast<double>(set.size()));
    set.normal_spread.assign(6, 0.25);
    set.areas.assign(6, set.solid.area / 6.0);
    set.regions.assign(6, 0);
    if (inside > 0) set.creases = {{2, Vec3::UnitX()}, {2, Vec3::UnitY()}};
    return set;
}

Field make_field() {
    Field field;
    field.radius = 0.1;
    field.spacing = 0.2;
    field.mode = "fill";
    field.area = {-1.0, -2.0, 3.0, 4.0};
    field.concentration = 0.8;
    field.specification = "seed = 7\n";
    field.seed = 7;
    field.created_by = "icefield 0.1.0";
    field.command_line = "icefield spec.toml";
    field.shapes = {make_shape({1.0, 0.8, 0.4}, 0), make_shape({2.0, 1.0, 0.4}, 3)};
    field.floes.resize(3);
    field.floes[1].shape = 1;
    field.floes[1].position = {1.5, -0.5};
    field.floes[1].orientation = Eigen::Quaterniond(0.6, 0.0, 0.0, 0.8);
    field.floes[2].fixed = true;
    return field;
}

std::string spoiled(const std::function<void(Field&)>& spoil) {
    const TempFolder folder;
    Field field = make_field();
    spoil(field);
    write_field(folder / "field.h5", field);
    return error_text([&] { read_field(folder / "field.h5"); });
}

}  // namespace

TEST_CASE("a field comes back as written, normals to float precision", "[formats]") {
    const TempFolder folder;
    const Field field = make_field();
    write_field(folder / "field.h5", field);
    const Field back = read_field(folder / "field.h5");
    CHECK(back.radius == 0.1);
    CHECK(back.spacing == 0.2);
    CHECK(back.mode == "fill");
    CHECK(back.area == field.area);
    CHECK(back.concentration == 0.8);
    CHECK(back.specification == field.specification);
    CHECK(back.seed == 7);
    CHECK(back.command_line == field.command_line);
    REQUIRE(back.shapes.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) {
        const SphereSet &is = back.shapes[k], &was = field.shapes[k];
        CHECK(is.centers == was.centers);
        CHECK(is.radii == was.radii);
        CHECK(is.volumes == was.volumes);
        CHECK(is.surface_count == was.surface_count);
        CHECK(is.areas == was.areas);
        CHECK(is.normal_spread == was.normal_spread);
        REQUIRE(is.creases.size() == was.creases.size());
        for (std::size_t c = 0; c < is.creases.size(); ++c) {
            CHECK(is.creases[c].sphere == was.creases[c].sphere);
            CHECK(is.creases[c].normal == was.creases[c].normal);
        }
        for (std::size_t n = 0; n < is.normals.size(); ++n)
            CHECK((is.normals[n] - was.normals[n]).norm() < tolerance(1e-7));
        CHECK(is.solid.volume == was.solid.volume);
        CHECK(is.solid.inertia == was.solid.inertia);
        CHECK(is.mesh.vertices == was.mesh.vertices);
        CHECK(is.mesh.triangles == was.mesh.triangles);
        CHECK(is.mesh.region == was.mesh.region);
    }
    REQUIRE(back.floes.size() == 3);
    CHECK(back.floes[1].shape == 1);
    CHECK(back.floes[1].position == field.floes[1].position);
    CHECK(back.floes[1].orientation.coeffs() == field.floes[1].orientation.coeffs());
    CHECK(back.floes[2].fixed);
    CHECK_FALSE(back.floes[1].fixed);
}

TEST_CASE("writing a field twice, a second apart, gives equal bytes", "[formats]") {
    const TempFolder folder;
    write_field(folder / "a.h5", make_field());
    usleep(1100000);  // HDF5's time stamps have whole seconds
    write_field(folder / "b.h5", make_field());
    CHECK(read_bytes(folder / "a.h5") == read_bytes(folder / "b.h5"));
    CHECK(folder.file_count() == 2);
}

TEST_CASE("what is wrong in a field is named with file and dataset", "[formats]") {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THAT(spoiled([](Field& f) { f.floes[0].shape = 2; }),
               Catch::Contains("field.h5: /floe/shape: points outside the shapes"));
    CHECK_THAT(spoiled([](Field& f) { f.floes[0].position[1] = kNan; }),
               Catch::Contains("/floe/position: holds a NaN"));
    CHECK_THAT(spoiled([](Field& f) { f.floes[0].orientation.w() = 2.0; }),
               Catch::Contains("/floe/orientation: holds a quaternion"));
    CHECK_THAT(spoiled([](Field& f) { f.shapes[1].normals[2] *= 2.0; }),
               Catch::Contains("/surface/normal: holds"));
    CHECK_THAT(spoiled([](Field& f) { f.shapes[1].creases[0].sphere = 6; }),
               Catch::Contains("/crease/sphere: points outside"));
    CHECK_THAT(spoiled([](Field& f) { f.shapes[0].mesh.triangles[0][1] = 8; }),
               Catch::Contains("/mesh/triangles: points outside"));
    CHECK_THAT(spoiled([](Field& f) { f.shapes[0].areas.pop_back(); }),
               Catch::Contains("/surface/area: has another length"));
    CHECK_THAT(spoiled([](Field& f) { f.shapes[0].solid.volume = -1.0; }),
               Catch::Contains("/shape: has a volume"));
    CHECK_THAT(spoiled([](Field& f) { f.shapes[1].solid.volume *= 1.5; }),
               Catch::Contains("/shape: has, of shape 1, a volume of 1.2 m3 where the mesh "
                               "has 0.8"));
    CHECK_THAT(spoiled([](Field& f) { f.floes.clear(); }),
               Catch::Contains("/floe/shape: is empty"));
    CHECK_THAT(spoiled([](Field& f) { f.radius = 0.0; }), Catch::Contains("are not positive"));
}

TEST_CASE("a file of another format, or of none, is said to be no ice field", "[formats]") {
    const TempFolder folder;
    const std::string format = GENERATE("", "icesolve-spheres", "somebody's");
    {
        Hdf5File file(folder / "field.h5", Hdf5File::Mode::create);
        if (!format.empty()) file.write_attribute("/", "format", format);
    }
    CHECK_THAT(error_text([&] { read_field(folder / "field.h5"); }),
               Catch::Contains(format == "icesolve-spheres"
                                   ? "field.h5: is a sphere set, made by spherize, not an ice field"
                                   : "field.h5: /: is not an ice field"));
}
