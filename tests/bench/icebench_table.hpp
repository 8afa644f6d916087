// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "tests/bench/icebench_measure.hpp"

namespace ice::bench {

/// Head of the main table, and one line of it; markdown.
std::string table_head();
/// @param to_ours  the row's time over our solver's, "" for our own
std::string table_line(const Row& row, const std::string& to_ours);

/// Mean time of every stage of our solver; rows of other engines have none.
std::string stage_table(const std::vector<Row>& rows);

/// The rows as CSV: engine,scene,floes,threads,simd,ms_min,ms_median,contacts,max_overlap_mm,
/// energy_J,state_hash. Peers have no instruction set and no hash.
std::string csv_text(const std::vector<Row>& rows);

}  // namespace ice::bench
