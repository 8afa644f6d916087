// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solver/case/case.hpp"

namespace ice {

/// Reads a case file (TOML 1.0), applies `key=value` overrides and fills in the defaults.
///
/// An override's value is read as TOML first, then as text: `contact.restitution=0.1`,
/// `ice.density=917 kg/m3`. `floes.gap=...` applies to every [[floes]] table, `floes.2.gap=...` to
/// the second. Paths are relative to the case file; Case::resolved holds them absolute.
///
/// @throws Error (exit code 2) with every mistake at once, each with line, column and the line
///         itself: unknown key (with the nearest known one), wrong type or unit, out of range,
///         missing key, missing file, both or neither of hull.speed and hull.speed_table.
Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

}  // namespace ice
