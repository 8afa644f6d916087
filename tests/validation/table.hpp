// SPDX-License-Identifier: GPL-3.0-or-later
/// The validation table of the README: every row is a check that ran.
#pragma once

#include <string>

namespace ice::test {

/// How far `got` may be from `expected`.
struct Tolerance {
    double value;
    bool relative;  ///< to |expected|; else in the row's unit
};
constexpr Tolerance within_percent(double percent) { return {0.01 * percent, true}; }
constexpr Tolerance within(double absolute) { return {absolute, false}; }

/// One comparison with a known answer.
struct Comparison {
    std::string name;  ///< of the case, with its numbers; rows of one name are merged
    std::string unit;  ///< "" for a ratio
    double expected = 0.0;
    double got = 0.0;
    Tolerance tolerance{0.0, false};
    std::string why;  ///< why `expected` is the answer: a formula, a law, a source
};

/// CHECKs |got - expected| <= tolerance (not a number fails) and adds the row to the table.
///
/// Of several comparisons with the same name the one farthest out, in units of its tolerance, is
/// shown with their number: "(worst of 36)".
///
/// A run of the whole program with the environment variable ICE_VALIDATION_TABLE=FILE writes the
/// table to FILE as markdown when it ends.
void validate(const Comparison& row);

/// Adds a row that is shown beside the others without a bound: what the paper's rule gives.
void show(const Comparison& row);

}  // namespace ice::test
