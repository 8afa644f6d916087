// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/check/check_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/base/nearest_name.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::check {

namespace {

double allowed(const Expectation& e) { return std::max(e.abs, e.rel * std::abs(*e.value)); }

bool passes(const Expectation& e, double actual) {
    // A number that the run could not measure is null in summary.json. It meets no expectation, and
    // without this line no comparison with it would fail.
    if (std::isnan(actual)) return false;
    // the last bits of "value + tolerance" are not worth a failure
    const double slack = 1e-12 * std::abs(actual);
    if (e.value && !(std::abs(actual - *e.value) <= allowed(e) + slack)) return false;
    if (e.min && !(actual >= *e.min)) return false;
    if (e.max && !(actual <= *e.max)) return false;
    return true;
}

std::string describe(const Expectation& e) {
    if (e.value) return fmt::format("{:.6g} +- {:.3g}", *e.value, allowed(e));
    if (e.min && e.max) return fmt::format("{:.6g} .. {:.6g}", *e.min, *e.max);
    return e.min ? fmt::format(">= {:.6g}", *e.min) : fmt::format("<= {:.6g}", *e.max);
}

std::string number_text(double value) {
    return std::isnan(value) ? "null" : fmt::format("{:.6g}", value);
}

}  // namespace

std::vector<Verdict> check_numbers(const std::map<std::string, double>& numbers,
                                   const std::vector<Expectation>& expectations,
                                   const std::filesystem::path& file) {
    std::vector<std::string> names;
    for (const auto& [name, value] : numbers) names.push_back(name);
    std::vector<Verdict> verdicts;
    for (const Expectation& e : expectations) {
        const auto found = numbers.find(e.key);
        if (found == numbers.end()) {
            // A misspelt key must not pass as a number that is not there: it is an error of the
            // file, not a miss of the run.
            const std::string near = nearest_name(e.key, names);
            throw bad_input(fmt::format("{}:{}:{}", file.string(), e.line, e.column),
                            fmt::format("the run's summary has no number '{}'", e.key),
                            near.empty() ? "see summary.json for the keys"
                                         : fmt::format("did you mean '{}'?", near));
        }
        verdicts.push_back({e, found->second, passes(e, found->second)});
    }
    return verdicts;
}

bool all_passed(const std::vector<Verdict>& verdicts) {
    return std::all_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.passed; });
}

std::string verdict_table(const std::vector<Verdict>& verdicts) {
    // at least as wide as the headings "key" and "expected"
    std::size_t key_width = 3, expected_width = 8;
    for (const Verdict& v : verdicts) {
        key_width = std::max(key_width, v.expected.key.size());
        expected_width = std::max(expected_width, describe(v.expected).size());
    }
    std::string out = fmt::format("      {:<{}}  {:>12}  {:<{}}  why\n", "key", key_width, "actual",
                                  "expected", expected_width);
    std::size_t missed = 0;
    for (const Verdict& v : verdicts) {
        out += fmt::format("{:<4}  {:<{}}  {:>12}  {:<{}}  {}\n", v.passed ? "ok" : "MISS",
                           v.expected.key, key_width, number_text(v.actual), describe(v.expected),
                           expected_width, v.expected.why);
        missed += v.passed ? 0 : 1;
    }
    return out + fmt::format("{} of {} as expected\n", verdicts.size() - missed, verdicts.size());
}

std::string junit_text(const std::vector<Verdict>& verdicts, const std::string& suite) {
    using views::escape;
    const auto missed =
        std::count_if(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return !v.passed; });
    std::string out = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"{}\" tests=\"{}\" "
        "failures=\"{}\">\n",
        escape(suite), verdicts.size(), missed);
    for (const Verdict& v : verdicts) {
        out += fmt::format("<testcase classname=\"{}\" name=\"{}\">", escape(suite),
                           escape(v.expected.key));
        if (!v.passed)
            out += fmt::format(
                "<failure message=\"{}\">{}</failure>",
                // CI servers show the message in a list and the text below it: the number and its
                // bound, then the reason.
                escape(fmt::format("{} is not {}", number_text(v.actual), describe(v.expected))),
                escape(v.expected.why));
        out += "</testcase>\n";
    }
    return out + "</testsuite>\n";
}

}  // namespace ice::check
