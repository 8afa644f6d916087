// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/toml/read_toml.hpp"

// Debian's libtomlplusplus.so holds the version that throws
#define TOML_HEADER_ONLY 0
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "common/base/nearest_name.hpp"
#include "common/toml/quote_line.hpp"
#include "common/toml/recognise_input.hpp"

namespace ice {

namespace {

constexpr std::size_t kMostShown = 120;     // characters of a key in a message
constexpr std::size_t kMostTables = 10000;  // [[floes]]

class Document {
public:
    Document(const std::string& text, std::string name, const Schema& schema, Mistakes& mistakes)
        : name_(std::move(name)), schema_(schema), mistakes_(mistakes) {
        std::istringstream in(text);
        for (std::string line; std::getline(in, line);) lines_.push_back(line);
    }

    // `whole`: a file, not an override
    Values read(const std::string& text, bool whole, std::size_t& groups) {
        toml::table root;
        try {
            root = toml::parse(text);
        } catch (const toml::parse_error& error) {
            complain_of_syntax(error);
            return {};
        }
        if (whole && is_another_kind(root)) return {};
        Values values;
        walk(root, "", "", values, groups);
        return values;
    }

private:
    void complain(const toml::source_region& where, const std::string& what, std::size_t width) {
        const auto line = where.begin.line, column = where.begin.column;
        std::string text = fmt::format("{}:{}:{}: error: {}", name_, line, column, shorten(what));
        if (line >= 1 && line <= lines_.size())
            text += quote_line(lines_[line - 1], line, column > 0 ? column - 1 : 0, width);
        mistakes_.add(text);
    }

    void complain_of_syntax(const toml::parse_error& error) {
        const std::string what(error.description());
        const auto line = error.source().begin.line;
        std::string hint;
        if (what.find("utf-8") != std::string::npos)
            hint = "; save the file as UTF-8";
        else if (line >= 1 && line <= lines_.size())
            hint = explain_value(lines_[line - 1]);
        complain(error.source(), what + hint, 1);
    }

    // a case given to icefield would be a dozen mistakes, of which none says what is wrong
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

    static std::string shorten(const std::string& what) {
        return what.size() <= 3 * kMostShown ? what : what.substr(0, 3 * kMostShown) + "...";
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
        if (const auto* rows = node.as_array(); rows && is_repeated(near))
            walk_repeated(*rows, values, groups);
        else if (const auto* rows_of_one = node.as_array())
            walk(*rows_of_one->get(0)->as_table(), near, near, values, groups);
        else if (!is_repeated(near))
            walk(*node.as_table(), near, near, values, groups);
        else
            walk(*node.as_table(), near, near + "." + std::to_string(groups++), values, groups);
    }

    // what was meant is not looked for in thousands of keys, nor in very long ones
    bool worth_a_guess(const std::string& path) const {
        return !mistakes_.full() && path.size() < kMostShown;
    }

    void walk_repeated(const toml::array& rows, Values& values, std::size_t& groups) {
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
        mistakes_.places[label] =
            fmt::format("{}:{}:{}", name_, name.source().begin.line, name.source().begin.column);
        Value value;
        if (read_value(*key, node, value))
            values[label] = value;
        else
            mistakes_.bad_keys.insert(label);
    }

    bool read_value(const Key& key, const toml::node& node, Value& out) {
        switch (key.kind) {
            case Kind::number:
                return read_number(key, node, out);
            case Kind::integer:
                return read_integer(key, node, out);
            case Kind::text:
            case Kind::path:
            case Kind::choice:
                return read_text(key, node, out);
            case Kind::vector:
            case Kind::counts:
            case Kind::place:
            case Kind::integer_list:
                return read_list(key, node, out);
            case Kind::pair_list:
                return read_pairs(key, node, out);
        }
        return false;
    }

    // a number in SI, or a text with a unit; range checked
    bool read_scalar(const Key& key, Dimension dimension, const toml::node& node, double& out) {
        if (const auto text = node.value<std::string_view>(); text && node.is_string()) {
            const auto quantity = parse_quantity(*text, dimension);
            if (!quantity) {
                const std::string units = unit_names(dimension);
                complain(node.source(),
                         fmt::format(
                             "{} = \"{}\" is not a number with a unit it can have ({}){}", key.path,
                             *text, units.empty() ? "it has none" : "use " + units,
                             has_decimal_comma(*text) ? "; the decimal point is '.', not ','" : ""),
                         text->size() + 2);
                return false;
            }
            out = quantity->value;
        } else if (const auto number = node.value<double>(); number && node.is_number()) {
            out = *number;
        } else {
            complain(node.source(),
                     fmt::format("{} must be a number{}", key.path,
                                 !has_unit(dimension) ? ""
                                                      : " in " + std::string(si_unit(dimension)) +
                                                            " or a text with a unit"),
                     1);
            return false;
        }
        if (out >= key.low && out <= key.high) return true;
        const bool percent = dimension == Dimension::share && out > 1.0 && 0.01 * out >= key.low &&
                             0.01 * out <= key.high;
        complain(
            node.source(),
            fmt::format("{} = {:g} is outside [{:g}, {:g}] {}", key.path, out, key.low, key.high,
                        percent ? fmt::format("; {0:g} % is {1:g}, or \"{0:g} %\"", out, 0.01 * out)
                        : has_unit(dimension) ? si_unit(dimension)
                                              : ""),
            1);
        return false;
    }

