// SPDX-License-Identifier: GPL-3.0-or-later
/// JSON files as this folder reads and writes them. For its .cpp files only: others see structs.
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "common/base/error.hpp"

namespace ice {

/// Keeps the order of insertion, which is the order of the contract; dump() turns NaN into null.
using Json = nlohmann::ordered_json;

/// The file's JSON. @throws Error (exit code 2) naming a file that is missing or no JSON
Json parse_json_file(const std::filesystem::path& path);

/// Indented text. Bytes that are no UTF-8, e.g. of file names, are replaced: JSON must be.
std::string json_text(const Json& json);

/// Adds version, commit and compiler of this program.
void add_origin(Json& json);

/// Reads values by dotted key and names file and key in every complaint.
class JsonReader {
public:
    /// @param remedy  for a faulty file
    JsonReader(const std::filesystem::path& path, std::string remedy)
        : path_(path), remedy_(std::move(remedy)), json_(parse_json_file(path)) {}

    bool has(const std::string& key) const { return json_.contains(key); }

    template <class T>
    T get(const std::string& key) const {
        return convert<T>(at(key), key);
    }

    /// A number, or NaN where the file has null.
    double number(const std::string& key) const { return value_or_nan(at(key), key); }
    /// A number, or NaN where the file, of an older version, has no such key or has null.
    double number_if_there(const std::string& parent, const std::string& name) const;
    /// An object of numbers, or nothing where the file has none.
    std::map<std::string, double> numbers(const std::string& key) const;

    const Json& whole() const { return json_; }
    const Json& at(const std::string& key) const;
    const Json& child(const Json& parent, const std::string& name, const std::string& key) const;
    std::array<double, 3> vector(const Json& json, const std::string& key) const;
    double value_or_nan(const Json& json, const std::string& key) const {
        return convert<std::optional<double>>(json, key).value_or(
            std::numeric_limits<double>::quiet_NaN());
    }

    /// A value that may be null: std::optional<T>.
    template <class T>
    T convert(const Json& json, const std::string& key) const {
        try {
            if constexpr (requires {
                              typename T::value_type;
                              std::nullopt == T();
                          }) {
                if (json.is_null()) return std::nullopt;
                return json.get<typename T::value_type>();
            } else {
                return json.get<T>();
            }
        } catch (const Json::exception&) {
            throw fault(key, "has the wrong type");
        }
    }

    Error fault(const std::string& key, const std::string& what) const {
        return bad_input(path_.string() + ": " + key, what, remedy_);
    }

private:
    std::filesystem::path path_;
    std::string remedy_;
    Json json_;
};

}  // namespace ice
