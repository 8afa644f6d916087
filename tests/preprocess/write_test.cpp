// SPDX-License-Identifier: GPL-3.0-or-later
// Exports of sphere sets.
#include <catch2/catch.hpp>
#include <cstring>

#include "preprocess/write/write_vtp.hpp"
#include "tests/support/make_sphere_sets.hpp"

using namespace ice;

namespace {

// The first number of an appended array: 8 bytes of length follow the offset, then the values.
template <class T>
T first_value(const std::string& text, const std::string& name) {
    const std::size_t line = text.find("Name=\"" + name + "\"");
    const std::size_t at = text.find("offset=\"", line) + 8;
    const std::size_t data = text.find("_", text.find("<AppendedData")) + 1;
    T value;
    std::memcpy(&value, text.data() + data + std::stoul(text.substr(at)) + 8, sizeof value);
    return value;
}

}  // namespace

TEST_CASE("a vtp file holds every sphere's centre, radius and normal", "[write]") {
    SphereSet set;
    set.centers = {Vec3(1, 2, 3), Vec3(4, 5, 6)};
    set.radii = {0.25, 0.5};
    set.normals = {Vec3::UnitZ(), Vec3::Zero()};
    set.areas = {7, 0};
    set.volumes = {8, 9};
    set.layers = {1, 0};
    set.regions = {3, 0};
    const std::string text = vtp_text(set);
    CHECK_THAT(text, Catch::Contains("NumberOfPoints=\"2\""));
    CHECK(first_value<double>(text, "Points") == 1.0);
    CHECK(first_value<double>(text, "radius") == 0.25);
    CHECK(first_value<double>(text, "normal") == 0.0);
    CHECK(first_value<double>(text, "volume") == 8.0);
    CHECK(first_value<std::uint8_t>(text, "layer") == 1);
    CHECK(first_value<std::int32_t>(text, "region") == 3);
    CHECK(first_value<std::int64_t>(text, "offsets") == 1);
    CHECK(text == vtp_text(set));
}
