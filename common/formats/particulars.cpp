// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/particulars.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace ice {

std::string release_rule(const IceParticulars& ice) {
    return fmt::format("{}", fmt::join(ice.hold, ", "));
}

std::string release_rule_in_words(const IceParticulars& ice) {
    std::vector<std::string> words;
    for (const std::string& until : ice.hold)
        words.push_back(until == "never"    ? "never (loose)"
                        : until == "always" ? "always (unbroken)"
                                            : until);
    return fmt::format("{}", fmt::join(words, ", "));
}

bool is_short(double averaged_lengths) {
    // Ship lengths [-]: the least number that two decimals show as 1.00. A text "1.00, less than
    // one" would contradict itself.
    constexpr double kOne = 0.995;
    return averaged_lengths < kOne;
}

std::string averaged_text(double averaged_lengths) {
    return fmt::format("{:.2f} ship lengths{}", averaged_lengths,
                       is_short(averaged_lengths) ? ", less than one" : "");
}

}  // namespace ice
