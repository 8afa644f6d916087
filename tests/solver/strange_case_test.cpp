// SPDX-License-Identifier: GPL-3.0-or-later
// Case files that ask for more than to be read: stack, memory, a screen full of complaints.
#include <catch2/catch.hpp>

#include "solver/case/read_case.hpp"
#include "tests/common/fixtures.hpp"

using namespace ice;
using namespace ice::test;

namespace {

std::string refusal(const std::string& text) {
    const TempFolder folder;
    write_bytes(folder / "case.cfg", text);
    return error_text([&] { read_case(folder / "case.cfg"); });
}

std::string repeated(const std::string& text, int count) {
    std::string out;
    for (int k = 0; k < count; ++k) out += text;
    return out;
}

}  // namespace

TEST_CASE("keys nested 300 000 deep are refused: they exhaust the TOML library's stack",
          "[case][security]") {
    const std::string deep = repeated("a.", 300'000) + "a";
    for (const std::string& text : {deep + " = 1\n", "[" + deep + "]\n"})
        CHECK_THAT(refusal(text), Catch::Contains("case.cfg: crashes the library") ||
                                      Catch::Contains("unknown key"));
    CHECK_THAT(refusal("a = " + repeated("[", 100'000)), Catch::Contains("nested value depth"));
}

TEST_CASE("a case file of more than 64 MB is refused", "[case][security]") {
    CHECK_THAT(refusal(std::string((64u << 20) + 1, '#')),
               Catch::Contains("is too large for a case file (64 MB)"));
}

TEST_CASE("of many mistakes twenty are shown, of a long line 120 columns", "[case][security]") {
    std::string keys;
    for (int k = 0; k < 1000; ++k) keys += (k > 0 ? "," : "") + ("bad" + std::to_string(k)) + "=1";
    const std::string text = refusal("simulation = {" + keys + "}\n");
    CHECK_THAT(text, Catch::Contains("unknown key 'simulation.bad0'"));
    CHECK_THAT(text, Catch::Contains(" mistakes\n") && Catch::Contains("\nand 9"));
    CHECK(text.size() < 100'000);  // the line alone has 9000 characters
    std::size_t longest = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        longest = std::max(longest, end - at);
        at = end + 1;
    }
    CHECK(longest < 300);
}

TEST_CASE("more than 10 000 tables of floes are refused", "[case][security]") {
    CHECK_THAT(refusal(repeated("[[floes]]\n", 20'000)),
               Catch::Contains("more than 10000 [[floes]] tables"));
}
