// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/json_file.hpp"

#include <algorithm>
#include <fstream>

#include "common/base/version.hpp"

namespace ice {

Json parse_json_file(const std::filesystem::path& path) {
    std::error_code ignored;
    std::ifstream in(path, std::ios::binary);
    if (!in || !std::filesystem::is_regular_file(path, ignored))
        throw bad_input(path.string(), "file not found or not readable", "check the path");
    try {
        return Json::parse(in);
    } catch (const Json::exception& error) {
        throw bad_input(path.string(), std::string("is not valid JSON: ") + error.what(),
                        "make it again with the tool that wrote it");
    }
}

std::string json_text(const Json& json) {
    // Texts of the user (titles, paths) may hold bytes that are no UTF-8: they are replaced, as a
    // report with one odd letter is better than no report.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void add_origin(Json& json) {
    json["version"] = version();
    json["git_commit"] = git_commit();
    json["compiler"] = compiler();
}

const Json& JsonReader::at(const std::string& key) const {
    const Json* found = &json_;
    // step by step down the dotted key
    for (std::size_t begin = 0; begin <= key.size();) {
        const std::size_t end = std::min(key.find('.', begin), key.size());
        found = &child(*found, key.substr(begin, end - begin), key);
        begin = end + 1;
    }
    return *found;
}

const Json& JsonReader::child(const Json& parent, const std::string& name,
                              const std::string& key) const {
    if (!parent.is_object() || !parent.contains(name)) throw fault(key, "is missing");
    return parent[name];
}

double JsonReader::number_if_there(const std::string& parent, const std::string& name) const {
    // The parent must be there: only a name that later versions added may be missing.
    const Json& object = at(parent);
    return object.contains(name) ? value_or_nan(object[name], parent + "." + name)
                                 : std::numeric_limits<double>::quiet_NaN();
}

std::map<std::string, double> JsonReader::numbers(const std::string& key) const {
    std::map<std::string, double> out;
    if (!has(key)) return out;
    for (const auto& [name, value] : json_[key].items())
        out[name] = value_or_nan(value, key + "." + name);
    return out;
}

std::array<double, 3> JsonReader::vector(const Json& json, const std::string& key) const {
    if (json.size() != 3) throw fault(key, "has not 3 elements");
    std::array<double, 3> out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = value_or_nan(json[k], key);
    return out;
}

}  // namespace ice
