// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "postprocess/check/read_expected.hpp"

namespace ice::check {

/// One expectation and the run's value.
struct Verdict {
    Expectation expected;
    double actual = 0.0;  ///< in the key's unit; NaN for null: never passes
    bool passed = false;
};

/// Compares numbers (read_json_numbers) with expectations, in their order; none gives none. Bounds
/// are inclusive; a tolerance is exceeded by up to 1e-12 of the number, for rounding.
///
/// @param file name of the expectations' file, for messages
/// @throws Error (exit code 2) with line and column for a key that is not among the numbers, naming
///         the nearest one that is.
std::vector<Verdict> check_numbers(const std::map<std::string, double>& numbers,
                                   const std::vector<Expectation>& expectations,
                                   const std::filesystem::path& file);

/// True also for an empty list.
bool all_passed(const std::vector<Verdict>& verdicts);

/// A table for people: verdict, key, actual number, expectation and why.
std::string verdict_table(const std::vector<Verdict>& verdicts);

/// The verdicts as JUnit XML, a test case per expectation. @param suite name of the run
std::string junit_text(const std::vector<Verdict>& verdicts, const std::string& suite);

}  // namespace ice::check
