// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/read/read_run_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "common/base/error.hpp"

namespace ice::read {

namespace fs = std::filesystem;

namespace {

constexpr const char* kRemedy = "give the folder that icesolve wrote, e.g. results/channel";

fs::path folder_of(const fs::path& path) {
    if (!fs::exists(path)) throw bad_input(path.string(), "run folder not found", kRemedy);
    if (fs::is_directory(path)) return path;
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

bool holds_run(const fs::path& folder) {
    return fs::exists(folder / "run.h5") || fs::exists(folder / "run.h5.part");
}

// A case, or another text, in place of a run folder. icesolve writes the run of a case to
// results/NAME: the case's stem, or its folder's name where the stem is "case".
[[noreturn]] void refuse_file(const fs::path& file) {
    std::string name = file.stem().string();
    if (name == "case")
        name = fs::absolute(file).lexically_normal().parent_path().filename().string();
    const fs::path run = fs::path("results") / name;
    throw bad_input(file.string(), "is a file, not a run folder",
                    holds_run(run) ? "its run is in " + run.string() : kRemedy);
}

// the remedy for a folder that is none of a run: the runs one level below
std::string find_runs_in(const fs::path& folder) {
    std::vector<std::string> runs;
    std::error_code unreadable;
    for (const auto& entry : fs::directory_iterator(folder, unreadable))
        if (fs::exists(entry.path() / "run.h5")) runs.push_back(entry.path().string());
    if (runs.empty()) return kRemedy;
    std::sort(runs.begin(), runs.end());
    return fmt::format("give one of the runs in it, e.g. {}; icepost sweep {} shows them all",
                       runs.front(), folder.string());
}

}  // namespace

RunFolder read_run_folder(const fs::path& path) {
    RunFolder run;
    run.path = folder_of(path);
    const fs::path whole = run.path / "run.h5", part = run.path / "run.h5.part";
    if (!holds_run(run.path)) {
        if (!fs::is_directory(path)) refuse_file(path);
        throw bad_input(run.path.string(), "holds no run.h5", find_runs_in(run.path));
    }
    try {
        run.data = read_run(fs::exists(whole) ? whole : part);
    } catch (const Error&) {  // the run may just have ended
        if (!fs::exists(whole) || fs::exists(part)) throw;
        run.data = read_run(whole);
    }
    if (fs::exists(run.path / "summary.json"))
        run.summary = read_summary(run.path / "summary.json");
    return run;
}

fs::path find_summary(const fs::path& path) {
    if (!fs::exists(path)) throw bad_input(path.string(), "run folder not found", kRemedy);
    if (path.extension() == ".cfg" || path.extension() == ".toml") refuse_file(path);
    fs::path file = fs::is_directory(path) ? path / "summary.json" : path;
    if (fs::exists(file)) return file;
    const fs::path folder = file.parent_path();
    if (!fs::exists(folder / "run.h5.part") && !fs::exists(folder / "run.h5"))
        throw bad_input(path.string(), "holds no summary.json and no run.h5", kRemedy);
    // the folder is the right one: the remedy depends on its files
    std::string remedy =
        fmt::format("icepost report {} shows the part that is there", folder.string());
    if (fs::exists(folder / "checkpoint.h5"))
        remedy += fmt::format("; icesolve CASE.cfg --restart {} goes on with the run",
                              (folder / "checkpoint.h5").string());
    throw bad_input(path.string(), "holds no summary.json: the run still goes on, or was killed",
                    remedy);
}

Summary read_with_members(const fs::path& path) {
    const fs::path file = find_summary(path);
    Summary summary = read_summary(file);
    if (!summary.ensemble) return summary;
    const std::vector<Warning> shared = summary.warnings;
    for (const std::int64_t seed : summary.ensemble->seeds) {
        const fs::path member = file.parent_path() / fmt::format("seed-{}", seed) / "summary.json";
        if (!fs::exists(member)) continue;
        Summary own = read_summary(member);
        for (Warning& w : own.warnings) {
            const auto known = [&](const Warning& other) {
                return other.text == w.text || other.text.ends_with(": " + w.text);
            };
            if (!w.affects_mean.value_or(false) || std::any_of(shared.begin(), shared.end(), known))
                continue;
            w.text = fmt::format("seed {}: {}", seed, w.text);
            summary.warnings.push_back(std::move(w));
        }
    }
    return summary;
}

}  // namespace ice::read
