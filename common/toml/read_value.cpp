// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/toml/read_value.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "common/base/nearest_name.hpp"
#include "common/toml/quote_line.hpp"

namespace ice {

namespace {

// Characters of a message that may quote a faulty value [-]: about four rows of a terminal. Fewer
// cut messages that list all choices of a key.
constexpr std::size_t kMostWords = 360;

// Reads one node by the kind of its key. Each reader complains at the node itself and returns
// false; values are stored in SI.
class ValueReader {
public:
    ValueReader(Complaints& complaints, const std::string& elsewhere)
        : complaints_(complaints), elsewhere_(elsewhere) {}

    bool read(const Key& key, const toml::node& node, Value& out) {
        // No default: a new kind without a reader is a compiler warning. A choice or vector is told
        // apart by the node, because only one of them is a text.
        switch (key.kind) {
            case Kind::number:
                return read_number(key, node, out);
            case Kind::integer:
                return read_integer(key, node, out);
            case Kind::boolean:
                return read_boolean(key, node, out);
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
            case Kind::curve:
                return read_pairs(key, node, out);
            case Kind::words:
                return read_words(key, node, out);
            case Kind::choice_or_vector:
                return node.is_string() ? read_text(key, node, out) : read_list(key, node, out);
        }
        return false;
    }

private:
    void complain(const toml::source_region& where, const std::string& what, std::size_t width) {
        complaints_.add(where, what, width);
    }

    bool read_boolean(const Key& key, const toml::node& node, Value& out) {
        const auto value = node.value_exact<bool>();
        if (!value) {
            complain(node.source(), fmt::format("{} must be true or false", key.path), 1);
            return false;
        }
        // 0 or 1: values have no kind of their own for booleans
        out = std::int64_t{*value};
        return true;
    }

