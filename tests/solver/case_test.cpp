// SPDX-License-Identifier: GPL-3.0-or-later
// Case files: values, units, defaults and overrides.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/base/error.hpp"
#include "common/toml/read_toml.hpp"
#include "solver/case/case_schema.hpp"
#include "solver/case/read_case.hpp"
#include "tests/solver/case_support.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

TEST_CASE("a case reads with units, defaults and derived values", "[case]") {
    const CaseFolder folder(kGood);
    const Case c = read_case(folder.file());
    CHECK(c.time_step == Near(0.005));
    CHECK(c.ship_speed(3.0) == Near(2.0 * 1852.0 / 3600.0));
    CHECK(c.floes.size() == 1);
    CHECK(c.floes[0].count == std::array<int, 2>{20, 9});
    CHECK(c.floes[0].gap[0] == Near(0.02));
    CHECK(c.floes[0].hold == Hold::always);
    CHECK(c.contact.crushing_pressure == Near(1.5e6));
    CHECK(c.average_from == Near(10.0));  // a third of the duration
    CHECK(c.track == std::vector<int>{1, 2});
    CHECK(c.normal == NormalRule::surface);
    CHECK(c.buoyancy == BuoyancyModel::distributed);
    CHECK(c.floes[0].spheres.is_absolute());
}

TEST_CASE("spheres of level ice are as far apart as its thickness allows", "[case][level_ice]") {
    const std::string sheet = with("[contact]",
                                   "[level_ice]\nthickness = 0.4\nextent = [0, 9, -5, 5]\n"
                                   "scatter = \"20 %\"\n[contact]");
    const CaseFolder folder(sheet);
    const Case c = read_case(folder.file());
    CHECK(c.level_ice.spacing == Near(0.28));
    CHECK(c.level_ice.scatter == 0.2);
    CHECK(contains(c.resolved, "\nspacing = 0.28"));
    CHECK(read_case(folder.file(), {"level_ice.thickness=1"}).level_ice.spacing == Near(0.7));
    CHECK(read_case(folder.file(), {"level_ice.spacing=0.5"}).level_ice.spacing == 0.5);
    const CaseFolder again(c.resolved);
    CHECK(read_case(again.file()).resolved == c.resolved);
    // without a sheet there are no spheres of it
    CHECK(read_case(CaseFolder(kGood).file()).resolved.find("0.28") == std::string::npos);
}

TEST_CASE("the resolved case reads back as the same case", "[case][property]") {
    const CaseFolder folder(kGood);
    const Case first = read_case(folder.file(), {"contact.restitution=0.12345678901234567"});
    const CaseFolder again(first.resolved);
    const Case second = read_case(again.file());
    CHECK(second.resolved == first.resolved);
    CHECK(second.contact.restitution == 0.12345678901234567);
}

TEST_CASE("a title with control characters survives in the resolved case", "[case]") {
    const CaseFolder folder(with("\"test\"", R"("a\nb\t\"c\" \\ d")"));
    const Case first = read_case(folder.file());
    CHECK(first.title == "a\nb\t\"c\" \\ d");
    const CaseFolder again(first.resolved);
    CHECK(read_case(again.file()).title == first.title);
}

TEST_CASE("overrides are read as TOML, then as text with a unit", "[case]") {
    const CaseFolder folder(kGood);
    const Case c =
        read_case(folder.file(), {"ice.density=917 kg/m3", "hull.speed_table=[[0,1],[10,2]]",
                                  "floes.1.hold=never", "floes.gap=[0.1,0.2]"});
    CHECK(c.ice_density == 917.0);
    CHECK(c.ship_speed(5.0) == Near(1.5));
    CHECK(c.ship_speed(-1.0) == 1.0);
    CHECK(c.ship_speed(99.0) == 2.0);
    CHECK(c.floes[0].hold == Hold::never);
    CHECK(c.floes[0].gap[1] == 0.2);
}

TEST_CASE("the default case parses as TOML and every key explains itself", "[case]") {
    for (const Key& key : case_schema().keys)
        CHECK(contains(explain_key(case_schema(), std::string(key.path)), key.path.data()));
    CHECK_THROWS_WITH(explain_key(case_schema(), "contact.restitutoin"),
                      Catch::Contains("contact.restitution"));
    CHECK(contains(default_text(case_schema()), "restitution = 0.3"));
    // what is printed reads back without a mistake, once the required keys are filled in
    std::string text = default_text(case_schema());
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"# duration = ...", "duration = 1.0"},
             {"[hull]\n# spheres = ...", "[hull]\nspheres = \"hull.spheres.h5\""},
             {"# speed = ...", "speed = 1.0"},
             {"[[floes]]\n# spheres = ...", "[[floes]]\nspheres = \"floe.spheres.h5\""}}) {
        REQUIRE(text.find(from) != std::string::npos);
        text.replace(text.find(from), from.size(), to);
    }
    CHECK(complaint(text) == "");
    CHECK(contains(json_schema(case_schema()), "\"crushing_pressure\""));
}

