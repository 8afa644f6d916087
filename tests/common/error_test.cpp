// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/base/error.hpp"

#include <catch2/catch.hpp>

using namespace ice;

TEST_CASE("an error reads 'where: what happened', then the remedy on a second line", "[base]") {
    const Error error = bad_input("hull.obj:12", "has 3 open edges", "close them");
    CHECK(std::string(error.what()) == "hull.obj:12: has 3 open edges\n  close them");
    CHECK(error.code() == ExitCode::bad_input);
}

TEST_CASE("an error without place or remedy leaves no colon and no empty line", "[base]") {
    CHECK(std::string(run_failed("", "diverged", "").what()) == "diverged");
    CHECK(run_failed("", "diverged", "").code() == ExitCode::failed);
}

TEST_CASE("the exit codes are 0, 1, 2 and 130", "[base]") {
    CHECK(static_cast<int>(ExitCode::ok) == 0);
    CHECK(static_cast<int>(ExitCode::failed) == 1);
    CHECK(static_cast<int>(ExitCode::bad_input) == 2);
    CHECK(static_cast<int>(ExitCode::interrupted) == 130);
}
