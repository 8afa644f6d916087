// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/check/read_expected.hpp"

#define TOML_HEADER_ONLY 0  // Debian's library holds the code
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/base/nearest_name.hpp"
#include "common/toml/recognise_input.hpp"

namespace ice::check {

namespace {

const std::vector<std::string> kNames{"key", "value", "abs", "rel", "min", "max", "why"};

class Reader {
public:
    explicit Reader(const std::filesystem::path& path) : path_(path) {}

    std::vector<Expectation> read() const {
        toml::table file;
        try {
            file = toml::parse_file(path_.string());
        } catch (const toml::parse_error& error) {
            // The parser reports a missing file as an error of its first line.
            if (!std::filesystem::exists(path_))
                throw bad_input(path_.string(), "file not found", "check the path");
            throw fault(error.source(), std::string(error.description()), "correct the TOML");
        }
        refuse_another_kind(file);
        for (const auto& [name, node] : file)
            if (name.str() != "expect") throw unknown(name, {"expect"});
        const toml::array* entries = file["expect"].as_array();
        if (entries == nullptr || entries->empty())
            throw bad_input(path_.string(), "holds no [[expect]] entries",
                            "add one: [[expect]], key = \"resistance.mean_N\", min = 0");
        std::vector<Expectation> expectations;
        for (const toml::node& node : *entries) {
            if (!node.is_table())
                throw fault(node.source(), "expect is no table", "write [[expect]]");
            expectations.push_back(read_entry(*node.as_table()));
        }
        return expectations;
    }

private:
    Error fault(const toml::source_region& at, const std::string& what,
                const std::string& remedy) const {
        return bad_input(fmt::format("{}:{}:{}", path_.string(), at.begin.line, at.begin.column),
                         what, remedy);
    }

    // a case, whose every table would be unknown
    void refuse_another_kind(const toml::table& file) const {
        std::vector<std::string> names;
        for (const auto& [name, node] : file) names.emplace_back(name.str());
        if (const auto other = recognise_tables(path_, names, "expected numbers"))
            throw bad_input(path_.string(), "is " + other->what + ", no list of expected numbers",
                            other->remedy);
    }

    Error unknown(const toml::key& name, const std::vector<std::string>& known) const {
        const std::string near = nearest_name(std::string(name.str()), known);
        return fault(name.source(), fmt::format("unknown key '{}'", name.str()),
                     near.empty() ? fmt::format("known keys: {}", fmt::join(known, ", "))
                                  : fmt::format("did you mean '{}'?", near));
    }

    std::optional<double> number(const toml::table& entry, const char* name) const {
        const toml::node* node = entry.get(name);
        if (node == nullptr) return std::nullopt;
        const auto value = node->value<double>();
        // TOML has nan as a number; no comparison with it would ever fail or pass as meant
        if (!node->is_number() || !value || std::isnan(*value))
            throw fault(node->source(), fmt::format("{} is not a number", name),
                        fmt::format("write {} = 1.0", name));
        return *value;
    }

    double tolerance(const toml::table& entry, const char* name) const {
        const double value = number(entry, name).value_or(0.0);
        if (value < 0.0)
            throw fault(entry.get(name)->source(), fmt::format("{} is negative", name),
                        "a tolerance is 0 or more");
        return value;
    }

    Expectation read_entry(const toml::table& entry) const {
        for (const auto& [name, node] : entry)
            if (std::find(kNames.begin(), kNames.end(), name.str()) == kNames.end())
                throw unknown(name, kNames);
        Expectation e;
        const toml::node* key = entry.get("key");
        if (key == nullptr || !key->is_string())
            throw fault(entry.source(), "an expectation without key",
                        "add key = \"resistance.mean_N\"");
        e.key = *key->value<std::string>();
        // Kept for check_numbers: that a key is not in the summary is found out later, and has a
        // place in this file, too.
        e.line = static_cast<int>(key->source().begin.line);
        e.column = static_cast<int>(key->source().begin.column);
        if (const toml::node* why = entry.get("why"))
            e.why = why->value<std::string>().value_or("");
        e.value = number(entry, "value");
        e.min = number(entry, "min");
        e.max = number(entry, "max");
        // both tolerances may be given: the larger one counts (Expectation)
        e.abs = tolerance(entry, "abs");
        e.rel = tolerance(entry, "rel");
        // a value needs a tolerance, a bound has none of its own: anything else is ambiguous
        const bool bounded = e.min || e.max,
                   tolerant = entry.contains("abs") || entry.contains("rel");
        if (e.value.has_value() == bounded || e.value.has_value() != tolerant)
            throw fault(key->source(), fmt::format("'{}' has no clear bound", e.key),
                        "give value with abs or rel, or else min and/or max");
        if (e.min && e.max && *e.min > *e.max)
            throw fault(key->source(), fmt::format("'{}' has min above max", e.key), "swap them");
        return e;
    }

    std::filesystem::path path_;
};

}  // namespace

std::vector<Expectation> read_expected(const std::filesystem::path& path) {
    return Reader(path).read();
}

}  // namespace ice::check
