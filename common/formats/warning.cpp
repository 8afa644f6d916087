// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/warning.hpp"

#include <fmt/format.h>

namespace ice {

Warning judged(std::string text, std::optional<double> share) {
    Warning out{std::move(text)};
    if (share) out.affects_mean = *share > kMatters;
    out.share = share;
    return out;
}

std::string with_verdict(const Warning& w) {
    if (!w.affects_mean) return w.text + " (effect on the mean resistance: not measured)";
    const std::string about =
        w.share ? fmt::format(": about {:.2g} % of it", 100.0 * *w.share) : std::string();
    const char* verb = *w.affects_mean ? "affects" : w.share ? "hardly affects" : "does not affect";
    return fmt::format("{} ({} the mean resistance{})", w.text, verb, about);
}

}  // namespace ice
