// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/formats/summary_file.hpp"

namespace ice {

/// A finished run of an ensemble.
struct Member {
    std::int64_t seed = 0;  ///< simulation.seed of the run
    Summary summary;
};

/// The members as one summary: means of their means, Student's interval of the mean of each force
/// component (its ci95; NaN for one member), counts of floes and contacts as means, extremes as
/// extremes, times as sums; of the ice's particulars means, of floe sizes also the extremes.
/// Correlation time, trend, panels and peaks are those of single runs: unknown here, left out.
/// Common entries, such as the title, are the first member's. A warning that all members have
/// stands once, with the largest share; any other begins with its seed. A trend of the resistance
/// stands only where more members show one than chance explains at 1 %.
/// @pre at least one member
Summary average_members(const std::vector<Member>& members);

}  // namespace ice