TEST_CASE("pattern file takes a field, and its unbroken ice is a group of its own", "[case]") {
    const std::string field = "file = \"floe.spheres.h5\"\npattern = \"file\"";  // any file
    const CaseFolder folder(with("spheres = \"floe.spheres.h5\"", field));
    const Case c = read_case(folder.file(), {"floes.hold=never"});
    REQUIRE(c.floes.size() == 2);
    CHECK(c.floes[0].hold == Hold::never);
    CHECK_FALSE(c.floes[0].unbroken_part);
    CHECK(c.floes[1].hold == Hold::always);
    CHECK(c.floes[1].unbroken_part);
    CHECK(c.floes[1].file == c.floes[0].file);

    CHECK(contains(complaint(with("spheres = \"floe.spheres.h5\"", "pattern = \"file\"")),
                   "'floes.1.file' is missing"));
    CHECK(contains(
        complaint(with("spheres = \"floe.spheres.h5\"", field + "\nspheres = \"floe.spheres.h5\"")),
        "floes.1.spheres is given, but pattern \"file\" takes its shapes"));
    CHECK(contains(complaint(with("hold", "file = \"floe.spheres.h5\"\nhold")),
                   "floes.1.file is given, but pattern \"file\" alone takes it"));
    CHECK(contains(
        complaint(with("spheres = \"floe.spheres.h5\"", "file = \"lost.h5\"\npattern = \"file\"")),
        "make it with icefield"));
}

TEST_CASE("the ship's speed between, on and beyond the rows of its table", "[case][analytic]") {
    Case p;
    p.speed_table = {{1.0, 2.0}, {2.0, 4.0}, {4.0, 0.0}};
    CHECK(p.ship_speed(0.0) == 2.0);
    CHECK(p.ship_speed(1.0) == 2.0);
    CHECK(p.ship_speed(1.5) == 3.0);
    CHECK(p.ship_speed(2.0) == 4.0);
    CHECK(p.ship_speed(3.0) == 2.0);
    CHECK(p.ship_speed(4.0) == 0.0);
    CHECK(p.ship_speed(9.0) == 0.0);
}

TEST_CASE("a hull is placed by its draught or by z, and never by both", "[case][errors]") {
    const auto hull = [](const std::string& lines) {
        return with("speed = \"2 kn\"", "speed = 1\n" + lines);
    };
    const auto read = [&](const std::string& lines,
                          const std::vector<std::string>& overrides = {}) {
        const CaseFolder folder(hull(lines));
        return read_case(folder.file(), overrides);
    };
    const Case both = read("draught = \"80 cm\"\nposition = [-3, 1]");
    CHECK(both.hull_draught == 0.8);
    CHECK(both.hull_position.head<2>() == Eigen::Vector2d(-3, 1));
    CHECK(read("draught = 2").hull_position.head<2>() == Eigen::Vector2d::Zero());
    CHECK(std::isnan(read("position = [-3, 1, -0.5]").hull_draught));
    CHECK(read("").hull_position == Vec3::Zero());
    CHECK(contains(complaint(hull("draught = 2\nposition = [0, 0, -1]")),
                   "hull.draught and the z of hull.position both say how deep the hull lies"));
    CHECK(
        contains(complaint(hull("position = [0, 0]")), "hull.position has no z; add hull.draught"));
    CHECK(contains(complaint(hull("draught = -1")), "hull.draught"));

    // an override of one takes the place of the other
    CHECK(read("position = [-3, 1, -0.5]", {"hull.draught=2"}).hull_draught == 2.0);
    CHECK(read("draught = 2", {"hull.position=[0, 0, -3]"}).hull_position.z() == -3.0);
    // what is resolved is a case again
    const CaseFolder first(hull("draught = 2"));
    const CaseFolder again(read_case(first.file(), {}).resolved);
    CHECK(read_case(again.file(), {}).hull_draught == 2.0);
}

TEST_CASE("ice crushes at 1 MPa in 3D and is rigid in 2D unless a case says otherwise", "[case]") {
    const auto pressure = [](const std::string& line, int dimension) {
        std::string text = with("crushing_pressure = \"1.5 MPa\"\n", line);
        const std::string flat = "dimension = 2\ntime_step";
        if (dimension == 2) {
            text.replace(text.find("time_step"), 9, flat);
            text.replace(text.find("[20, 9]"), 7, "[20, 1]");
        }
        const CaseFolder folder(text);
        return read_case(folder.file(), {}).contact.crushing_pressure;
    };
    CHECK(pressure("", 3) == kCrushingPressure);
    CHECK(std::isinf(pressure("", 2)));
    CHECK(std::isinf(pressure("crushing_pressure = inf\n", 3)));
    CHECK(pressure("crushing_pressure = 2e5\n", 2) == 2e5);
    CHECK(contains(explain_key(case_schema(), "contact.crushing_pressure"), "default 1e6"));
}

