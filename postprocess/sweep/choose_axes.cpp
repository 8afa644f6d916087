// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/choose_axes.hpp"

#include <algorithm>
#include <set>

namespace ice::sweep {

namespace {

std::set<std::string> values_of(const Sweep& sweep, const std::string& key) {
    std::set<std::string> values;
    for (const SweepRun& run : sweep.runs)
        if (!run.settings.empty()) values.insert(run.text(key));
    return values;
}

std::vector<std::string> varying_keys(const Sweep& sweep) {
    std::set<std::string> keys;
    for (const SweepRun& run : sweep.runs)
        for (const auto& [key, setting] : run.settings) keys.insert(key);
    std::vector<std::string> varying;
    for (const std::string& key : keys)
        if (!is_seed(key) && values_of(sweep, key).size() > 1) varying.push_back(key);
    return varying;
}

// Curves run along numbers: text such as a mesh has no place on an axis.
bool all_numbers(const Sweep& sweep, const std::string& key) {
    return std::all_of(sweep.runs.begin(), sweep.runs.end(), [&](const SweepRun& run) {
        const auto found = run.settings.find(key);
        return found == run.settings.end() || found->second.number || !run.summary;
    });
}

std::string choose_x(const Sweep& sweep, const std::vector<std::string>& keys) {
    std::string best;
    std::size_t most = 1;
    // the speed if it varies, else the number with the most values
    for (const std::string& key : keys) {
        const std::size_t count = values_of(sweep, key).size();
        if (count < 2 || !all_numbers(sweep, key)) continue;
        if (key == kSpeedKey) return key;
        if (count > most) {
            most = count;
            best = key;
        }
    }
    return best;
}

bool is_tied(const Sweep& sweep, const std::string& key, const std::string& x) {
    std::map<std::string, std::string> value_at;
    // tied: each value of x has one value of this key, as a field made for each speed
    for (const SweepRun& run : sweep.runs) {
        if (run.settings.empty()) continue;
        const auto [entry, added] = value_at.emplace(run.text(x), run.text(key));
        if (!added && entry->second != run.text(key)) return false;
    }
    return true;
}

}  // namespace

void choose_axes(Sweep& sweep, const std::vector<std::string>& planned) {
    sweep.axes = planned.empty() ? varying_keys(sweep) : planned;
    // Seeds are repetitions, no axis; a planned axis with one value run so far draws
    // no curve.
    std::erase_if(sweep.axes, [&](const std::string& key) {
        return is_seed(key) || values_of(sweep, key).size() < 2;
    });
    sweep.x = choose_x(sweep, sweep.axes);
    if (sweep.x.empty() || !planned.empty()) return;
    // a key that follows x would make a curve of each point: it is named beside x, and no axis
    const auto tied = std::stable_partition(
        sweep.axes.begin(), sweep.axes.end(),
        [&](const std::string& key) { return key == sweep.x || !is_tied(sweep, key, sweep.x); });
    sweep.tied.assign(tied, sweep.axes.end());
    sweep.axes.erase(tied, sweep.axes.end());
}

}  // namespace ice::sweep
