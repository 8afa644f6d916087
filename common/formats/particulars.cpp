// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/particulars.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace ice {

std::string release_rule(const IceParticulars& ice) {
    return fmt::format("{}", fmt::join(ice.hold, ", "));
}

std::string averaged_text(double averaged_lengths) {
    constexpr double kOne = 0.995;  // what is shown as 1.00
    return fmt::format("{:.2f} ship lengths{}", averaged_lengths,
                       averaged_lengths < kOne ? ", less than one" : "");
}

}  // namespace ice
