// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/base/nearest_name.hpp"

#include <algorithm>
#include <numeric>

namespace ice {

namespace {

// Levenshtein's distance, one row of the table at a time: row[j] is the distance between the first
// i letters of a and the first j of b
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        // of the row before, one place to the left: its place in `row` is overwritten
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({change, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
}

// the part behind the last dot, or all
std::string_view last_part(std::string_view name) { return name.substr(name.rfind('.') + 1); }

std::size_t count_changes(std::string_view wrong, std::string_view name) {
    const std::size_t whole = edit_distance(wrong, name);
    // A wrong table costs one change, however different its name is: users remember the key itself.
    if (name.find('.') == std::string_view::npos) return whole;
    return std::min(whole, 1 + edit_distance(last_part(wrong), last_part(name)));
}

}  // namespace

std::string nearest_name(std::string_view wrong, const std::vector<std::string>& names) {
    std::string best;
    std::size_t least = 0;
    for (const std::string& name : names) {
        const std::size_t longer = std::max(wrong.size(), name.size());
        const std::size_t changes = count_changes(wrong, name);
        // at most two changes or a quarter of the letters, and less than half of them
        if (changes > std::max<std::size_t>(2, longer / 4) || 2 * changes >= longer) continue;
        // strictly less: of equally near names the first stays, in the order of the schema
        if (best.empty() || changes < least) {
            best = name;
            least = changes;
        }
    }
    return best;
}

}  // namespace ice
