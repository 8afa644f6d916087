// SPDX-License-Identifier: GPL-3.0-or-later
// Case files: values, units, overrides, and the text of every complaint.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/base/error.hpp"
#include "common/toml/read_toml.hpp"
#include "solver/case/case_schema.hpp"
#include "solver/case/read_case.hpp"

using namespace ice;

namespace {

const std::string kGood = R"(title = "test"
[simulation]
duration = 30.0
time_step = "5 ms"
[hull]
spheres = "hull.spheres.h5"
speed = "2 kn"
[[floes]]
spheres = "floe.spheres.h5"
count = [20, 9]
gap = ["20 mm", 0.02]
hold = "always"
[contact]
crushing_pressure = "1.5 MPa"
[output]
track = [1, 2]
)";

// A folder with a case file and the files it names.
class CaseFolder {
public:
    explicit CaseFolder(const std::string& text) {
        static int number = 0;
        folder_ =
            std::filesystem::temp_directory_path() /
            ("icesolve-case-test-" + std::to_string(::getpid()) + "-" + std::to_string(++number));
        std::filesystem::create_directories(folder_);
        std::ofstream(folder_ / "hull.spheres.h5") << "x";
        std::ofstream(folder_ / "floe.spheres.h5") << "x";
        std::ofstream(file()) << text;
    }
    ~CaseFolder() { std::filesystem::remove_all(folder_); }
    std::filesystem::path file() const { return folder_ / "case.cfg"; }

private:
    std::filesystem::path folder_;
};

std::string complaint(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const CaseFolder folder(text);
    try {
        read_case(folder.file(), overrides);
    } catch (const Error& error) {
        CHECK(error.code() == ExitCode::bad_input);
        return error.what();
    }
    return "";
}

std::string with(const std::string& from, const std::string& to) {
    std::string text = kGood;
    return text.replace(text.find(from), from.size(), to);
}

bool contains(const std::string& text, const std::string& part) {
    if (text.find(part) != std::string::npos) return true;
    UNSCOPED_INFO("not found: " << part << "\nin: " << text);
    return false;
}

}  // namespace

TEST_CASE("a case reads with units, defaults and derived values", "[case]") {
    const CaseFolder folder(kGood);
    const Case c = read_case(folder.file());
    CHECK(c.time_step == Approx(0.005));
    CHECK(c.ship_speed(3.0) == Approx(2.0 * 1852.0 / 3600.0));
    CHECK(c.floes.size() == 1);
    CHECK(c.floes[0].count == std::array<int, 2>{20, 9});
    CHECK(c.floes[0].gap[0] == Approx(0.02));
    CHECK(c.floes[0].hold == Hold::always);
    CHECK(c.contact.crushing_pressure == Approx(1.5e6));
    CHECK(c.average_from == Approx(10.0));  // a third of the duration
    CHECK(c.track == std::vector<int>{1, 2});
    CHECK(c.normal == NormalRule::surface);
    CHECK(c.buoyancy == BuoyancyModel::distributed);
    CHECK(c.floes[0].spheres.is_absolute());
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
    CHECK(c.ship_speed(5.0) == Approx(1.5));
    CHECK(c.ship_speed(-1.0) == 1.0);
    CHECK(c.ship_speed(99.0) == 2.0);
    CHECK(c.floes[0].hold == Hold::never);
    CHECK(c.floes[0].gap[1] == 0.2);
}

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

TEST_CASE("all mistakes come in one go", "[case][errors]") {
    const std::string text =
        complaint(with("duration = 30.0", "duration = -1.0\nspeeed = 3\n") + "foo = 1\n");
    CHECK(contains(text, "3 mistakes"));
}

TEST_CASE("a missing case file is named", "[case][errors]") {
    CHECK_THROWS_WITH(read_case("/nonexistent/case.cfg"), Catch::Contains("not found"));
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

TEST_CASE("the ship's speed between, on and beyond the rows of its table", "[case]") {
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

TEST_CASE("a ship that answers: lists of words, curves, numbers or a word, and what goes together",
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
          "less the open-water resistance already");
    wrong(surge_free + "[propulsion]\nheading = \"hold\"", "free in yaw");
    wrong(surge_free + "[propulsion]\nthrust_table = [[1, 0], [1, 5]]", "above the row before");
    wrong("[tow]\nstiffness = 1e3", "free in surge");
    wrong("[mooring]\nstiffness = [0, 1e3, 0, 0, 0, 0]", "free in sway");
}
