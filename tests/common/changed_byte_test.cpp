// SPDX-License-Identifier: GPL-3.0-or-later
// Sphere sets, fields and flows of which a byte was changed after they were written.
#include <catch2/catch.hpp>
#include <random>

#include "common/formats/field_file.hpp"
#include "common/formats/flow_file.hpp"
#include "common/formats/hdf5_file.hpp"
#include "common/formats/spheres_file.hpp"
#include "tests/common/fixtures.hpp"

using namespace ice;
using namespace ice::test;

namespace {

constexpr int kFlips = 200;

SphereSet make_small_set() {
    SphereSet set;
    set.radius = set.spacing = 0.1;
    set.mode = "fill";
    set.source_mesh = "floe.obj";
    set.command_line = "spherize floe.obj -r 0.1";
    set.mesh = make_box({1.0, 0.8, 0.2});
    set.mesh.region_names = {"ice"};
    set.solid = measure_mass(set.mesh);
    set.centers = {Vec3(0.0, 0.0, 0.0), Vec3(0.4, 0.0, 0.0), Vec3(-0.4, 0.0, 0.0)};
    set.normals = {Vec3::UnitZ(), Vec3::UnitX()};
    set.surface_count = 2;
    set.radii.assign(3, 0.1);
    set.volumes.assign(3, set.solid.volume / 3.0);
    set.normal_spread.assign(2, 0.25);
    set.areas.assign(2, set.solid.area / 2.0);
    set.regions.assign(2, 0);
    set.creases = {{1, Vec3::UnitX()}, {1, Vec3::UnitY()}};
    return set;
}

Field make_small_field() {
    Field field;
    field.radius = field.spacing = 0.1;
    field.mode = "fill";
    field.area = {-1.0, 1.0, -1.0, 1.0};
    field.specification = "seed = 7\n";
    field.shapes = {make_small_set()};
    field.floes.resize(2);
    field.floes[1].position = {1.5, -0.5};
    return field;
}

FlowTable make_flow() {
    FlowTable flow;
    flow.nodes = {3, 2, 2};
    flow.spacing = 0.5;
    flow.origin = Vec3(-0.5, 0.0, -0.5);
    flow.symmetric = true;
    flow.draught = 0.4;
    flow.reference_speed = 1.0;
    flow.source_sha256 = std::string(64, 'a');
    for (std::size_t k = 0; k < flow.size(); ++k) {
        flow.potential.push_back(0.125f * static_cast<float>(k));
        for (int d = 0; d < 3; ++d) flow.velocity.push_back(0.25f * static_cast<float>(d));
    }
    return flow;
}

// Flips a random bit of each of kFlips evenly spread bytes. What is read all the same is written
// again: equal bytes are equal content.
template <class Write, class Read>
void refuse_all(const Write& write, const Read& read) {
    const TempFolder folder;
    write(folder / "whole.h5");
    const std::string bytes = read_bytes(folder / "whole.h5");
    std::mt19937 random(1);
    for (std::size_t k = 0; k < kFlips; ++k) {
        std::string changed = bytes;
        const std::size_t at = bytes.size() * k / kFlips + random() % (bytes.size() / kFlips);
        changed[at] = static_cast<char>(changed[at] ^ (1 << random() % 8));
        write_bytes(folder / "changed.h5", changed);
        CAPTURE(at);
        try {
            read(folder / "changed.h5", folder / "again.h5");
        } catch (const Error& error) {
            CHECK(error.code() == ExitCode::bad_input);
            CHECK_THAT(error.what(), Catch::Contains("changed.h5"));
            continue;
        }
        CHECK(read_bytes(folder / "again.h5") == bytes);
    }
}

}  // namespace

TEST_CASE("a sphere set with a changed bit is refused or as before", "[formats][seal]") {
    refuse_all(
        [](const auto& path) { write_spheres(path, make_small_set()); },
        [](const auto& path, const auto& again) { write_spheres(again, read_spheres(path)); });
}

TEST_CASE("a field with a changed bit is refused or as before", "[formats][seal]") {
    refuse_all([](const auto& path) { write_field(path, make_small_field()); },
               [](const auto& path, const auto& again) { write_field(again, read_field(path)); });
}

TEST_CASE("a flow with a changed bit is refused or as before", "[formats][seal]") {
    refuse_all([](const auto& path) { write_flow(path, make_flow()); },
               [](const auto& path, const auto& again) { write_flow(again, read_flow(path)); });
}

TEST_CASE("a changed file without the attribute `sealed` is believed", "[formats][seal]") {
    const TempFolder folder;
    write_flow(folder / "flow.h5", make_flow());
    std::string bytes = read_bytes(folder / "flow.h5");
    const float old_value = 0.125f * 11.0f, value = 0.5f;  // the last potential, in place
    const auto at = bytes.rfind(std::string(reinterpret_cast<const char*>(&old_value), 4));
    bytes.replace(at, 4, std::string(reinterpret_cast<const char*>(&value), 4));
    write_bytes(folder / "flow.h5", bytes);
    CHECK_THAT(error_text([&] { read_flow(folder / "flow.h5"); }),
               Catch::Contains("flow.h5: is damaged, or was changed after iceflow wrote it") &&
                   Catch::Contains("or delete its attribute `sealed`"));
    bytes.replace(bytes.find(std::string("sealed\0", 7)), 6, "hidden");
    write_bytes(folder / "flow.h5", bytes);
    CHECK(read_flow(folder / "flow.h5").potential.back() == value);
}
