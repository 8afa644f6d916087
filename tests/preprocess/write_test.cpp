// SPDX-License-Identifier: GPL-3.0-or-later
// Exports for everyone: rows, CSV and VTP. Those for contact codes are in export_test.cpp.
#include <catch2/catch.hpp>
#include <cstring>

#include "preprocess/write/write_csv.hpp"
#include "preprocess/write/write_vtp.hpp"
#include "tests/support/make_sphere_sets.hpp"
#include "tests/support/write_text.hpp"

using namespace ice;
using test::text_of;

namespace {

// Value k of an appended array: 8 bytes of length follow the offset, then the values.
template <class T>
T value_at(const std::string& text, const std::string& name, std::size_t k) {
    const std::size_t line = text.find("Name=\"" + name + "\"");
    const std::size_t at = text.find("offset=\"", line) + 8;
    const std::size_t data = text.find("_", text.find("<AppendedData")) + 1;
    T value;
    std::memcpy(&value, text.data() + data + std::stoul(text.substr(at)) + 8 + k * sizeof value,
                sizeof value);
    return value;
}

SphereSet two_spheres() {
    SphereSet set;
    set.centers = {Vec3(1, 2, 3), Vec3(4, 5, 6)};
    set.radii = {0.25, 0.5};
    set.surface_count = 1;
    set.normals = {Vec3::UnitZ()};
    set.areas = {7};
    set.volumes = {8, 9};
    set.regions = {1};
    set.mesh.region_names = {"hull", "bow, \"port\""};
    return set;
}

}  // namespace

TEST_CASE("a vtp file holds every sphere's centre, radius and normal", "[write][analytic]") {
    const SphereSet set = two_spheres();
    const std::string text = text_of([&](const Sink& sink) { write_vtp(set, sink); });
    CHECK_THAT(text, Catch::Contains("NumberOfPoints=\"2\"") &&
                         Catch::Contains("encoding=\"raw\"") && Catch::EndsWith("</VTKFile>\n"));
    for (std::size_t k = 0; k < 6; ++k)
        CHECK(value_at<double>(text, "Points", k) == static_cast<double>(k + 1));
    CHECK(value_at<double>(text, "radius", 1) == 0.5);
    CHECK(value_at<float>(text, "normal", 2) == 1.0f);
    CHECK(value_at<float>(text, "normal", 5) == 0.0f);
    CHECK(value_at<double>(text, "area", 0) == 7.0);
    CHECK(value_at<double>(text, "volume", 1) == 9.0);
    CHECK(value_at<std::uint8_t>(text, "layer", 0) == 1);
    CHECK(value_at<std::int32_t>(text, "region", 0) == 1);
    CHECK(value_at<std::int64_t>(text, "connectivity", 1) == 1);
    CHECK(value_at<std::int64_t>(text, "offsets", 1) == 2);
}

TEST_CASE("the csv quotes a region name that holds commas and quotes", "[write]") {
    const SphereSet set = two_spheres();
    CHECK(text_of([&](const Sink& sink) { write_csv(set, sink); }) ==
          "x_m,y_m,z_m,radius_m,nx,ny,nz,layer,region\n"
          "1,2,3,0.25,0,0,1,1,\"bow, \"\"port\"\"\"\n"
          "4,5,6,0.5,0,0,0,0,hull\n");
}

TEST_CASE("rows are written in order and whole for any number of threads", "[write]") {
    // around a block of 16 384 rows, and beyond the 32 blocks that are filled at a time
    const std::size_t count = GENERATE(0u, 1u, 16383u, 16384u, 16385u, 600000u);
    std::string expected;
    for (std::size_t k = 0; k < count; ++k) expected += std::to_string(k) + "\n";
    const int before = thread_count();
    for (const int threads : {1, 2, 3}) {
        set_thread_count(threads);
        CHECK(text_of([&](const Sink& sink) {
                  write_rows(sink, count, [](fmt::memory_buffer& out, std::size_t k) {
                      fmt::format_to(std::back_inserter(out), "{}\n", k);
                  });
              }) == expected);
    }
    set_thread_count(before);
}
