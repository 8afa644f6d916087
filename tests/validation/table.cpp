// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/validation/table.hpp"

#include <fmt/format.h>

#define CATCH_CONFIG_EXTERNAL_INTERFACES  // listeners
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <vector>

#include "tests/support/tolerance.hpp"

namespace ice::test {

namespace {

struct Row {
    Comparison worst;
    double out = 0.0;  // |got - expected| / tolerance
    int count = 0;
    bool bounded = true;
};

// In the order in which the tests ask; the program runs its test cases one after another.
std::vector<Row>& rows() {
    static std::vector<Row> all;
    return all;
}

// How far out a value is, in units of what is allowed: 1 is at the bound.
double share_of_tolerance(const Comparison& c) {
    if (c.tolerance.kind == Tolerance::upper) return c.got <= 0.0 ? 0.0 : c.got / c.expected;
    const double off = std::abs(c.got - c.expected);
    const double allowed =
        c.tolerance.value * (c.tolerance.kind == Tolerance::relative ? std::abs(c.expected) : 1.0);
    return off == 0.0 ? 0.0 : off / allowed;
}

void add(const Comparison& c, double out, bool bounded) {
    for (Row& row : rows()) {
        if (row.worst.name != c.name) continue;
        ++row.count;
        if (out > row.out || std::isnan(out)) row.worst = c, row.out = out;
        return;
    }
    rows().push_back({c, out, 1, bounded});
}

std::string quantity(double value, const std::string& unit) {
    return fmt::format("{:.5g}{}{}", value, unit.empty() ? "" : " ", unit);
}

std::string tolerance_text(const Comparison& c) {
    if (c.tolerance.kind == Tolerance::upper) return "bound";
    if (c.tolerance.kind == Tolerance::absolute) return quantity(c.tolerance.value, c.unit);
    return fmt::format("{:g} %", 100.0 * c.tolerance.value);
}

std::string markdown() {
    std::string text =
        "| case | expected | got | within | why this is the answer |\n|---|---|---|---|---|\n";
    for (const auto& [c, out, count, bounded] : rows()) {
        const std::string name =
            count > 1 ? fmt::format("{} (worst of {})", c.name, count) : c.name;
        const std::string bound = bounded ? tolerance_text(c) : "shown only";
        const bool upper = c.tolerance.kind == Tolerance::upper;
        text += fmt::format("| {} | {} | {} | {} | {} |\n", name,
                            (upper ? "at most " : "") + quantity(c.expected, c.unit),
                            quantity(c.got, c.unit), bound, c.why);
    }
    return text;
}

struct TableWriter : Catch::TestEventListenerBase {
    using TestEventListenerBase::TestEventListenerBase;
    void testRunEnded(const Catch::TestRunStats&) override {
        if (const char* path = std::getenv("ICE_VALIDATION_TABLE"))
            std::ofstream(path) << markdown();
    }
};
CATCH_REGISTER_LISTENER(TableWriter)

}  // namespace

void validate(const Comparison& row) {
    const double out = share_of_tolerance(row);
    add(row, out, true);
    CAPTURE(row.name, row.expected, row.got, row.unit);
    CHECK(out <= tolerance_scale());
}

void show(const Comparison& row) { add(row, std::abs(row.got - row.expected), false); }

}  // namespace ice::test