    // a number in SI, or a text with a unit; range checked
    bool read_scalar(const Key& key, Dimension dimension, const toml::node& node, double& out) {
        // A text has its unit with it; a bare number is SI.
        if (const auto text = node.value<std::string_view>(); text && node.is_string()) {
            const auto quantity = parse_quantity(*text, dimension);
            if (!quantity) {
                // the message lists the units that the key may have, and names a usual slip
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
        // Written so that NaN is out of range, too: TOML has nan as a number.
        if (out >= key.low && out <= key.high) return true;
        // The usual slip with shares: 80 is meant as 80 %.
        const bool percent = dimension == Dimension::share && out > 1.0 && 0.01 * out >= key.low &&
                             0.01 * out <= key.high;
        complain(
            node.source(),
            fmt::format("{} = {:g} is outside [{:g}, {:g}]{}", key.path, out, key.low, key.high,
                        percent ? fmt::format("; {0:g} % is {1:g}, or \"{0:g} %\"", out, 0.01 * out)
                        : has_unit(dimension) ? fmt::format(" {}", si_unit(dimension))
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
        // 3.0 is a float in TOML: refused
        if (!node.is_integer()) {
            complain(node.source(), fmt::format("{} must be a whole number", key.path), 1);
            return false;
        }
        // whole numbers have no unit
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
        // the choices with bars at both ends, so that no part of a word is found
        const std::string list = "|" + std::string(key.choices) + "|";
        const bool chosen = key.kind == Kind::choice || key.kind == Kind::choice_or_vector;
        if (chosen && list.find("|" + *text + "|") == std::string::npos) {
            const std::string near = nearest_name(*text, choices_of(key));
            const std::string hint =
                !near.empty() ? fmt::format("did you mean \"{}\"?", near) : elsewhere_;
            complain(node.source(),
                     fmt::format("{} = \"{}\" is none of {}{}{}", key.path, *text, key.choices,
                                 hint.empty() ? "" : "; ", hint),
                     text->size() + 2);
            return false;
        }
        out = *text;
        return true;
    }

    bool read_words(const Key& key, const toml::node& node, Value& out) {
        const auto* list = node.as_array();
        if (!list) {
            complain(node.source(), fmt::format("{} must be a list of texts in quotes", key.path),
                     1);
            return false;
        }
        // a word twice would count its rule twice, so it is refused, not dropped
        Key one = key;  // each word is a choice
        one.kind = Kind::choice;
        std::vector<std::string> words;
        for (const toml::node& item : *list) {
            Value word;
            if (!read_text(one, item, word)) return false;
            if (std::find(words.begin(), words.end(), std::get<std::string>(word)) != words.end()) {
                complain(
                    item.source(),
                    fmt::format("{} names \"{}\" twice", key.path, std::get<std::string>(word)), 1);
                return false;
            }
            words.push_back(std::get<std::string>(word));
        }
        out = words;
        return true;
    }

    bool read_list(const Key& key, const toml::node& node, Value& out) {
        const auto* list = node.as_array();
        // A place may leave out its last number; all other lists have a fixed length or any.
        const bool any_length = key.kind == Kind::integer_list;
        const std::size_t least = key.kind == Kind::place ? key.length - 1 : key.length;
        if (!list || (!any_length && (list->size() < least || list->size() > key.length))) {
            complain(node.source(),
                     any_length ? fmt::format("{} must be a list", key.path)
                     : key.kind == Kind::choice_or_vector
                         ? fmt::format("{} must be {}, or a list of {} numbers", key.path,
                                       fmt::join(choices_of(key), " or "), key.length)
                     : least < key.length
                         ? fmt::format("{} must be a list of {} or {} numbers", key.path, least,
                                       key.length)
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
        const bool curve = key.kind == Kind::curve;
        // a table over time, or over the ship's speed
        const Dimension first = curve ? Dimension::speed : Dimension::time;
        const char* const form = curve ? "[speed, value] with the speed" : "[t, u] with t";
        for (std::size_t k = 0; list && k < list->size(); ++k) {
            const auto* row = list->get(k)->as_array();
            std::pair<double, double> pair;
            // rows rise: values between them are interpolated, and a time twice would be a jump
            const bool two = row && row->size() == 2;
            // a number that is none, or out of its range, has a complaint of its own
            if (two && (!read_scalar(key, first, *row->get(0), pair.first) ||
                        !read_scalar(key, key.dimension, *row->get(1), pair.second)))
                return false;
            if (!two || (!rows.empty() && pair.first <= rows.back().first)) {
                complain(
                    list->get(k)->source(),
                    fmt::format("{} row {} must be {} above the row before", key.path, k + 1, form),
                    1);
                return false;
            }
            rows.push_back(pair);
        }
        // Also reached by a node that is no list: the loop above then had no row.
        if (rows.empty()) {
            complain(node.source(),
                     fmt::format("{} must be a list of {}", key.path,
                                 curve ? "[speed, value]" : "[t, u]"),
                     1);
            return false;
        }
        out = rows;
        return true;
    }

    Complaints& complaints_;
    const std::string& elsewhere_;
};

}  // namespace

Complaints::Complaints(const std::string& text, std::string name, Mistakes& mistakes, bool is_file)
    : name_(std::move(name)), mistakes_(mistakes), is_file_(is_file) {
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines_.push_back(line);
}

void Complaints::add(const toml::source_region& where, const std::string& what, std::size_t width) {
    const auto line = where.begin.line, column = where.begin.column;
    std::vector<std::string> words = printable_characters(what);  // a text may hold an escape
    // A message quotes the file: a text of a megabyte in it would hide all others.
    if (words.size() > kMostWords) {
        words.resize(kMostWords);
        words.emplace_back("...");
    }
    std::string text = fmt::format("{}: error: {}", place(where), fmt::join(words, ""));
    if (line >= 1 && line <= lines_.size())
        text += quote_line(lines_[line - 1], line, column > 0 ? column - 1 : 0, width);
    mistakes_.add(text);
}

std::string Complaints::place(const toml::source_region& where) const {
    return is_file_ ? fmt::format("{}:{}:{}", name_, where.begin.line, where.begin.column) : name_;
}

std::string_view Complaints::line(std::size_t number) const {
    return number >= 1 && number <= lines_.size() ? std::string_view(lines_[number - 1]) : "";
}

bool read_value(const Key& key, const toml::node& node, const std::string& elsewhere,
                Complaints& complaints, Value& out) {
    return ValueReader(complaints, elsewhere).read(key, node, out);
}

}  // namespace ice
