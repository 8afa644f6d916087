// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/formats/summary_file.hpp"

namespace ice::report {

using NamedSummary = std::pair<std::string, Summary>;  ///< folder as given, summary.json

/// Several runs side by side, a line each: resistance with interval, its parts, scatter, maximum,
/// Lindqvist's estimate (level ice: the total, broken ice: submersion), floes moved, steps that did
/// not converge [%], status; newtons, columns ..._N. Runs in 2D follow in a table of their own, in
/// newtons per metre, columns ..._N_per_m. Numbers have about four digits, whole ones all of
/// theirs. Missing values are "-". No runs give a line of headings.
std::string compare_text(const std::vector<NamedSummary>& runs);

/// The comparison as CSV (RFC 4180), all digits; missing values are empty.
/// @throws Error (exit code 2) for runs in 3D and in 2D, which share no columns
std::string compare_csv(const std::vector<NamedSummary>& runs);

}  // namespace ice::report
