// SPDX-License-Identifier: GPL-3.0-or-later
// Tolerances: 1e-15 is rounding of one product.
#include "common/base/units.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <sstream>
#include <string>

#include "common/base/usual_range.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

double si(const char* text, Dimension dimension) {
    const auto quantity = parse_quantity(text, dimension);
    REQUIRE(quantity);
    return quantity->value;
}

}  // namespace

TEST_CASE("2 kn are 1.02888... m/s, 80 mm are 0.08 m, 1.5 MPa are 1.5e6 Pa", "[base][analytic]") {
    CHECK(si("2 kn", Dimension::speed) == Near(1.0288888888888889).epsilon(1e-15));
    CHECK(si("80 mm", Dimension::length) == Near(0.08).epsilon(1e-15));
    CHECK(si("1.5 MPa", Dimension::pressure) == Near(1.5e6).epsilon(1e-15));
    CHECK(si("28.8 t", Dimension::mass) == Near(28800.0).epsilon(1e-15));
    CHECK(si("1.2 MN", Dimension::force) == Near(1.2e6).epsilon(1e-15));
    CHECK(si("11.4 MW", Dimension::power) == Near(11.4e6).epsilon(1e-15));
    CHECK(si("180 deg", Dimension::angle) == Near(3.141592653589793).epsilon(1e-15));
    CHECK(si("3.6 km/h", Dimension::speed) == Near(1.0).epsilon(1e-15));
    CHECK(si("0.9 t/m3", Dimension::density) == Near(900.0).epsilon(1e-15));
}

TEST_CASE("every unit is its number of SI units, and none is without a value here",
          "[base][analytic]") {
    // by definition: 1 ft = 0.3048 m, 1 in = 0.0254 m, 1 kn = 1852 m / 3600 s, 180 deg = pi rad
    const double kPi = 3.14159265358979323846;
    const std::map<Dimension, std::map<std::string, double>> all{
        {Dimension::share, {{"%", 1e-2}}},
        {Dimension::length,
         {{"m", 1}, {"km", 1e3}, {"cm", 1e-2}, {"mm", 1e-3}, {"ft", 0.3048}, {"in", 0.0254}}},
        {Dimension::time, {{"s", 1}, {"ms", 1e-3}, {"min", 60}, {"h", 3600}}},
        {Dimension::speed, {{"m/s", 1}, {"km/h", 1000.0 / 3600}, {"kn", 1852.0 / 3600}}},
        {Dimension::angular_speed, {{"rad/s", 1}, {"deg/s", kPi / 180}}},
        {Dimension::acceleration, {{"m/s2", 1}}},
        {Dimension::pressure, {{"Pa", 1}, {"kPa", 1e3}, {"MPa", 1e6}, {"GPa", 1e9}}},
        {Dimension::density, {{"kg/m3", 1}, {"t/m3", 1e3}}},
        {Dimension::angle, {{"rad", 1}, {"deg", kPi / 180}}},
        {Dimension::mass, {{"kg", 1}, {"t", 1e3}}},
        {Dimension::force, {{"N", 1}, {"kN", 1e3}, {"MN", 1e6}}},
        {Dimension::power, {{"W", 1}, {"kW", 1e3}, {"MW", 1e6}}}};
    for (int k = 0; k <= static_cast<int>(Dimension::power); ++k) {
        const auto dimension = static_cast<Dimension>(k);
        const auto units = all.find(dimension);
        std::istringstream names(unit_names(dimension));
        std::size_t count = 0;
        for (std::string name; names >> name; ++count) {
            if (name.ends_with(',')) name.pop_back();
            CAPTURE(name);
            REQUIRE(units != all.end());
            REQUIRE(units->second.contains(name));
            CHECK(si(("2.5 " + name).c_str(), dimension) ==
                  Near(2.5 * units->second.at(name)).epsilon(1e-15));
        }
        CHECK(count == (units == all.end() ? 0 : units->second.size()));
    }
}

TEST_CASE("a bare number is SI and says that it had no unit", "[base]") {
    const auto quantity = parse_quantity(" +0.25 ", Dimension::length);
    REQUIRE(quantity);
    CHECK(quantity->value == 0.25);
    CHECK_FALSE(quantity->has_unit);
    CHECK(parse_quantity("0.25m", Dimension::length)->has_unit);
    CHECK(parse_quantity("-1e-3", Dimension::none)->value == -1e-3);
}

TEST_CASE("a unit of another dimension, an unknown one or text behind it is refused", "[base]") {
    const char* text = GENERATE("2 kg", "2 m/s", "2 mm x", "m", "", "  ", "2,5 m", "two m", "2 MM");
    CAPTURE(text);
    CHECK_FALSE(parse_quantity(text, Dimension::length));
}

TEST_CASE("a dimensionless number takes no unit", "[base]") {
    CHECK_FALSE(parse_quantity("0.3 m", Dimension::none));
    CHECK(unit_names(Dimension::none).empty());
    CHECK(si_unit(Dimension::none) == "1");
}

TEST_CASE("a share is a number or per cent", "[base][analytic]") {
    CHECK(si("80 %", Dimension::share) == Near(0.8).epsilon(1e-15));
    CHECK(si("80%", Dimension::share) == si("80 %", Dimension::share));
    CHECK(si("0.8", Dimension::share) == 0.8);
    CHECK_FALSE(parse_quantity("80 m", Dimension::share));
    CHECK_FALSE(parse_quantity("80 %", Dimension::none));
    CHECK(si_unit(Dimension::share) == "1");
    CHECK(unit_names(Dimension::share) == "%");
}

TEST_CASE("inf is read as infinity", "[base]") {
    CHECK(std::isinf(si("inf", Dimension::pressure)));
    CHECK(std::isinf(si("inf MPa", Dimension::pressure)));
}

TEST_CASE("messages can name the SI unit and all units of a dimension", "[base]") {
    CHECK(si_unit(Dimension::density) == "kg/m3");
    CHECK(unit_names(Dimension::length) == "m, km, cm, mm, ft, in");
}

TEST_CASE("a strength that no ice has is named, with the unit that may be meant", "[base]") {
    CHECK(outside_usual(kUsualStrength, "sigma", 4.5e5).empty());
    CHECK(outside_usual(kUsualStrength, "sigma", 2e4).empty());  // of a model basin
    CHECK(outside_usual(kUsualStrength, "sigma", 450.0) ==
          "sigma = 450 Pa is outside 10 kPa to 10 MPa; 0.2 to 1 MPa are common, 20 to 60 kPa in "
          "model basins: if 450 kPa is meant, write \"450 kPa\"");
    CHECK_THAT(outside_usual(kUsualStrength, "sigma", 5e8),
               Catch::Contains("if 500 kPa is meant, write \"500 kPa\""));
    CHECK_THAT(outside_usual(kUsualStrength, "sigma", 1e-6),
               Catch::EndsWith("check the number and its unit"));
}
