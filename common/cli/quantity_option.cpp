// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/quantity_option.hpp"

#include <fmt/format.h>

#include <cmath>

namespace ice {

namespace {

CLI::Validator quantity(Dimension dimension, bool positive, const std::string& example) {
    return CLI::Validator(
        [=](std::string& text) {
            const auto read = parse_quantity(text, dimension);
            if (!read || !std::isfinite(read->value) || (positive && !(read->value > 0.0))) {
                // the message names the units that are allowed, and an example
                const std::string unit =
                    has_unit(dimension) ? fmt::format(" in {}", si_unit(dimension)) : std::string();
                const std::string units = unit_names(dimension);
                return fmt::format("{} is not a {}number{} ({}{})", text,
                                   positive ? "positive " : "", unit, example,
                                   units.empty() ? "" : ", or with a unit: " + units);
            }
            text = fmt::format("{}", read->value);
            return std::string();
        },
        "");
}

}  // namespace

CLI::Validator positive_quantity(Dimension dimension, const std::string& example) {
    return quantity(dimension, true, example);
}

CLI::Validator finite_quantity(Dimension dimension, const std::string& example) {
    return quantity(dimension, false, example);
}

}  // namespace ice
