// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solver/broad/find_pairs.hpp"

namespace ice {

/// A row and a list of entries of each pair of bodies, kept from step to step. Row k is that of the
/// k-th pair of the last carry_over(). A new list is appended to those of all pairs; once most of
/// the memory is abandoned lists it is closed up.
/// @tparam kFewest  entries [-] up to which gaps are left. Only memory and time depend on it.
template <class Row, class Entry, std::size_t kFewest>
class AppendedLists {
public:
    /// Keeps the rows and lists of pairs that are in the new list, too; other pairs have Row{} and
    /// no entries. Both lists of pairs are sorted.
    /// @param kept  called with the old and the new number of each pair that stays
    template <class Kept>
    void carry_over(const std::vector<BodyPair>& pairs, const Kept& kept) {
        moved_rows_.assign(pairs.size(), Listed{});
        used_ = 0;
        // both lists are sorted: one walk finds the rows that stay
        std::size_t old = 0;
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            while (old < pairs_.size() && pairs_[old] < pairs[k]) ++old;
            if (old == pairs_.size()) break;
            if (pairs_[old] != pairs[k]) continue;
            moved_rows_[k] = rows_[old];
            used_ += rows_[old].count;
            kept(old, k);
        }
        rows_.swap(moved_rows_);
        pairs_ = pairs;
    }
    /// Of the last carry_over().
    const std::vector<BodyPair>& pairs() const { return pairs_; }

    Row& row(std::size_t k) { return rows_[k].row; }
    const Row& row(std::size_t k) const { return rows_[k].row; }

    /// Valid until the next keep() or carry_over().
    std::span<const Entry> listed(std::size_t k) const {
        return {entries_.data() + rows_[k].first, rows_[k].count};
    }
    /// Replaces the list of pair k. One thread at a time.
    void keep(std::size_t k, std::span<const Entry> list) {
        Listed& row = rows_[k];
        used_ += list.size() - row.count;
        row.count = list.size();
        row.first = entries_.size();
        entries_.insert(entries_.end(), list.begin(), list.end());
        // at least half of the memory is abandoned lists: close it up
        if (entries_.size() > kFewest && entries_.size() > 2 * used_) close_gaps();
    }
    /// Makes row k Row{} without entries.
    void drop(std::size_t k) {
        used_ -= rows_[k].count;
        rows_[k] = Listed{};
    }

private:
    struct Listed {
        Row row{};
        std::size_t first = 0, count = 0;  // of entries_
    };
    void close_gaps() {
        moved_entries_.clear();
        for (Listed& row : rows_) {
            const auto first = entries_.begin() + static_cast<std::ptrdiff_t>(row.first);
            row.first = moved_entries_.size();
            moved_entries_.insert(moved_entries_.end(), first,
                                  first + static_cast<std::ptrdiff_t>(row.count));
        }
        entries_.swap(moved_entries_);
    }

    std::vector<BodyPair> pairs_;
    std::vector<Listed> rows_, moved_rows_;  // by pair
    std::vector<Entry> entries_, moved_entries_;
    std::size_t used_ = 0;  // entries of entries_ that rows use
};

}  // namespace ice
