// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/warning.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace ice {

Warning judged(std::string text, std::optional<double> share) {
    Warning out{std::move(text)};
    if (share) out.affects_mean = *share > kMatters;
    out.share = share;
    return out;
}

std::optional<double> affected_share(const std::vector<Warning>& warnings) {
    double largest = 0.0;
    bool unknown = false;
    for (const Warning& w : warnings) {
        if (!w.affects_mean.value_or(true)) continue;
        if (w.affects_mean && w.share)
            largest = std::max(largest, std::min(*w.share, 1.0));
        else
            unknown = true;
    }
    if (largest == 0.0 && unknown) return std::nullopt;
    return largest;
}

std::string with_verdict(const Warning& w) {
    if (!w.affects_mean) return w.text + " (effect on the mean resistance: not measured)";
    // No part of a mean is as large as the mean; a mean of 0 has a share of 1. The bound is the
    // least share [-] that would be shown as 100 %.
    if (*w.affects_mean && w.share.value_or(0.0) >= 0.995)
        return w.text + " (the mean cannot be trusted)";
    const double percent = 100.0 * w.share.value_or(0.0);
    const std::string about = !w.share         ? std::string()
                              : percent < 9.95 ? fmt::format(": about {:.2g} % of it", percent)
                                               : fmt::format(": about {:.0f} % of it", percent);
    // "hardly" with a number that was measured and is small, "does not" where nothing can reach the
    // mean
    const char* verb = *w.affects_mean ? "affects" : w.share ? "hardly affects" : "does not affect";
    return fmt::format("{} ({} the mean resistance{})", w.text, verb, about);
}

}  // namespace ice