    bool read_number(const Key& key, const toml::node& node, Value& out) {
        double number = 0.0;
        if (!read_scalar(key, key.dimension, node, number)) return false;
        out = number;
        return true;
    }

    bool read_integer(const Key& key, const toml::node& node, Value& out) {
        double number = 0.0;
        if (!node.is_integer()) {
            complain(node.source(), fmt::format("{} must be a whole number", key.path), 1);
            return false;
        }
        if (!read_scalar(key, Dimension::none, node, number)) return false;
        out = static_cast<std::int64_t>(number);
        return true;
    }

    static std::vector<std::string> choices_of(const Key& key) {
        std::vector<std::string> out;
        std::istringstream in{std::string(key.choices)};
        for (std::string choice; std::getline(in, choice, '|');) out.push_back(choice);
        return out;
    }

    bool read_text(const Key& key, const toml::node& node, Value& out) {
        const auto text = node.value<std::string>();
        if (!node.is_string() || !text) {
            complain(node.source(), fmt::format("{} must be a text in quotes", key.path), 1);
            return false;
        }
        const std::string list = "|" + std::string(key.choices) + "|";
        if (key.kind == Kind::choice && list.find("|" + *text + "|") == std::string::npos) {
            const std::string near = nearest_name(*text, choices_of(key));
            complain(node.source(),
                     fmt::format("{} = \"{}\" is none of {}{}", key.path, *text, key.choices,
                                 near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)),
                     text->size() + 2);
            return false;
        }
        out = *text;
        return true;
    }

    bool read_list(const Key& key, const toml::node& node, Value& out) {
        const auto* list = node.as_array();
        const bool any_length = key.kind == Kind::integer_list;
        const std::size_t least = key.kind == Kind::place ? key.length - 1 : key.length;
        if (!list || (!any_length && (list->size() < least || list->size() > key.length))) {
            complain(node.source(),
                     any_length
                         ? fmt::format("{} must be a list", key.path)
                         : fmt::format("{} must be a list of {} numbers", key.path, key.length),
                     1);
            return false;
        }
        const bool whole = key.kind == Kind::integer_list || key.kind == Kind::counts;
        std::vector<double> values;
        for (const toml::node& item : *list) {
            double number = 0.0;
            if (whole && !item.is_integer()) {
                complain(item.source(), fmt::format("{} holds whole numbers", key.path), 1);
                return false;
            }
            if (!read_scalar(key, key.dimension, item, number)) return false;
            values.push_back(number);
        }
        out = values;
        return true;
    }

    bool read_pairs(const Key& key, const toml::node& node, Value& out) {
        std::vector<std::pair<double, double>> rows;
        const auto* list = node.as_array();
        for (std::size_t k = 0; list && k < list->size(); ++k) {
            const auto* row = list->get(k)->as_array();
            std::pair<double, double> pair;
            if (!row || row->size() != 2 ||
                !read_scalar(key, Dimension::time, *row->get(0), pair.first) ||
                !read_scalar(key, key.dimension, *row->get(1), pair.second) ||
                (!rows.empty() && pair.first <= rows.back().first)) {
                complain(list->get(k)->source(),
                         fmt::format("{} row {} must be [t, u] with t above the row before",
                                     key.path, k + 1),
                         1);
                return false;
            }
            rows.push_back(pair);
        }
        if (rows.empty()) {
            complain(node.source(), fmt::format("{} must be a list of [t, u]", key.path), 1);
            return false;
        }
        out = rows;
        return true;
    }

    std::string name_;
    const Schema& schema_;
    Mistakes& mistakes_;
    std::vector<std::string> lines_;
};

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
    return Document(text, name, schema, mistakes).read(text, true, groups);
}

Values read_override(const std::string& text, const Schema& schema, std::size_t groups,
                     Mistakes& mistakes) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
        mistakes.add("--set " + text + ": error: write it as key=value");
        return {};
    }
    const std::string key = text.substr(0, equals), value = text.substr(equals + 1);
    std::string line = key + " = " + value;
    if (!parses(line)) line = key + " = \"" + value + "\"";
    return Document(line, "--set", schema, mistakes).read(line, false, groups);
}

Value default_value(const Key& key, const Schema& schema) {
    // the default goes the same way as a given value
    Mistakes mistakes;
    std::size_t groups = 0;
    const std::string line = fmt::format("{} = {}", key.path, key.default_text);
    const Values values = Document(line, "default", schema, mistakes).read(line, false, groups);
    if (values.empty()) throw std::logic_error("bad default: " + line);
    return values.begin()->second;
}

}  // namespace ice
