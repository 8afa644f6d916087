// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/sphere_lists.hpp"

#include <limits>

namespace ice {

namespace {

// Up to so many blocks [-], some 100 kB, rows that are no longer in use do not matter. Only memory
// and time depend on it.
constexpr std::size_t kFewestBlocks = 256;

}  // namespace

void SphereLists::carry_over(const std::vector<BodyPair>& pairs) {
    if (pairs == pairs_) return;
    moved_rows_.assign(pairs.size(), Row{});
    // a pair without a row is always measured: its clearance is minus infinity
    moved_clearance_.assign(pairs.size(), -std::numeric_limits<double>::infinity());
    kept_ = 0;
    // both lists are sorted: one walk finds the rows that stay
    std::size_t old = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        while (old < pairs_.size() && pairs_[old] < pairs[k]) ++old;
        if (old == pairs_.size()) break;
        if (pairs_[old] != pairs[k]) continue;
        moved_rows_[k] = rows_[old];
        moved_clearance_[k] = clearance_[old];
        kept_ += rows_[old].count;
    }
    rows_.swap(moved_rows_);
    clearance_.swap(moved_clearance_);
    pairs_ = pairs;
}

void SphereLists::keep(std::size_t k, std::span<const ListedSpheres> listed) {
    Row& row = rows_[k];
    kept_ += listed.size() - row.count;
    row.count = listed.size();
    row.first = blocks_.size();
    blocks_.insert(blocks_.end(), listed.begin(), listed.end());
    // at least half of the memory is abandoned rows: close it up
    if (blocks_.size() > kFewestBlocks && blocks_.size() > 2 * kept_) close_gaps();
}

void SphereLists::close_gaps() {
    moved_blocks_.clear();
    for (Row& row : rows_) {
        const auto first = blocks_.begin() + static_cast<std::ptrdiff_t>(row.first);
        row.first = moved_blocks_.size();
        moved_blocks_.insert(moved_blocks_.end(), first,
                             first + static_cast<std::ptrdiff_t>(row.count));
    }
    blocks_.swap(moved_blocks_);
}

}  // namespace ice
