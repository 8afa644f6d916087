// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/read_settings.hpp"

#define TOML_HEADER_ONLY 0  // Debian's library holds the code
#include <fmt/format.h>
#include <toml++/toml.h>

#include <sstream>

#include "common/base/error.hpp"

namespace ice::sweep {

namespace {

// Numbers as "0.1", not with all digits, also in lists; 1 and 1.0 agree.
std::string text_of(const toml::node& node) {
    if (const auto text = node.value_exact<std::string>()) return *text;
    // the shortest digits that give the number again: no two numbers share a text
    if (const auto number = node.value<double>(); node.is_number() && number)
        return fmt::format("{}", *number);
    if (const toml::array* list = node.as_array()) {
        std::string text;
        for (const toml::node& item : *list) text += (text.empty() ? "" : ", ") + text_of(item);
        return "[" + text + "]";
    }
    std::ostringstream text;
    node.visit([&](const auto& n) { text << n; });
    return text.str();
}

Setting make_setting(const toml::node& node) {
    return {text_of(node), node.is_number() ? node.value<double>() : std::nullopt};
}

void flatten(const toml::table& table, const std::string& prefix,
             std::map<std::string, Setting>& out) {
    // nested tables as dotted keys; a single [[floes]] without a number, several with theirs
    for (const auto& [name, node] : table) {
        const std::string key = prefix + std::string(name.str());
        const toml::array* list = node.as_array();
        if (const toml::table* inner = node.as_table()) {
            flatten(*inner, key + ".", out);
        } else if (list != nullptr && !list->empty() && list->is_array_of_tables()) {
            for (std::size_t k = 0; k < list->size(); ++k)
                flatten(*(*list)[k].as_table(),
                        list->size() == 1 ? key + "." : fmt::format("{}.{}.", key, k + 1), out);
        } else {
            out[key] = make_setting(node);
        }
    }
}

class PlanReader {
public:
    explicit PlanReader(const std::filesystem::path& file) : file_(file) {}

    Plan read() const {
        toml::table table;
        try {
            table = toml::parse_file(file_.string());
        } catch (const toml::parse_error& error) {
            throw fault(error.source(), std::string(error.description()));
        }
        Plan plan;
        plan.title = table["title"].value_or<std::string>("");
        // Title and axes may be missing: a plan written by hand has only its runs. A run without a
        // name has no folder, so it is an error.
        if (const toml::array* axes = table["axes"].as_array())
            for (const toml::node& axis : *axes) plan.axes.push_back(text(axis, "axes"));
        const toml::array* runs = table["run"].as_array();
        if (runs == nullptr || runs->empty()) throw fault(table.source(), "plans no [[run]]");
        for (const toml::node& node : *runs) {
            const toml::table* run = node.as_table();
            if (run == nullptr || run->get("name") == nullptr)
                throw fault(node.source(), "a run has no name");
            plan.runs.push_back({text(*run->get("name"), "name"), {}});
            if (const toml::table* values = (*run)["values"].as_table())
                for (const auto& [key, value] : *values)
                    plan.runs.back().values[std::string(key.str())] = make_setting(value);
        }
        return plan;
    }

private:
    std::string text(const toml::node& node, const char* key) const {
        const auto value = node.value<std::string>();
        if (!value) throw fault(node.source(), fmt::format("{} is no text", key));
        return *value;
    }

    Error fault(const toml::source_region& at, const std::string& what) const {
        return bad_input(fmt::format("{}:{}:{}", file_.string(), at.begin.line, at.begin.column),
                         what, "let the workflow write it again, or remove it");
    }

    std::filesystem::path file_;
};

}  // namespace

Plan read_plan(const std::filesystem::path& file) { return PlanReader(file).read(); }

std::map<std::string, Setting> read_settings(const std::filesystem::path& resolved_case) {
    std::map<std::string, Setting> out;
    try {
        flatten(toml::parse_file(resolved_case.string()), "", out);
    } catch (const toml::parse_error&) {
        // A resolved case that cannot be read makes a run without settings, not a sweep without a
        // page.
        return {};
    }
    // title and output change no result
    std::erase_if(out, [](const auto& entry) {
        return entry.first == "title" || entry.first.starts_with("output.");
    });
    return out;
}

}  // namespace ice::sweep
