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

std::optional<CrackParticulars> mean_cracks(const std::vector<CrackParticulars>& runs) {
    if (runs.empty()) return std::nullopt;
    CrackParticulars out;
    for (auto member : {&CrackParticulars::pieces, &CrackParticulars::radius,
                        &CrackParticulars::characteristic_length, &CrackParticulars::thickness,
                        &CrackParticulars::opening_deg, &CrackParticulars::load,
                        &CrackParticulars::channel_breadth}) {
        double sum = 0.0;
        for (const CrackParticulars& run : runs) sum += run.*member;
        out.*member = sum / static_cast<double>(runs.size());
    }
    return out;
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
