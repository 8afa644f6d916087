// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/toml/recognise_input.hpp"

#include <catch2/catch.hpp>

using namespace ice;

TEST_CASE("a mesh, an HDF5 file and UTF-16 are recognised, TOML is not", "[toml]") {
    CHECK(recognise_file("ship.STL", "solid x")->what == "a mesh");
    CHECK_THAT(recognise_file("dir/ship.obj", "v 0 0 0")->remedy,
               Catch::Contains("spherize dir/ship.obj"));
    const std::string hdf5 = "\x89HDF\r\n\x1a\n";
    CHECK(recognise_file("a.h5", hdf5 + "..icesolve-spheres..")->what ==
          "a sphere set, made by spherize");
    CHECK(recognise_file("a.h5", hdf5 + "..icesolve-field..")->what ==
          "an ice field, made by icefield");
    CHECK(recognise_file("a.cfg", hdf5)->what == "an HDF5 file");
    CHECK(recognise_file("a.cfg", "\xFF\xFEt")->what == "text in UTF-16");
    CHECK_FALSE(recognise_file("a.cfg", "title = \"x\""));
    CHECK_FALSE(recognise_file("a.cfg", ""));
    CHECK(recognise_format("ice.h5", "icesolve-field")->what == "an ice field, made by icefield");
    CHECK(recognise_format("ice.h5", "icesolve-field")->remedy ==
          "a case names it: [[floes]], pattern = \"file\", file = \"ice.h5\"");
    for (const char* other : {"", "icesolve", "somebody's"})
        CHECK_FALSE(recognise_format("ice.h5", other));
}

TEST_CASE("a TOML file of another kind is recognised by the tables that only it has", "[toml]") {
    const std::vector<std::string> case_names{"title", "simulation", "hull", "floes"};
    const std::vector<std::string> field_names{"title", "pattern", "ice", "floes"};
    CHECK_FALSE(recognise_tables("f", case_names, "icesolve case"));
    CHECK_FALSE(recognise_tables("f", field_names, "icefield specification"));
    CHECK(recognise_tables("f", case_names, "icefield specification")->remedy ==
          "icesolve f runs it");
    CHECK_THAT(recognise_tables("f", field_names, "icesolve case")->what,
               Catch::Contains("specification of an ice field"));
    CHECK_THAT(recognise_tables("f", {"expect"}, "icesolve case")->what,
               Catch::Contains("expected numbers"));
    // what both may have, and what nobody knows, says nothing
    CHECK_FALSE(recognise_tables("f", {"title", "ice", "floes"}, "icesolve case"));
    CHECK_FALSE(recognise_tables("f", {}, "icesolve case"));
}
