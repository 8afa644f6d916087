// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/toml/schema.hpp"

#include <algorithm>

namespace ice {

namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] =
                std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
            diagonal = above;
        }
    }
    return row[b.size()];
}

}  // namespace

const Key* Schema::find(std::string_view path) const {
    for (const Key& key : keys)
        if (key.path == path) return &key;
    return nullptr;
}

std::string Schema::nearest(std::string_view path) const {
    const Key* best = nullptr;
    std::size_t least = std::max<std::size_t>(2, path.size() / 4) + 1;
    for (const Key& key : keys) {
        // a right name in the wrong table is as near as a misspelt one
        const auto tail = key.path.substr(key.path.rfind('.') + 1);
        const std::size_t distance =
            std::min(edit_distance(key.path, path),
                     1 + edit_distance(tail, path.substr(path.rfind('.') + 1)));
        if (distance < least) {
            least = distance;
            best = &key;
        }
    }
    return best ? std::string(best->path) : "";
}

}  // namespace ice
