// SPDX-License-Identifier: GPL-3.0-or-later
// Case files with mistakes: the text of every complaint.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "common/base/error.hpp"
#include "common/toml/read_toml.hpp"
#include "solver/case/case_schema.hpp"
#include "solver/case/read_case.hpp"
#include "tests/solver/case_support.hpp"

using namespace ice;
using namespace ice::test;

TEST_CASE("mistakes are named with line, column and remedy", "[case][errors]") {
    CHECK(contains(complaint(with("duration", "duratoin")),
                   ":3:1: error: unknown key 'simulation.duratoin'; did you mean "
                   "'simulation.duration'?"));
    CHECK(contains(complaint(with("\"5 ms\"", "\"5 kg\"")), "use s, ms, min, h"));
    CHECK(contains(complaint(with("30.0", "-1.0")), "simulation.duration = -1 is outside"));
    CHECK(contains(complaint(with("30.0", "nan")), "simulation.duration = nan is outside"));
    CHECK(contains(complaint(with("\"always\"", "\"forever\"")),
                   "never|until-hull-contact|until-contact|until-bent|always"));
    CHECK(contains(complaint(with("[20, 9]", "[20]")), "must be a list of 2 numbers"));
    CHECK(contains(complaint(with("[20, 9]", "[2.5, 9]")), "holds whole numbers"));
    CHECK(contains(complaint(with("speed = \"2 kn\"", "")), "'hull.speed' (or hull.speed_table)"));
    CHECK(contains(complaint(with("duration = 30.0", "")),
                   "required key 'simulation.duration' is missing"));
    CHECK(contains(complaint(with("hull.spheres.h5", "hulk.spheres.h5")), "make it with spherize"));
    CHECK(contains(complaint(with("[[floes]]", "[floes]")), "floes"));
    CHECK(contains(complaint(with("duration = 30.0", "duration = ")), ":3:"));
    CHECK(contains(complaint(with("time_step = \"5 ms\"", "time_step = 0.01\ntime_step = 0.02")),
                   ":5:"));
    CHECK(contains(complaint(kGood, {"ice.densty=900"}), "did you mean 'ice.density'?"));
    CHECK(contains(complaint(kGood, {"nonsense"}), "write it as key=value"));
    CHECK(contains(complaint(kGood, {"floes.pattern=file"}), "takes its shapes from the field"));
    CHECK(contains(complaint(kGood, {"floes.pattern=single"}), "position is missing"));
    CHECK(contains(complaint(kGood, {"output.average_from=99"}), "not before the end"));
    CHECK(contains(complaint(kGood, {"output.track=[2,2]"}), "names floe 2 twice"));
    CHECK(contains(complaint(kGood, {"floes.2.gap=[0,0]"}), "there is no floes.2"));
    CHECK(contains(complaint(kGood, {"floes.0.gap=[0,0]"}), "there is no floes.0"));
    CHECK(contains(complaint(kGood, {"simulation.time_step=1e-6", "simulation.duration=1e6"}),
                   "more than 1e+08 steps"));
    CHECK(contains(complaint(with("spheres = \"floe.spheres.h5\"", "")),
                   "'floes.1.spheres' is missing"));
    CHECK(contains(complaint(with("floe.spheres.h5", "flow.spheres.h5")), ":9:1: error:"));
    const std::vector<std::string> single{"floes.pattern=single", "floes.position=[0,0]",
                                          "floes.velocity=[1,0,0]"};
    CHECK(contains(complaint(kGood, single), "a held floe does not move"));
    for (const char* out : {"floes.position=[0,3,0]", "floes.orientation=[1,0.1,0,0]",
                            "floes.count=[5,3]", "floes.velocity=[0,1,0]"})
        CHECK(contains(
            complaint(kGood, {"simulation.dimension=2", "floes.hold=never", "floes.pattern=single",
                              "floes.position=[0,0,0]", "floes.count=[5,1]", out}),
            " 2D case"));
}

