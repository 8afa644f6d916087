// SPDX-License-Identifier: GPL-3.0-or-later
/// The table of docs/validation.md: every row is a check that ran.
#pragma once

#include <string>

namespace ice::test {

/// How far `got` may be from `expected`.
struct Tolerance {
    enum Kind { absolute, relative, upper } kind = absolute;
    double value = 0.0;  ///< in the row's unit, or as a share of |expected|; upper: not used
};
constexpr Tolerance within_percent(double percent) { return {Tolerance::relative, 0.01 * percent}; }
constexpr Tolerance within(double absolute) { return {Tolerance::absolute, absolute}; }
constexpr Tolerance at_most_expected() { return {Tolerance::upper}; }  ///< got <= expected

/// One comparison with a known answer.
struct Comparison {
    std::string name;  ///< of the case, with its numbers; rows of one name are merged
    std::string unit;  ///< "" for a ratio
    double expected = 0.0;
    double got = 0.0;
    Tolerance tolerance;
    std::string why;  ///< why `expected` is the answer: a formula, a law, a source
};

/// CHECKs |got - expected| <= tolerance, or got <= expected for an upper bound (not a number fails
/// either), and adds the row to the table.
///
/// Of several comparisons with the same name the one farthest out, in units of its tolerance, is
/// shown with their number: "(worst of 36)".
///
/// A run of the whole program with the environment variable ICE_VALIDATION_TABLE=FILE writes the
/// table to FILE as markdown when it ends. ICE_TOLERANCE_SCALE=0 takes tolerances away: each row
/// that is not exact then fails and prints its residual as a share of its tolerance.
void validate(const Comparison& row);

/// Adds a row that is shown beside the others without a bound: what the paper's rule gives.
void show(const Comparison& row);

}  // namespace ice::test
