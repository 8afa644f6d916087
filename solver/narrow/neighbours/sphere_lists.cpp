// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/neighbours/sphere_lists.hpp"

#include <limits>

namespace ice {

void SphereLists::carry_over(const std::vector<BodyPair>& pairs) {
    if (pairs == lists_.pairs()) return;
    // a pair without a row is always measured: its clearance is minus infinity
    moved_clearance_.assign(pairs.size(), -std::numeric_limits<double>::infinity());
    lists_.carry_over(
        pairs, [&](std::size_t old, std::size_t k) { moved_clearance_[k] = clearance_[old]; });
    clearance_.swap(moved_clearance_);
}

}  // namespace ice
