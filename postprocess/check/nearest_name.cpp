// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/check/nearest_name.hpp"

#include <algorithm>
#include <numeric>

namespace ice::check {

namespace {

// Levenshtein distance, one row of the table at a time
std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
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

}  // namespace

std::string nearest_name(const std::string& wrong, const std::vector<std::string>& names) {
    std::string best;
    std::size_t least = 0;
    for (const std::string& name : names) {
        const std::size_t distance = edit_distance(wrong, name);
        if (5 * distance > 2 * std::max(wrong.size(), name.size())) continue;
        if (best.empty() || distance < least) {
            best = name;
            least = distance;
        }
    }
    return best;
}

}  // namespace ice::check
