// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/toml/read_toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <stdexcept>

#include "common/base/assert.hpp"
#include "common/base/nearest_name.hpp"
#include "common/toml/quote_line.hpp"
#include "common/toml/read_value.hpp"
#include "common/toml/recognise_input.hpp"

namespace ice {

namespace {

// Length of an unknown key [characters] up to which a near name is searched for: the search takes
// the product of both lengths, and no real key has a third of this. A larger value takes longer on
// files of noise, a smaller one suggests nothing for long keys.
constexpr std::size_t kMostOfKey = 120;
// Characters of an override that name it in a message [-]: most are shorter. Fewer cut usual ones,
// more let a table of numbers hide the mistake behind it.
constexpr std::size_t kMostOfOption = 60;
// Repeated tables ([[floes]]). A case has a handful; more would be a generated file whose floes
// belong in a field file. A higher bound costs memory and a slower start.
constexpr std::size_t kMostTables = 10000;

// A parsed text and the schema that its keys are held against. It walks the tree of tables once.
class Document {
public:
    // @param is_file  else an option
    Document(const std::string& text, std::string name, const Schema& schema, Mistakes& mistakes,
             bool is_file)
        : complaints_(text, name, mistakes, is_file),
          is_file_(is_file),
          name_(std::move(name)),
          schema_(schema),
          mistakes_(mistakes) {}

    Values read(const std::string& text, std::size_t& groups) {
        toml::table root;
        try {
            root = toml::parse(text);
        } catch (const toml::parse_error& error) {
            complain_of_syntax(error);
            return {};
        }
        // One message for a file of another kind, in place of one for each of its keys.
        if (is_file_ && is_another_kind(root)) return {};
        Values values;
        walk(root, "", "", values, groups);
        return values;
    }

private:
    void complain(const toml::source_region& where, const std::string& what, std::size_t width) {
        complaints_.add(where, what, width);
    }

    void complain_of_syntax(const toml::parse_error& error) {
        // the parser's own words, then the probable cause
        const std::string what(error.description());
        const std::string hint = what.find("utf-8") != std::string::npos
                                     ? "; save the file as UTF-8"
                                     : explain_value(complaints_.line(error.source().begin.line));
        complain(error.source(), what + hint, 1);
    }

    // A case given to icefield would get a dozen errors, and none would name the cause.
    bool is_another_kind(const toml::table& root) {
        std::vector<std::string> names;
        for (auto&& [key, node] : root) names.emplace_back(key.str());
        const auto other = recognise_tables(name_, names, schema_.title);
        if (!other) return false;
        mistakes_.add(
            fmt::format("{}: error: this is {}, no {}", name_, other->what, schema_.title));
        mistakes_.remedy = other->remedy;
        return true;
    }

    // `path` is the schema's name of a table, `label` the one with the group's number
    void walk(const toml::table& table, const std::string& path, const std::string& label,
              Values& values, std::size_t& groups) {
        for (auto&& [key, node] : table) {
            const std::string name(key.str());
            const std::string full = path.empty() ? name : path + "." + name;
            const std::string labelled = label.empty() ? name : label + "." + name;
            const bool number =
                is_repeated(path) && std::all_of(name.begin(), name.end(),
                                                 [](unsigned char c) { return std::isdigit(c); });
            if (number && node.is_table()) {  // an override's floes.2.gap, numbered from 1
                // longer numbers name no group, and might not fit a long
                const long group = name.size() < 9 ? std::atol(name.c_str()) : 0;
                if (group < 1 || group > static_cast<long>(groups))
                    complain(
                        key.source(),
                        fmt::format("there is no {}.{}: the case has {} group(s), numbered from 1",
                                    path, name, groups),
                        name.size());
                else
                    walk(*node.as_table(), path, label + "." + std::to_string(group - 1), values,
                         groups);
                // the order matters: [[floes]], then a table that the schema knows, then one that
                // it does not
            } else if (const auto* rows = node.as_array(); rows && is_repeated(full)) {
                walk_repeated(*rows, values, groups);
            } else if (const auto* inner = node.as_table(); inner && is_table(full)) {
                walk_table(key, *inner, full, labelled, values, groups);
            } else if (!schema_.find(full) && (node.is_table() || node.is_array_of_tables())) {
                read_unknown_table(key, node, full, values, groups);
            } else {
                read_key(key, node, full, labelled, values);
            }
        }
    }

    void walk_table(const toml::key& key, const toml::table& table, const std::string& path,
                    const std::string& label, Values& values, std::size_t& groups) {
        if (!is_repeated(path) || groups > 0) return walk(table, path, label, values, groups);
        // of a file: there are no groups yet that an override could mean
        complain(key.source(), fmt::format("write [[{0}]] for each group, not [{0}]", path),
                 path.size());
        walk(table, path, path + "." + std::to_string(groups++), values, groups);
    }

