// SPDX-License-Identifier: GPL-3.0-or-later
/// The warnings of a run and their effect on its answer.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ice {

/// A warning with its verdict on the mean resistance, the answer of a run.
struct Warning {
    std::string text;  ///< observation and remedy; begins small, no full stop
    std::optional<bool> affects_mean = std::nullopt;  ///< none: unknown, nothing was measured
    /// At most about this share of the mean [-]: the part from the doubtful steps; of a trend half
    /// of its change, as the mean of its end is that far off. None: not measured.
    std::optional<double> share = std::nullopt;

    bool operator==(const Warning&) const = default;
};

/// From this share [-] on the mean counts as affected: a fifth of the 10 % by which another model
/// of contact differs from this one, and no more than the interval of a usual run. A smaller bound
/// marks more warnings; no number changes.
constexpr double kMatters = 0.02;

/// A warning whose share of the mean was measured, or is unknown; kMatters decides.
Warning judged(std::string text, std::optional<double> share);

/// The largest share of the mean [-] that warnings affect, 1 at most; 0: none affects it. None: a
/// warning affects it, or may do so, and no share of any was measured.
std::optional<double> affected_share(const std::vector<Warning>& warnings);

/// The text with the verdict behind it, as a terminal or a report shows it.
std::string with_verdict(const Warning& warning);

}  // namespace ice
