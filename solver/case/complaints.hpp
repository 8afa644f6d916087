// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "common/toml/read_toml.hpp"

namespace ice {

/// Mistakes of a case with the place at which each was made.
struct Complaints {
    std::filesystem::path file;
    Mistakes& mistakes;

    /// About the case as a whole, such as a key that is missing.
    void add(const std::string& text) const;
    /// About a key that was given, at its place. @param label "hull.speed", "floes.0.gap"
    void add_at(const std::string& label, const std::string& text) const;
};

/// "floes.0.gap" counted from 1, as in the case file: floes.1.gap. Other labels stay as they are.
std::string counted_from_one(const std::string& label);

}  // namespace ice