    // A misspelt table is complained of once and read as the one that was meant: its keys are
    // neither unknown nor missing.
    void read_unknown_table(const toml::key& name, const toml::node& node, const std::string& path,
                            Values& values, std::size_t& groups) {
        // only tables are candidates: a key of the same name is another mistake (read_key)
        const std::string near = is_table(path)        ? path
                                 : worth_a_guess(path) ? nearest_name(path, schema_.tables())
                                                       : "";
        if (near.empty() || mistakes_.full()) {
            complain(name.source(),
                     fmt::format("unknown table '{}'; the tables are {}", path,
                                 fmt::join(schema_.tables(), ", ")),
                     name.str().size());
            return;
        }
        complain(name.source(),
                 near == path ? fmt::format("there is one table of this name: write [{}]", path)
                              : fmt::format("unknown table '{}'; did you mean '{}'?", path, near),
                 name.str().size());
        // four cases: rows or one table in the file, repeated or single in the schema
        if (const auto* rows = node.as_array(); rows && is_repeated(near))
            walk_repeated(*rows, values, groups);
        else if (const auto* rows_of_one = node.as_array())
            walk(*rows_of_one->get(0)->as_table(), near, near, values, groups);
        else if (!is_repeated(near))
            walk(*node.as_table(), near, near, values, groups);
        else
            walk(*node.as_table(), near, near + "." + std::to_string(groups++), values, groups);
    }

    // no suggestion is searched for among thousands of keys, nor for very long ones
    bool worth_a_guess(const std::string& path) const {
        return !mistakes_.full() && path.size() < kMostOfKey;
    }

    void walk_repeated(const toml::array& rows, Values& values, std::size_t& groups) {
        // Rows of a repeated table become keys with a number, "floes.0.gap": so every other part of
        // the program has one kind of key only.
        const std::string& name = schema_.repeated_table;
        for (const toml::node& row : rows) {
            if (groups >= kMostTables) {
                complain(row.source(),
                         fmt::format("more than {} [[{}]] tables; describe many floes by count, or "
                                     "make a field of them with icefield",
                                     kMostTables, name),
                         1);
                return;
            }
            if (const auto* table = row.as_table())
                walk(*table, name, name + "." + std::to_string(groups), values, groups);
            else
                complain(row.source(),
                         fmt::format("{0} must be tables: write [[{0}]] for each group", name), 1);
            ++groups;
        }
    }

    bool is_repeated(const std::string& path) const {
        return !path.empty() && path == schema_.repeated_table;
    }

    // a table is known by its keys: the schema lists no tables
    bool is_table(const std::string& path) const {
        return std::any_of(schema_.keys.begin(), schema_.keys.end(),
                           [&](const Key& key) { return key.path.starts_with(path + "."); });
    }

    void read_key(const toml::key& name, const toml::node& node, const std::string& path,
                  const std::string& label, Values& values) {
        const Key* key = schema_.find(path);
        if (key == nullptr && is_table(path)) {
            complain(name.source(),
                     fmt::format("'{0}' is a table: write [{0}], its keys below", path),
                     name.str().size());
            return;
        }
        if (key == nullptr) {
            const std::string near = worth_a_guess(path) ? schema_.nearest(path) : "";
            complain(name.source(),
                     "unknown key '" + path + "'" +
                         (near.empty() ? "; " + schema_.program + " --print-defaults lists all keys"
                                       : "; did you mean '" + near + "'?"),
                     name.str().size());
            return;
        }
        // the place of the key, for complaints that come after reading
        mistakes_.places[label] = complaints_.place(name.source());
        const auto others = schema_.elsewhere.find(path);
        const std::string elsewhere = others == schema_.elsewhere.end() ? "" : others->second;
        Value value;
        if (read_value(*key, node, elsewhere, complaints_, value))
            values[label] = value;
        else
            mistakes_.bad_keys.insert(label);
    }

    Complaints complaints_;
    bool is_file_;
    std::string name_;
    const Schema& schema_;
    Mistakes& mistakes_;
};

// "--set hull.speed=1", of a long one its beginning: of several options it tells which.
std::string name_of_override(const std::string& text) {
    std::vector<std::string> words = printable_characters(text);
    if (words.size() > kMostOfOption) {
        words.resize(kMostOfOption);
        words.emplace_back("...");
    }
    return fmt::format("--set {}", fmt::join(words, ""));
}

bool parses(const std::string& text) {
    try {
        (void)toml::parse(text);
        return true;
    } catch (const toml::parse_error&) {
        return false;
    }
}

}  // namespace

Values read_toml(const std::string& text, const std::string& name, const Schema& schema,
                 Mistakes& mistakes, std::size_t& groups) {
    return Document(text, name, schema, mistakes, true).read(text, groups);
}

Values read_override(const std::string& text, const Schema& schema, std::size_t groups,
                     Mistakes& mistakes) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
        mistakes.add(name_of_override(text) + ": error: write it as key=value");
        return {};
    }
    const std::string key = text.substr(0, equals), value = text.substr(equals + 1);
    std::string line = key + " = " + value;
    // --set hull.spheres=a.h5 without the quotes that a shell takes away
    if (!parses(line)) line = key + " = \"" + value + "\"";
    return Document(line, name_of_override(text), schema, mistakes, false).read(line, groups);
}

Value default_value(const Key& key, const Schema& schema) {
    ICE_ASSERT(key.default_text != "-" && !key.default_text.empty());
    // the default is read as a given value is
    Mistakes mistakes;
    std::size_t groups = 0;
    const std::string line = fmt::format("{} = {}", key.path, key.default_text);
    const Values values = Document(line, "default", schema, mistakes, false).read(line, groups);
    if (values.empty()) throw std::logic_error("bad default: " + line);
    return values.begin()->second;
}

}  // namespace ice
