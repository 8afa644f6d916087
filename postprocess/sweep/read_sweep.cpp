// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/read_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "common/base/error.hpp"
#include "postprocess/sweep/choose_axes.hpp"
#include "postprocess/sweep/read_settings.hpp"

namespace ice::sweep {

namespace fs = std::filesystem;

namespace {

constexpr const char* kRemedy = "give the folder whose subfolders icesolve wrote";

// A folder whose summary is that of its members, which lie in it and are the runs.
bool is_ensemble(const fs::path& folder) {
    try {
        return fs::exists(folder / "summary.json") &&
               read_summary(folder / "summary.json").ensemble.has_value();
    } catch (const Error&) {
        return false;  // a run that cannot be read
    }
}

bool is_run(const fs::path& folder) {
    if (is_ensemble(folder)) return false;
    return fs::exists(folder / "summary.json") || fs::exists(folder / "case.resolved.cfg");
}

// Folders of runs below `folder`, which lie at any depth but not inside each other.
std::vector<fs::path> find_runs(const fs::path& folder) {
    std::vector<fs::path> found;
    std::error_code error;
    fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied,
                                        error),
        end;
    while (!error && it != end) {
        // a run's own folders hold no runs: the search does not go into it
        if (it->is_directory(error) && is_run(it->path())) {
            found.push_back(it->path());
            it.disable_recursion_pending();
        }
        it.increment(error);
    }
    std::sort(found.begin(), found.end());
    return found;
}

// Members of an ensemble differ by their seed: their differences are no settings.
void unite_members(std::vector<SweepRun>& runs) {
    std::map<fs::path, std::vector<SweepRun*>> ensembles;
    for (SweepRun& run : runs)
        if (is_ensemble(run.folder.parent_path()))
            ensembles[run.folder.parent_path()].push_back(&run);
    // keys that differ among the members are drawn by the ensemble: no settings of the run
    for (const auto& [folder, members] : ensembles) {
        const std::map<std::string, Setting> first = members.front()->settings;
        for (const auto& entry : first) {  // no structured binding: clang 14 captures none
            const std::string& key = entry.first;
            const bool same = std::all_of(members.begin(), members.end(), [&](const SweepRun* run) {
                return run->text(key) == entry.second.text;
            });
            if (!same && !is_seed(key))
                for (SweepRun* run : members) run->settings.erase(key);
        }
    }
}

// The first complaint of a log, else its last line; "1 mistake" is only the heading of complaints.
std::string first_error(const fs::path& log) {
    std::ifstream in(log);
    std::string last;
    for (std::string line; std::getline(in, line);) {
        if (line.empty()) continue;
        last = line;
        if (line.find("error:") != std::string::npos && !line.ends_with("mistake") &&
            !line.ends_with("mistakes"))
            break;
    }
    return last;
}

void read_outcome(const fs::path& log, SweepRun& run) {
    const fs::path file = run.folder / "summary.json";
    if (!fs::exists(file)) {
        run.fault = first_error(log);
        // without a summary the log shows why the run ended
        const bool begun = fs::exists(log) || fs::exists(run.folder / "case.resolved.cfg");
        run.status = begun ? "failed" : "not run";
        if (run.fault.empty())
            run.fault = begun ? "no summary.json: the run did not end" : "not run yet";
        return;
    }
    try {
        Summary summary = read_summary(file);
        run.status = summary.status;
        if (run.status == "completed") {
            run.summary = std::move(summary);
        } else {
            // the last warning of a failed run is the reason of its end
            const bool said = run.status == "failed" && !summary.warnings.empty();
            run.fault = said ? summary.warnings.back().text
                             : fmt::format("ended at {:g} s", summary.simulated_s);
        }
    } catch (const Error& error) {
        run.status = "unreadable";
        run.fault = error.what();
    }
    // a complaint's remedy is its second line: a row has one
    run.fault = run.fault.substr(0, run.fault.find('\n'));
}

void read_planned(const fs::path& file, Sweep& sweep) {
    const Plan plan = read_plan(file);
    sweep.title = plan.title;
    std::set<fs::path> planned;
    for (const auto& [name, values] : plan.runs) {
        // runs that failed keep their planned values, so that the table says where a sweep has gaps
        SweepRun run{name, sweep.folder / "runs" / name, {}, "", "", std::nullopt};
        run.settings = read_settings(run.folder / "case.resolved.cfg");
        // the case has numbers in SI where the plan may have "2 kn"; the plan has mesh and field
        for (const auto& entry : values) run.settings.insert(entry);
        read_outcome(sweep.folder / "logs" / (name + ".log"), run);
        planned.insert(run.folder.lexically_normal());
        sweep.runs.push_back(std::move(run));
    }
    for (const fs::path& other : find_runs(sweep.folder))
        if (!planned.contains(other.lexically_normal()))
            sweep.warnings.push_back(fs::relative(other, sweep.folder).string() +
                                     " is not in runs.toml: left out");
    sweep.planned = plan.axes;
    choose_axes(sweep, plan.axes);
}

}  // namespace

bool is_seed(const std::string& key) { return key == kSeedKey || key == kFieldSeedKey; }

bool operator<(const Setting& a, const Setting& b) {
    if (a.number && b.number) return *a.number < *b.number;
    if (a.number.has_value() != b.number.has_value()) return a.number.has_value();
    return a.text < b.text;
}

std::string SweepRun::text(const std::string& key) const {
    const auto found = settings.find(key);
    return found == settings.end() ? "" : found->second.text;
}

Sweep read_sweep(const fs::path& folder) {
    if (!fs::is_directory(folder)) throw bad_input(folder.string(), "folder not found", kRemedy);
    Sweep sweep;
    sweep.folder = folder;
    // A plan names its runs, also runs that have no folder yet; without one every run below
    // counts.
    if (fs::exists(folder / "runs.toml")) {
        read_planned(folder / "runs.toml", sweep);
    } else {
        for (const fs::path& path : find_runs(folder)) {
            SweepRun run{fs::relative(path, folder).string(),
                         path,
                         read_settings(path / "case.resolved.cfg"),
                         "",
                         "",
                         std::nullopt};
            read_outcome(path / "run.log", run);
            sweep.runs.push_back(std::move(run));
        }
        unite_members(sweep.runs);
        if (sweep.runs.empty()) throw bad_input(folder.string(), "holds no runs", kRemedy);
        choose_axes(sweep, {});
    }
    // The folder's name at least distinguishes pages of several sweeps.
    if (sweep.title.empty())
        sweep.title = "Sweep " + fs::weakly_canonical(folder).filename().string();
    return sweep;
}

}  // namespace ice::sweep
