// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/ensemble/run_ensemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "common/base/error.hpp"
#include "common/base/part_file.hpp"
#include "common/base/version.hpp"
#include "common/cli/console.hpp"
#include "common/cli/sibling_program.hpp"
#include "common/toml/input_file.hpp"
#include "solver/case/read_case.hpp"
#include "solver/ensemble/average_members.hpp"
#include "solver/ensemble/member_field.hpp"
#include "solver/run/run_folder.hpp"
#include "solver/scene/build_scene.hpp"

namespace ice {

namespace {

namespace fs = std::filesystem;

// Jitter of members whose case has none, in radii of the smallest ice sphere [-]: two floes then
// come nearer by no more than a start tolerates. Larger could make floes that touch overlap; much
// smaller leaves members alike for their first contacts.
constexpr double kJitter = 0.01;

// Where no field changes with the seed and the case moves no floe, jitter makes the difference.
// It is too small to change the field, but the motion is chaotic: after a few impacts the histories
// differ.
double default_jitter(const Case& parameters) {
    const Scene scene = build_scene(parameters);
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < scene.shapes.size(); ++k)
        for (const double radius : scene.shapes[k].radius) smallest = std::min(smallest, radius);
    return kJitter * smallest;
}

// The overrides of a member, after those of the case.
std::vector<std::string> member_overrides(const EnsembleOptions& o, const Case& parameters,
                                          std::int64_t seed, MemberFields& made) {
    std::vector<std::string> out = o.overrides;
    out.push_back(fmt::format("simulation.seed={}", seed));
    const auto fields = made.overrides(seed);
    out.insert(out.end(), fields.begin(), fields.end());
    // the sizes of cracks in level ice come from the seed
    if (fields.empty() && parameters.jitter == 0.0 && !parameters.has_level_ice())
        out.push_back(fmt::format("simulation.jitter={:g}", default_jitter(parameters)));
    return out;
}

// The case of a run folder as it was resolved, without the two comments above it.
std::string resolved_case_in(const fs::path& folder) {
    std::string text = read_input_text(folder / "case.resolved.cfg", "resolved case", ".cfg");
    for (int line = 0; line < 2; ++line) text.erase(0, text.find('\n') + 1);
    return text;
}

// A finished member of this ensemble, if the folder holds one.
std::optional<Summary> finished_member(const EnsembleOptions& o, const fs::path& folder,
                                       const std::vector<std::string>& overrides) {
    // an interrupted member is resumed from its checkpoint (run_member), not kept
    if (!fs::exists(folder / "summary.json")) return std::nullopt;
    Summary summary = read_summary(folder / "summary.json");
    if (summary.status != "completed") return std::nullopt;
    // all keys are in it; options such as --threads change no result
    if (resolved_case_in(folder) != read_case(o.case_file, overrides).resolved)
        throw bad_input(folder.string(), "holds a member of another case",
                        "choose another folder with --out, or compute all anew with --overwrite");
    return summary;
}

// Runs one member to its end. @return icesolve's exit code
int run_member(const EnsembleOptions& o, const fs::path& folder,
               const std::vector<std::string>& overrides) {
    std::vector<std::string> words{o.case_file};
    for (const std::string& text : overrides) words.insert(words.end(), {"--set", text});
    words.insert(words.end(), o.member_words.begin(), o.member_words.end());
    // of a member that was interrupted
    const fs::path checkpoint = folder / kCheckpointName;
    if (fs::exists(checkpoint))
        words.insert(words.end(), {"--restart", checkpoint.string()});
    else
        words.insert(words.end(), {"--out", folder.string(), "--overwrite"});
    const auto code = run_sibling("icesolve", words);
    if (!code)
        throw run_failed("icesolve", "cannot be started for a member of the ensemble",
                         "install it whole, with all programs in one folder");
    // a member may end before it can catch the signal
    return interrupted() && *code != 0 ? static_cast<int>(ExitCode::interrupted) : *code;
}

void write_ensemble(const EnsembleOptions& o, const std::vector<Member>& members,
                    const std::string& status, Summary& summary) {
    summary = average_members(members);
    summary.status = status;
    summary.command_line = o.command_line;
    write_text_file(o.folder / "summary.json", summary_text(summary));
}

// Makes room in the folder, which this program has locked: for the same ensemble nothing need go.
void make_room(const EnsembleOptions& o) {
    if (!o.overwrite) {
        if (holds_single_run(o.folder))
            throw bad_input(o.folder.string(), "holds a single run",
                            "run the ensemble beside it with\n    " + o.command_beside +
                                "\n  or replace that run with\n    " + o.command_replace);
        return;
    }
    remove_run(o.folder);
    std::vector<fs::path> members;
    for (const auto& entry : fs::directory_iterator(o.folder))
        if (is_member_folder(entry.path())) members.push_back(entry.path());
    for (const fs::path& member : members) {
        const RunFolder emptied(member, Existing::replace);
    }
}

}  // namespace

EnsembleResult run_ensemble(const EnsembleOptions& o) {
    const Case parameters = read_case(o.case_file, o.overrides);
    // The lock is taken before anything is removed or written: a second ensemble in this folder
    // stops here.
    const RunFolder claimed(o.folder, Existing::go_on);
    make_room(o);
    log_to_file(o.folder / "run.log", !o.overwrite);
    say(fmt::format("icesolve {} ({}): {}", version(), git_commit(), o.command_line));
    catch_interrupts();
    const std::int64_t first = std::max(1, parameters.seed);
    MemberFields fields(parameters, first, o.folder / "fields");
    std::vector<Member> members;
    EnsembleResult result;
    for (std::int64_t seed = first; seed < first + o.members && result.code == 0; ++seed) {
        const fs::path folder = o.folder / fmt::format("seed-{}", seed);
        const auto overrides = member_overrides(o, parameters, seed, fields);
        if (interrupted()) {
            result.code = static_cast<int>(ExitCode::interrupted);
            break;
        }
        // The same command again keeps members whose case has not changed and runs the others.
        std::optional<Summary> summary = finished_member(o, folder, overrides);
        say(fmt::format("seed {}, member {} of {}{}", seed, seed - first + 1, o.members,
                        summary ? ": finished before, kept" : ""));
        if (!summary) {
            result.code = run_member(o, folder, overrides);
            if (result.code != 0) break;
            summary = read_summary(folder / "summary.json");
        }
        members.push_back({seed, std::move(*summary)});
        // after each member: the results so far can be read while the next one runs
        write_ensemble(
            o, members,
            members.size() < static_cast<std::size_t>(o.members) ? "interrupted" : "completed",
            result.summary);
    }
    if (members.empty()) result.summary.status = "failed";
    return result;
}

}  // namespace ice
