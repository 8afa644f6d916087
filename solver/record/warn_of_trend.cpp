// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/warn_of_trend.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/base/assert.hpp"

namespace ice {

Warning warn_of_trend(const Summary& summary) {
    const ForceStatistics& r = summary.resistance;
    ICE_ASSERT(r.mean != 0.0);
    const double share = std::abs(r.trend / r.mean);
    const double lengths = summary.travel.averaged_lengths;
    const std::string because =
        is_short(lengths)
            ? fmt::format(" ({}: floes still spread along the hull)", averaged_text(lengths))
            : "";
    return judged(
        fmt::format("the resistance {} by {:.0f} % of its mean over the averaged time{}: begin "
                    "later (output.average_from) or run longer (simulation.duration)",
                    r.trend > 0.0 ? "rises" : "falls", 100.0 * share, because),
        0.5 * share);
}

Warning warn_of_short_averages(const Summary& summary) {
    const ForceStatistics& r = summary.resistance;
    return judged(
        fmt::format("forces are averaged over {}, of {:.2f} travelled: floes need about "
                    "one to pass along the hull; run longer (simulation.duration)",
                    averaged_text(summary.travel.averaged_lengths), summary.travel.lengths),
        std::isfinite(r.ci95) ? std::optional(r.ci95 / std::abs(r.mean)) : std::nullopt);
}

}  // namespace ice
