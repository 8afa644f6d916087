// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sensitivity/read_study.hpp"

#define TOML_HEADER_ONLY 0  // Debian's libtomlplusplus.so holds the version that throws
#include <toml++/toml.h>

#include <algorithm>

#include "common/base/error.hpp"
#include "common/formulas/formula_band.hpp"

namespace ice::sensitivity {

namespace {

constexpr const char* kRemedy =
    "give the folder that the workflow made: snakemake ... --config sensitivity=CASE.cfg";

std::string text_of(const toml::table& table, const char* key) {
    return table[key].value_or<std::string>("");
}

// entries of a repeated table, none where it is missing
template <class Use>
void for_each(const toml::table& table, const char* name, const Use& use) {
    if (const toml::array* rows = table[name].as_array())
        for (const toml::node& row : *rows)
            if (const toml::table* entry = row.as_table()) use(*entry);
}

Seeds& find_or_add(std::vector<Seeds>& values, const std::string& label) {
    const auto found = std::find_if(values.begin(), values.end(),
                                    [&](const Seeds& e) { return e.label == label; });
    if (found != values.end()) return *found;
    return values.emplace_back(Seeds{label, {}, {}});
}

void add_run(const toml::table& entry, Study& study) {
    const std::string name = text_of(entry, "name"), input = text_of(entry, "input");
    const auto run = std::find_if(study.runs.runs.begin(), study.runs.runs.end(),
                                  [&](const sweep::SweepRun& r) { return r.name == name; });
    Seeds* values = &study.base;
    // a run without an input is the case itself
    if (!input.empty()) {
        const auto owner = std::find_if(study.inputs.begin(), study.inputs.end(),
                                        [&](const Input& i) { return i.name == input; });
        if (owner == study.inputs.end()) return;
        values = &find_or_add(owner->values, text_of(entry, "label"));
    }
    // planned, but not run yet or failed: the input keeps its place without a value
    if (run == study.runs.runs.end() || !run->summary) return;
    values->resistance.push_back(run->summary->resistance.mean);
    values->half.push_back(run->summary->resistance.ci95);
    study.dimension = run->summary->dimension;
    if (input.empty()) study.level_ice = is_level_ice(run->summary->ice);
}

}  // namespace

Study read_study(const std::filesystem::path& folder) {
    const auto plan = folder / "runs.toml";
    if (std::filesystem::is_directory(folder) && !std::filesystem::exists(plan))
        throw bad_input(folder.string(), "has no runs.toml", kRemedy);
    Study study;
    study.runs = sweep::read_sweep(folder);  // complains about anything but TOML
    study.title = study.runs.title;
    // Parsed a second time, for the tables that a sweep does not have.
    const toml::table table = toml::parse_file(plan.string());
    for_each(table, "input", [&](const toml::table& entry) {
        study.inputs.push_back(
            {text_of(entry, "name"), text_of(entry, "base"), text_of(entry, "source"), {}});
    });
    if (study.inputs.empty())
        throw bad_input(plan.string(), "plans a sweep, not a sensitivity study",
                        "icepost sweep " + folder.string() + " makes its page");
    for_each(table, "left_out", [&](const toml::table& entry) {
        study.left_out.emplace_back(text_of(entry, "name"), text_of(entry, "why"));
    });
    for_each(table, "run", [&](const toml::table& entry) { add_run(entry, study); });
    // every difference is against the case itself
    if (study.base.resistance.empty())
        throw bad_input(folder.string(), "no run of the case itself has a result",
                        "let the workflow go on: the same command computes the missing runs");
    return study;
}

}  // namespace ice::sensitivity
