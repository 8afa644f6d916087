// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/base/nearest_name.hpp"

#include <catch2/catch.hpp>

using namespace ice;

TEST_CASE("the nearest name differs by the fewest letters, the first of equals wins", "[base]") {
    const std::vector<std::string> names{"value", "abs", "why", "whe"};
    CHECK(nearest_name("vaule", names) == "value");
    CHECK(nearest_name("whz", names) == "why");
    CHECK(nearest_name("value", names) == "value");
}

TEST_CASE("a name that differs by half of its letters or more is none", "[base]") {
    const std::vector<std::string> names{"value", "abs", "hull.speed"};
    for (const char* wrong : {"", "zzzzz", "axy", "vxxxe", "simulation.duration"}) {
        CAPTURE(wrong);
        CHECK(nearest_name(wrong, names).empty());
    }
    CHECK(nearest_name("value", {}).empty());
}

TEST_CASE("a right name in the wrong table, or in none, is one change away", "[base]") {
    const std::vector<std::string> keys{"hull.position", "ice.density", "floes.gap", "hull.speed"};
    CHECK(nearest_name("contact.density", keys) == "ice.density");
    CHECK(nearest_name("density", keys) == "ice.density");
    CHECK(nearest_name("hull.sped", keys) == "hull.speed");
}
