// SPDX-License-Identifier: GPL-3.0-or-later
// What the programs make of the words of a command line (common/cli).
//
// Tolerances: 1e-15 is rounding of one product.
#include <catch2/catch.hpp>
#include <string>

#include "common/cli/console.hpp"
#include "common/cli/output_files.hpp"
#include "common/cli/quantity_option.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// What an option's transform() leaves of the word, in SI.
double si(const CLI::Validator& option, std::string word) {
    REQUIRE(option(word) == "");
    return std::stod(word);
}

}  // namespace

TEST_CASE("an option with a unit is a number in SI", "[console][analytic]") {
    const CLI::Validator length = positive_quantity(Dimension::length, "2.5");
    CHECK(si(length, "2.5") == 2.5);
    CHECK(si(length, "10 cm") == Near(0.1).epsilon(1e-15));
    CHECK(si(positive_quantity(Dimension::time, "5 min"), "5min") == 300.0);
    CHECK(si(positive_quantity(Dimension::speed, "2 kn"), "3.6 km/h") == Near(1.0).epsilon(1e-15));
    CHECK(si(finite_quantity(Dimension::length, "0"), "-2 km") == -2000.0);
    CHECK(si(finite_quantity(Dimension::length, "0"), "0") == 0.0);
}

TEST_CASE("an option with a unit refuses what is no such number, and says what is",
          "[console][errors]") {
    const CLI::Validator length = positive_quantity(Dimension::length, "2.5");
    for (const char* bad : {"", "0", "-1 m", "nan", "inf", "5 kg", "5 min", "2.5x"}) {
        std::string word = bad;
        CAPTURE(bad);
        CHECK_THAT(length(word), Catch::Contains("is not a positive number in m (2.5"));
        CHECK(word == bad);
    }
    std::string endless = "inf";
    CHECK_THAT(finite_quantity(Dimension::length, "0")(endless),
               Catch::Contains("is not a number in m"));
}

TEST_CASE("a command line is quoted so that a shell reads the same words", "[console][analytic]") {
    CHECK(shell_word("a-b_1.cfg") == "a-b_1.cfg");
    CHECK(shell_word("") == "''");
    CHECK(shell_word("my ship") == "'my ship'");
    CHECK(shell_word("it's") == "'it'\\''s'");
    const char* const words[] = {"/usr/bin/icesolve", "my case.cfg", "--set", "hull.speed=2"};
    CHECK(command_line(4, words) == "icesolve 'my case.cfg' --set hull.speed=2");
}

TEST_CASE("no output replaces the input or another output, whatever its path is called",
          "[console][errors]") {
    const TempFolder folder;
    write_bytes(folder / "hull.obj", "");
    OutputFiles files;
    files.protect(folder / "hull.obj", "the mesh");
    files.add("--report", "");  // none
    files.add("--output", folder / "out.h5");
    CHECK_THAT(error_text([&] { files.add("--json", folder.path() / "." / "out.h5"); }),
               Catch::Contains("--json") && Catch::Contains("would overwrite --output"));
    CHECK_THAT(error_text([&] { files.add("--json", folder / "hull.obj"); }),
               Catch::Contains("would overwrite the mesh"));
    CHECK_THAT(error_text([&] { files.add("--json", folder.path() / "none" / "a.json"); }),
               Catch::Contains("no folder"));
    files.add("--json", folder / "a.json");
}
