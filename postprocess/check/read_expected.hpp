// SPDX-License-Identifier: GPL-3.0-or-later
/// `expected.toml`: expected sizes of numbers of a run's summary, with reasons.
///
///     [[expect]]
///     key = "resistance.mean_N"   # dotted key of summary.json
///     value = 1400.0              # with abs and/or rel; or min and/or max instead
///     rel = 0.25
///     why = "Lindqvist's submersion part, without jams"
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ice::check {

/// One [[expect]] entry. Either `value`, or `min` and/or `max`.
struct Expectation {
    std::string key, why;                   ///< dotted key of summary.json; reason, may be ""
    std::optional<double> value, min, max;  ///< in the unit of the key's number
    double abs = 0.0, rel = 0.0;            ///< |difference| <= max(abs, rel * |value|); rel [-]
    int line = 0, column = 0;               ///< of the key in the file, from 1
};

/// Reads and checks the file.
///
/// @throws Error (exit code 2) with file:line:column for TOML errors, unknown names (with the
///         nearest known one), wrong types, negative tolerances, entries without a bound, min above
///         max, a file without entries or of another kind.
std::vector<Expectation> read_expected(const std::filesystem::path& path);

}  // namespace ice::check
