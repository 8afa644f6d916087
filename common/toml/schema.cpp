// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/toml/schema.hpp"

#include "common/base/nearest_name.hpp"

namespace ice {

const Key* Schema::find(std::string_view path) const {
    for (const Key& key : keys)
        if (key.path == path) return &key;
    return nullptr;
}

std::string Schema::nearest(std::string_view path) const {
    std::vector<std::string> names;
    for (const Key& key : keys) names.emplace_back(key.path);
    return nearest_name(path, names);
}

std::vector<std::string> Schema::tables() const {
    std::vector<std::string> names;
    for (const Key& key : keys) {
        const auto dot = key.path.rfind('.');
        if (dot == std::string_view::npos) continue;
        const std::string table(key.path.substr(0, dot));
        // keys of a table are adjacent
        if (names.empty() || names.back() != table) names.push_back(table);
    }
    return names;
}

}  // namespace ice
