// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/case/complaints.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace ice {

void Complaints::add(const std::string& text) const {
    mistakes.add(file.string() + ": error: " + text);
}

void Complaints::add_at(const std::string& label, const std::string& text) const {
    const auto place = mistakes.places.find(label);
    mistakes.add((place == mistakes.places.end() ? file.string() : place->second) +
                 ": error: " + text);
}

std::string counted_from_one(const std::string& label) {
    if (!label.starts_with("floes.")) return label;
    const auto dot = label.find('.', sizeof("floes.") - 1);
    return fmt::format("floes.{}{}", std::atol(label.c_str() + sizeof("floes.") - 1) + 1,
                       label.substr(dot));
}

}  // namespace ice
