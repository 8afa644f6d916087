// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/toml/quote_line.hpp"

#include <catch2/catch.hpp>

using namespace ice;

TEST_CASE("a line is quoted with its number and carets under the mistake", "[toml]") {
    CHECK(quote_line("speed = 0,3", 12, 9, 1) == "\n   12 | speed = 0,3\n      |          ^");
    CHECK(quote_line("sped = 1\r", 1, 0, 4) == "\n    1 | sped = 1\n      | ^^^^");
    CHECK(quote_line("", 1, 0, 0) == "\n    1 | \n      | ^");
}

TEST_CASE("bytes that no terminal should get are replaced one by one", "[toml]") {
    const auto joined = [](std::string_view text) {
        std::string all;
        for (const std::string& character : printable_characters(text)) all += character;
        return all;
    };
    CHECK(joined("K\xC3\xBCste \xE2\x82\xAC") == "K\xC3\xBCste \xE2\x82\xAC");
    CHECK(printable_characters("K\xC3\xBCste").size() == 5);
    CHECK(joined("a\tb") == "a b");
    const std::string_view strange[] = {"\xFC",
                                        "\xC3",
                                        "\x1B",
                                        "\x7F",
                                        "\xC2\x9B",
                                        "\xC0\xAF",
                                        "\xF5\x80\x80",
                                        "\x80",
                                        "\xF5\x80\x80\x80",
                                        "\x80\x80\x80\x80"};
    for (const std::string_view bytes : strange) {
        const std::string shown = joined(bytes);
        CAPTURE(bytes.size(), shown);
        // U+FFFD for each byte of what is no character; U+009B is one of two bytes
        CHECK(shown.substr(0, 3) == "\xEF\xBF\xBD");
        CHECK(shown.size() == 3 * bytes.size());
    }
}

TEST_CASE("of a long line the characters around the mistake are shown, the caret under them",
          "[toml]") {
    std::string line;
    for (int k = 0; k < 1000; ++k) line += "\xC3\xA4";  // two bytes each
    line += "x = 1" + std::string(1000, ' ');
    const std::string shown = quote_line(line, 1, 1000, 1);
    CHECK(shown.size() < 500);
    const auto columns = [&](std::size_t from, std::size_t to) {
        return printable_characters(std::string_view(shown).substr(from, to - from)).size();
    };
    const auto line_start = shown.find('|') + 1, caret_start = shown.rfind('|') + 1;
    CHECK(columns(line_start, shown.find('x')) == columns(caret_start, shown.find('^')));
}

TEST_CASE("what TOML does not read is explained where the meaning is plain", "[toml]") {
    CHECK(explain_value("speed = 0,3") == "; the decimal point is '.', not ','");
    CHECK(explain_value("speed = -1,5 m/s # slow") == "; the decimal point is '.', not ','");
    CHECK(explain_value("speed = 2 kn") == "; write a number with a unit in quotes: \"2 kn\"");
    CHECK(explain_value("share = 80%") == "; write a number with a unit in quotes: \"80%\"");
    CHECK(explain_value("pattern = grid\r") == "; write a text in quotes: \"grid\"");
    for (const char* line : {"speed", "speed =", "speed = 1.2.3", "speed = 1, 2, 3", "x = [1,2",
                             "x = \"a", "# a = b", "speed = 2,", "speed = ,5"}) {
        CAPTURE(line);
        CHECK(explain_value(line).empty());
    }
}