TEST_CASE("a mistake in an override is named with the option that it is in", "[case][errors]") {
    CHECK(contains(complaint(kGood, {"hull.speed=1", "hull.sped=2"}),
                   "--set hull.sped=2: error: unknown key 'hull.sped'"));
    // also where it shows only against other keys, in one group of floes or in all
    const std::string rigid = "contact.crushing_pressure=inf";
    for (const std::string hold : {"floes.hold=until-bent", "floes.1.hold=until-bent"})
        CHECK(contains(complaint(kGood, {rigid, hold}),
                       "--set " + hold +
                           ": error: floes.1.hold = \"until-bent\" needs a finite "
                           "contact.crushing_pressure: the force of the ship on rigid ice that is "
                           "held has no value; 1 MPa is the default in 3D"));
    // of a long one the beginning
    const std::string text = complaint(kGood, {"output.track=[" + std::string(200, ' ') + "1.5]"});
    CHECK(contains(text, "--set output.track=[" + std::string(46, ' ') + "...: error: "));
    // what icefield makes, and a slip
    CHECK(contains(complaint(kGood, {"floes.pattern=voronoi"}),
                   "is none of grid|brick|single|file; icefield makes others: pattern = \"file\""));
    CHECK(contains(complaint(kGood, {"floes.pattern=bricks"}),
                   "is none of grid|brick|single|file; did you mean \"brick\"?"));
}

TEST_CASE("all mistakes come in one go", "[case][errors]") {
    const std::string text =
        complaint(with("duration = 30.0", "duration = -1.0\nspeeed = 3\n") + "foo = 1\n");
    CHECK(contains(text, "3 mistakes"));
}

TEST_CASE("a missing case file is named", "[case][errors]") {
    CHECK_THROWS_WITH(read_case("/nonexistent/case.cfg"), Catch::Contains("not found"));
}

TEST_CASE("every number of a case refuses NaN and, but for the crushing pressure, infinity",
          "[case][errors]") {
    int tried = 0;
    for (const Key& key : case_schema().keys) {
        for (const std::string number : {"nan", "+inf", "-inf"}) {
            std::string value;
            if (key.kind == Kind::number || key.kind == Kind::integer)
                value = number;
            else if (key.kind == Kind::vector || key.kind == Kind::place)
                for (std::size_t k = 0; k < key.length; ++k)
                    value += (k == 0 ? "[" : ", ") + number + (k + 1 == key.length ? "]" : "");
            else if (key.kind == Kind::integer_list || key.kind == Kind::counts)
                value = "[" + number + ", " + number + "]";
            else if (key.kind == Kind::pair_list)
                value = "[[0.0, " + number + "]]";
            else
                continue;
            if (key.path == "contact.crushing_pressure" && number == "+inf") continue;
            CAPTURE(key.path, value);
            ++tried;
            Mistakes mistakes;
            const Values values =
                read_override(std::string(key.path) + "=" + value, case_schema(), 1, mistakes);
            CHECK(values.empty());
            REQUIRE_FALSE(mistakes.texts.empty());
            CHECK_THAT(mistakes.texts[0], Catch::Contains(std::string(key.path)));
        }
    }
    CHECK(tried > 80);
}

TEST_CASE("without floes level ice needs a thickness above 0", "[case][errors]") {
    const std::string head =
        "[simulation]\nduration = 30.0\ntime_step = 0.01\n[hull]\nspheres = "
        "\"hull.spheres.h5\"\nspeed = 1\n";
    CHECK(contains(complaint(head), "no [[floes]] table and no [level_ice]"));
    for (const auto& [lines, words] :
         {std::pair("thickness = 0\n", ":8:1: error: level_ice.thickness = 0: a case with"),
          std::pair("thickness = -0.8\n", "level_ice.thickness = -0.8 is outside"),
          std::pair("extent = [1, 2, 3, 4]\n", "'level_ice.thickness' is missing")}) {
        const std::string text = complaint(head + "[level_ice]\n" + lines);
        CAPTURE(text);
        CHECK(contains(text, words));
        CHECK_FALSE(contains(text, "no [level_ice]"));
    }
    // beside floes 0 is no sheet
    CHECK(complaint(kGood + "[level_ice]\nthickness = 0\n").empty());
}

