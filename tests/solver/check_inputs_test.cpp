// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that no ice has: which warn, of what unit, and by how much the mean depends on them.
#include "solver/run/check_inputs.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

// Ice that bends and is crushed, with the defaults of a case file.
Case usual_ice() {
    Case p;
    p.contact.crushing_pressure = kCrushingPressure;
    p.floes.resize(1);
    p.floes[0].hold = Hold::until_bent;
    return p;
}

Warning only_warning(const Case& p) {
    const auto warnings = check_inputs(p);
    REQUIRE(warnings.size() == 1);
    return warnings[0];
}

std::string text_of_pressure(double pressure) {
    Case p = usual_ice();
    p.contact.crushing_pressure = pressure;
    return only_warning(p).text;
}

}  // namespace

TEST_CASE("usual ice, model ice and rigid ice give no warning of inputs", "[step]") {
    CHECK(check_inputs(usual_ice()).empty());
    Case model = usual_ice();
    model.ice_density = GENERATE(850.0, 880.0, 940.0);
    model.bending.flexural_strength = GENERATE(2e4, 6e4);
    model.bending.elastic_modulus = GENERATE(1e7, 2e8);
    model.contact.crushing_pressure = GENERATE(4e4, std::numeric_limits<double>::infinity());
    CHECK(check_inputs(model).empty());
}

TEST_CASE("a number in a wrong unit gets a warning with the unit that may be meant", "[step]") {
    Case p = usual_ice();
    p.ice_density = 0.9;
    CHECK(only_warning(p).text ==
          "ice.density = 0.9 kg/m3 is outside 850 to 940 kg/m3; 900 is common: if 0.9 t/m3 is "
          "meant, write \"0.9 t/m3\"");
    CHECK(text_of_pressure(1.0) ==
          "contact.crushing_pressure = 1 Pa is outside 10 kPa to 100 MPa; 0.5 to 3 MPa are "
          "common: if 1 MPa is meant, write \"1 MPa\"");
    CHECK_THAT(text_of_pressure(500.0), Catch::EndsWith("write \"500 kPa\""));
    CHECK_THAT(text_of_pressure(2e9), Catch::EndsWith("if 2 MPa is meant, write \"2 MPa\""));
    // both units are in the range: the one nearer to common values
    CHECK_THAT(text_of_pressure(20.0), Catch::EndsWith("write \"20 MPa\""));
    // no unit brings it there
    CHECK_THAT(text_of_pressure(0.0), Catch::EndsWith("check the number and its unit"));

    p = usual_ice();
    p.bending.flexural_strength = 5e8;
    CHECK_THAT(only_warning(p).text,
               Catch::StartsWith("bending.flexural_strength = 5e+08 Pa is outside 10 kPa to 10 "
                                 "MPa; ") &&
                   Catch::EndsWith("write \"500 kPa\""));
    p = usual_ice();
    p.bending.elastic_modulus = 5.0;
    CHECK_THAT(only_warning(p).text,
               Catch::StartsWith("bending.elastic_modulus = 5 Pa is outside 0.5 to 12 GPa; ") &&
                   Catch::EndsWith("write \"5 GPa\""));
    // a model basin's modulus is wrong in ice that is as strong as in nature
    p.bending.elastic_modulus = 5e6;
    CHECK_THAT(only_warning(p).text,
               Catch::StartsWith("bending.elastic_modulus = 5e+06 Pa is outside 0.5 to 12 GPa; ") &&
                   Catch::EndsWith("if 5 GPa is meant, write \"5 GPa\""));
    p.bending.flexural_strength = 4e4;
    CHECK(check_inputs(p).empty());
}

TEST_CASE("the strength of ice that does not bend is not looked at", "[step]") {
    Case p = usual_ice();
    p.bending.flexural_strength = 1.0;
    p.bending.elastic_modulus = 1.0;
    CHECK(check_inputs(p).size() == 2);
    p.floes[0].hold = Hold::never;
    CHECK(check_inputs(p).empty());
    p.level_ice.thickness = 0.5;
    CHECK(check_inputs(p).size() == 2);
}

TEST_CASE("the mean depends on an unusual input by as much as that is outside", "[step]") {
    Case p = usual_ice();
    // the weight in water of 1000 kg/m3: 200 against 150 kg/m3 at the range's end, 59 against 60
    p.ice_density = 800.0;
    CHECK(only_warning(p).share.value() == Near(1.0 / 3.0));
    CHECK(only_warning(p).affects_mean == true);
    p.ice_density = 941.0;
    CHECK(only_warning(p).share.value() == Near(1.0 / 60.0));
    CHECK(only_warning(p).affects_mean == false);
    p.ice_density = 0.9;
    CHECK(only_warning(p).share == 1.0);
    p.water_density = 930.0;  // in which the range's ice would sink
    p.ice_density = 945.0;
    CHECK(only_warning(p).share == 1.0);

    p = usual_ice();
    p.contact.crushing_pressure = 8e3;
    CHECK(only_warning(p).share.value() == Near(0.25));
    p.contact.crushing_pressure = 1.5e8;
    CHECK(only_warning(p).share.value() == Near(0.5));
    for (const double pressure : {0.0, 1.0}) {
        p.contact.crushing_pressure = pressure;
        CHECK(only_warning(p).share == 1.0);
        CHECK_THAT(with_verdict(only_warning(p)), Catch::EndsWith(" (the mean cannot be trusted)"));
    }
}