TEST_CASE("floes of a field are free unless stated, those of a grid held until the ship comes",
          "[case]") {
    const auto hold = [](const std::string& pattern, const std::string& line) {
        std::string text = with("hold = \"always\"\n", line);
        if (pattern == "file")
            text.replace(text.find("spheres = \"floe"), 7, "pattern = \"file\"\nfile");
        const CaseFolder folder(text);
        return read_case(folder.file(), {}).floes[0].hold;
    };
    CHECK(hold("file", "") == Hold::never);
    CHECK(hold("grid", "") == Hold::until_hull_contact);
    CHECK(hold("file", "hold = \"until-contact\"\n") == Hold::until_contact);
    CHECK(hold("file", "hold = \"until-hull-contact\"\n") == Hold::until_hull_contact);
}

TEST_CASE("a free ship: lists of words, curves, numbers or a word, and what goes together",
          "[case][ship]") {
    const auto text = [](const std::string& lines) {
        return with("[contact]", lines + "\n[contact]");
    };
    const auto read = [&](const std::string& lines,
                          const std::vector<std::string>& overrides = {}) {
        const CaseFolder folder(text(lines));
        return read_case(folder.file(), overrides);
    };
    const std::string table =
        "[ship]\nfree = [\"surge\", \"heave\"]\nmass = \"28.8 t\"\n"
        "added_mass = [0.05, 0, 0.9, 0, 0, 0]\n"
        "[propulsion]\nthrust_table = [[0, \"20 kN\"], [\"10 kn\", 0]]";
    const Case p = read(table);
    CHECK(p.ship.free == std::array{true, false, true, false, false, false});
    CHECK(p.ship.mass == 28800.0);
    CHECK(p.ship.added_mass[heave] == 0.9);
    CHECK(p.propulsion.thrust_table.back() == std::pair(10.0 * kKnot, 0.0));
    CHECK_FALSE(read("").ship.any_free());
    CHECK(read("[ship]\nadded_mass = \"none\"").ship.added_mass[surge] == 0.0);
    CHECK_FALSE(read("[ship]\nadded_mass = \"none\"").ship.computes_added_mass);
    CHECK(read("[ship]\nadded_mass = \"computed\"").ship.computes_added_mass);
    // what is resolved is a case again, with the first one's files
    const CaseFolder first(text(table));
    const CaseFolder again(read_case(first.file(), {}).resolved);
    CHECK(read_case(again.file(), {}).propulsion.thrust_table == p.propulsion.thrust_table);
    // a thrust of another kind takes the place
    const Case held =
        read("[ship]\nfree = [\"surge\"]\n[propulsion]\nthrust = 1e3", {"propulsion.hold_speed=2"});
    CHECK(std::isnan(held.propulsion.thrust));
    CHECK(held.propulsion.hold_speed == 2.0);

    const auto wrong = [&](const std::string& lines, const std::string& what) {
        CAPTURE(lines);
        CHECK(contains(complaint(text(lines)), what));
    };
    const std::string surge_free = "[ship]\nfree = [\"surge\"]\n";
    wrong("[ship]\nfree = [\"surge\", \"hev\"]", "did you mean \"heave\"?");
    wrong("[ship]\nfree = [\"surge\", \"surge\"]", "names \"surge\" twice");
    wrong("[ship]\nfree = \"surge\"", "must be a list");
    wrong("[ship]\nadded_mass = [1, 2]", "none or computed, or a list of 6 numbers");
    wrong("[propulsion]\nthrust = 1e3", "a ship that is free in surge");
    wrong(surge_free + "[propulsion]\nthrust = 1e3\nhold_speed = 1", "keep one");
    wrong(surge_free + "[propulsion]\nbollard_pull = 1e3", "needs propulsion.open_water_speed");
    wrong(surge_free + "[propulsion]\npower = 1e3\nopen_water_speed = 5",
          "needs propulsion.propeller_diameter");
    wrong(surge_free +
              "[propulsion]\nbollard_pull = 1e3\nopen_water_speed = 5\n"
              "resistance_table = [[0, 0]]",
          "open-water resistance subtracted already");
    wrong(surge_free + "[propulsion]\nheading = \"hold\"", "free in yaw");
    wrong(surge_free + "[propulsion]\nthrust_table = [[1, 0], [1, 5]]", "above the row before");
    wrong("[tow]\nstiffness = 1e3", "free in surge");
    wrong("[mooring]\nstiffness = [0, 1e3, 0, 0, 0, 0]", "free in sway");
}