TEST_CASE("keys of level ice and bending that nothing takes are named",
          "[case][errors][level_ice]") {
    const std::string sheet =
        with("[contact]", "[level_ice]\nthickness = 0.4\nextent = [0, 9, -5, 5]\n[contact]");
    REQUIRE(complaint(sheet).empty());
    CHECK(contains(complaint(kGood, {"level_ice.gap=0.2"}),
                   "--set level_ice.gap=0.2: error: level_ice.gap is given, but there is no sheet: "
                   "give level_ice.thickness, or leave [level_ice] out"));
    CHECK(complaint(sheet, {"level_ice.thickness=0", "level_ice.gap=0.2"}).empty());
    CHECK(contains(complaint(sheet, {"bending.model=kashtelyan", "bending.load_length=0.5"}),
                   "bending.load_length is given, but only bending.model = \"wedge\" takes it"));
    CHECK(complaint(sheet, {"bending.load_length=0.5", "bending.opening_angle=1"}).empty());
    const std::vector<std::string> flat{"simulation.dimension=2", "floes.count=[5,1]",
                                        "contact.crushing_pressure=1e6"};
    REQUIRE(complaint(sheet, flat).empty());
    for (const char* key : {"bending.load_length", "bending.opening_angle"}) {
        std::vector<std::string> overrides = flat;
        overrides.push_back(std::string(key) + "=0.5");
        CHECK(contains(complaint(sheet, overrides), std::string(key) + " is given, but in 2D "));
    }
    CHECK(contains(complaint(sheet, {"bending.factor=0"}), "bending.factor = 0: ice without"));
    CHECK(contains(complaint(sheet, {"level_ice.spacing=0.61"}),
                   "level_ice.spacing = 0.61 m is more than 1.5 thicknesses of the ice"));
    CHECK(contains(complaint(sheet, {"level_ice.scatter=20"}), "20 % is 0.2, or \"20 %\""));
}

TEST_CASE("water lighter than ice is named by the key that is wrong", "[case][errors][level_ice]") {
    const std::string sheet =
        with("[contact]", "[level_ice]\nthickness = 0.4\nextent = [0, 9, -5, 5]\n[contact]");
    CHECK(contains(complaint(sheet, {"environment.water_density=1.025"}),
                   "--set environment.water_density=1.025: error: ice.density = 900 kg/m3 is not "
                   "below environment.water_density = 1.025 kg/m3: the sheet has no floating "
                   "equilibrium; if 1.025 t/m3 is meant, write \"1.025 t/m3\""));
    CHECK(contains(complaint(sheet, {"ice.density=1100"}),
                   "--set ice.density=1100: error: ice.density = 1100 kg/m3 is not below"));
}

TEST_CASE("a table of speeds has one complaint a row, in its own words", "[case][errors]") {
    const auto of = [](const std::string& rows) {
        return complaint(kGood, {"bending.factor_table=" + rows});
    };
    CHECK(contains(of("[[0,1],[0,2]]"),
                   "bending.factor_table row 2 must be [speed, value] with "
                   "the speed above the row before"));
    const std::string text = of("[[0,-1],[1,-5]]");
    CHECK(contains(text, "bending.factor_table = -1 is outside [0, 100]"));
    CHECK_FALSE(contains(text, "above the row before"));
}

TEST_CASE("of a file full of mistakes the first twenty are shown, the others counted",
          "[case][errors]") {
    std::string text;
    for (int k = 0; k < 50; ++k) text += "wrong_" + std::to_string(k) + " = 1\n";
    const CaseFolder folder(text + kGood);
    try {
        read_case(folder.file());
        FAIL("accepted");
    } catch (const Error& error) {
        const std::string what = error.what();
        CHECK_THAT(what, Catch::Contains("50 mistakes") && Catch::Contains("and 30 more"));
        std::size_t shown = 0;
        for (std::size_t at = 0; (at = what.find("unknown key", at)) != std::string::npos; ++at)
            ++shown;
        CHECK(shown == 20);
    }
}

TEST_CASE("of a long line a message shows what is around the mistake", "[case][errors]") {
    const CaseFolder folder(kGood + "[drag]\n" + std::string(5000, ' ') + "coefficient = 700 # " +
                            std::string(5000, 'x') + "\n");
    try {
        read_case(folder.file());
        FAIL("accepted");
    } catch (const Error& error) {
        const std::string what = error.what();
        CHECK(what.size() < 800);
        const auto value = what.find("700 # xxx"), caret = what.find('^');
        REQUIRE(value != std::string::npos);
        // the caret stands under the value
        CHECK(caret - what.rfind('\n', caret) == value - what.rfind('\n', value));
    }
}
