// SPDX-License-Identifier: GPL-3.0-or-later
// icesolve: case file in, run folder out. Command line only; the work is in run/run.cpp.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "common/base/error.hpp"
#include "common/base/instruction_set.hpp"
#include "common/base/parallel.hpp"
#include "common/base/version.hpp"
#include "common/cli/command_line.hpp"
#include "common/cli/console.hpp"
#include "common/cli/progress.hpp"
#include "common/cli/sibling_program.hpp"
#include "common/cli/start_threads.hpp"
#include "solver/case/case_schema.hpp"
#include "solver/case/read_case.hpp"
#include "solver/draft/draw_start.hpp"
#include "solver/draft/new_case.hpp"
#include "solver/ensemble/run_ensemble.hpp"
#include "solver/icesolve_options.hpp"
#include "solver/record/recorder.hpp"
#include "solver/record/result_text.hpp"
#include "solver/run/check_course.hpp"
#include "solver/run/check_inputs.hpp"
#include "solver/run/check_start.hpp"
#include "solver/run/describe_case.hpp"
#include "solver/run/describe_cost.hpp"
#include "solver/run/make_water.hpp"
#include "solver/run/run.hpp"
#include "solver/run/run_folder.hpp"

namespace {

// The command that resumes an interrupted run.
std::string command_to_go_on(const ice::Options& o, const std::filesystem::path& folder) {
    std::string line = ice::typed_program() + " " + ice::shell_word(o.case_file);
    // a checkpoint holds its case and refuses another: the same keys again
    for (const std::string& text : o.overrides) line += " --set " + ice::shell_word(text);
    if (o.checkpoint_every > 0.0) line += fmt::format(" --checkpoint-every {}", o.checkpoint_every);
    return line + " --restart " + ice::shell_word((folder / ice::kCheckpointName).string());
}

// The result, shortest first: the mean with its interval, then how it came about. A run that the
// disk stopped ends with an error although its files are whole: scripts must not take it for done.
// @param said  warnings that the user has seen at the start
int report(const ice::Summary& s, const ice::Options& o, const std::string& folder,
           const std::vector<ice::Warning>& said) {
    if (o.json) ice::write_data(ice::summary_text(s));
    ice::say(ice::resistance_line(s));
    ice::say(ice::describe_rules(s));
    if (const std::string line = ice::formulas_line(s); !line.empty()) ice::say(line);
    if (const std::string line = ice::energy_line(s); !line.empty()) ice::say(line);
    // a warning of the start is not repeated
    for (const ice::Warning& warning : s.warnings)
        if (std::find(said.begin(), said.end(), warning) == said.end())
            ice::say_warning(ice::with_verdict(warning));
    ice::say(fmt::format("{} s simulated in {:.1f} s ({:.1f}x real time); results in {}",
                         s.simulated_s, s.wall_s, s.simulated_s / s.wall_s, folder));
    if (s.status == "failed")
        throw ice::run_failed(
            folder,
            fmt::format("the disk is almost full: the run stopped at t = {:g} s, all up to there "
                        "is kept",
                        s.simulated_s),
            "make room, then go on with\n    " + command_to_go_on(o, folder));
    if (s.status != "interrupted") return 0;
    ice::say_warning(fmt::format("interrupted at t = {:g} s; go on with\n  {}", s.simulated_s,
                                 command_to_go_on(o, folder)));
    return static_cast<int>(ice::ExitCode::interrupted);
}

// The report belongs to the post-processor; the solver knows nothing of it but its command. The
// run is complete without it: a failure here is a warning.
void write_report(const std::filesystem::path& folder) {
    const auto code = ice::run_sibling("icepost", {"-q", "report", folder.string()});
    if (code == 0)
        ice::say(fmt::format("report in {}", (folder / "report.html").string()));
    else
        ice::say_warning(fmt::format("no report: {}; try icepost report {}",
                                     code ? fmt::format("icepost ended with code {}", *code)
                                          : std::string("icepost does not lie beside icesolve"),
                                     ice::shell_word(folder.string())));
}

// --out wins; a resumed run continues in the folder of its checkpoint.
std::filesystem::path folder_of_run(const ice::Options& o) {
    if (!o.out.empty()) return o.out;
    if (!o.restart.empty()) {
        const auto parent = std::filesystem::path(o.restart).parent_path();
        return parent.empty() ? "." : parent;
    }
    return ice::default_run_folder(o.case_file);
}

// Allowed content of the run folder: none, a run to replace, or the resumed run.
ice::Existing may_exist(const ice::Options& o, const std::filesystem::path& folder) {
    std::error_code ignored;
    if (!o.restart.empty() &&
        std::filesystem::equivalent(folder, std::filesystem::absolute(o.restart).parent_path(),
                                    ignored))
        return ice::Existing::go_on;
    return o.overwrite ? ice::Existing::replace : ice::Existing::refuse;
}

// A run that is continued in its folder replaces the rows from its checkpoint on. Where the folder
// holds a longer one, those beyond the new end would be lost.
void refuse_to_shorten(const ice::Options& o, const ice::World& world) {
    const std::filesystem::path folder = folder_of_run(o);
    if (o.overwrite || may_exist(o, folder) != ice::Existing::go_on ||
        !std::filesystem::exists(folder / "summary.json"))
        return;
    const double held = ice::read_summary(folder / "summary.json").simulated_s;
    const double end = world.parameters.duration;
    if (end + world.parameters.time_step > held) return;
    throw ice::bad_input(folder.string(),
                         fmt::format("holds a run up to {:g} s, and this one ends at {:g} s: its "
                                     "rows beyond would be lost",
                                     held, end),
                         "add --overwrite to shorten it, or --out for another folder");
}

// A run that ends with an error keeps its files; the error says so, with the command that resumes.
ice::Summary run_or_tell(ice::World& world, const ice::RunOptions& options, const ice::Options& o) {
    try {
        return ice::run(world, options);
    } catch (const ice::Error& error) {
        const std::filesystem::path& folder = options.folder;
        std::string rest = fmt::format("\n  what was written is kept: icepost report {}",
                                       ice::shell_word(folder.string()));
        if (std::filesystem::exists(folder / ice::kCheckpointName))
            rest += "\n  go on from the last checkpoint with\n    " + command_to_go_on(o, folder);
        throw ice::Error(error.code(), "", error.what() + rest, "");
    }
}

void append(const std::vector<ice::Warning>& more, std::vector<ice::Warning>& warnings) {
    warnings.insert(warnings.end(), more.begin(), more.end());
}

void say_warnings(const std::vector<ice::Warning>& warnings) {
    for (const ice::Warning& warning : warnings) ice::say_warning(ice::with_verdict(warning));
}

// Before the run, because the case alone does not show it.
void say_forecasts(const std::vector<ice::Warning>& warnings) {
    for (const ice::Warning& warning : warnings)
        ice::say_warning(warning.affects_mean
                             ? ice::with_verdict(warning)
                             : warning.text + " (the run measures the effect on the mean)");
}

// All that --check does.
int describe(const ice::Options& o, ice::World& world, bool good) {
    const std::string ice = world.edge.has_sheet()
                                ? "level ice"
                                : fmt::format("{} floes", world.scene.bodies.size() - 1);
    ice::say(fmt::format("{}: {}, {}\n{}", o.case_file, good ? "good" : "runs, with warnings", ice,
                         ice::describe_case(world)));
    if (!o.picture.empty()) ice::draw_start(world, o.picture);
    ice::say(ice::describe_cost(world));  // takes some steps, so the picture is drawn before
    if (!o.picture.empty()) ice::say(fmt::format("wrote {}", o.picture));
    return 0;
}

// Warnings of inputs. A number in a wrong unit may be the cause of an error, or of a scene that
// takes hours to build: it is named before.
std::vector<ice::Warning> look_at_inputs(const ice::Case& parameters) {
    std::vector<ice::Warning> warnings = ice::check_inputs(parameters);
    say_forecasts(warnings);
    return warnings;
}

// Warnings of bodies and water.
std::vector<ice::Warning> look_at_start(ice::World& world, const ice::Options& o, bool resumed) {
    std::vector<ice::Warning> warnings;
    // of a resumed run the start is long past
    if (!resumed) warnings = ice::check_start(world, o.allow_overlap);
    append(ice::check_water(world.parameters, world.scene), warnings);
    return warnings;
}

// Everything that can be wrong with a case is found before the run folder is claimed, so that a
// slip in a key neither leaves an empty folder nor removes an older run.
int run_case(const ice::Options& o, const std::string& command_line) {
    ice::set_thread_count(o.threads);
    ice::start_threads();
    ice::set_instruction_set(o.simd);
    const ice::Case parameters = ice::read_case(o.case_file, o.overrides);
    ice::require_open_files(parameters);
    const std::vector<ice::Warning> inputs = look_at_inputs(parameters);
    ice::World world = ice::build_world(parameters);
    const std::vector<ice::Warning> course = ice::check_course(world);  // before the ice moves
    std::optional<ice::SavedRun> saved;
    // onto the scene that the case builds: a checkpoint holds state, no shapes
    if (!o.restart.empty()) saved.emplace(ice::read_checkpoint(o.restart, world));
    ice::SavedRun* going_on = saved ? &*saved : nullptr;
    std::vector<ice::Warning> warnings = look_at_start(world, o, saved.has_value());
    std::vector<ice::Warning> of_start = inputs;  // for the summary
    append(warnings, of_start);
    append(course, warnings);
    // said now, while the case can be changed; at the end the summary has the verdict
    if (const auto few = ice::warn_of_short_averages(world)) warnings.push_back(*few);
    if (o.check) {
        say_forecasts(warnings);
        return describe(o, world, warnings.empty() && inputs.empty());
    }
    refuse_to_shorten(o, world);
    const ice::RunFolder claimed(
        folder_of_run(o), may_exist(o, folder_of_run(o)),
        {ice::typed_program() + command_line.substr(command_line.find(' ')) + " --overwrite",
         command_to_go_on(o, folder_of_run(o))});
    const std::filesystem::path& folder = claimed.path();
    ice::log_to_file(folder / "run.log", going_on != nullptr);
    ice::say(fmt::format("icesolve {} ({}): {}", ice::version(), ice::git_commit(), command_line));
    say_forecasts(warnings);
    append(inputs, warnings);  // said before the scene was built
    ice::catch_interrupts();
    ice::Progress progress("icesolve", o.messages.quiet);
    const ice::Timer timer;
    const double begun = world.time;
    const auto watch = [&](double done, const ice::World& w) {
        progress.update(done, fmt::format("{:.1f}x real time", (w.time - begun) / timer.seconds()));
        if (o.hash_every > 0 && w.steps % o.hash_every == 0)
            ice::write_data(
                fmt::format("{} {:016x}\n", w.steps, ice::state_hash(w.scene, w.constraints)));
        return !ice::interrupted();
    };
    const ice::Summary summary = run_or_tell(world,
                                             {folder, command_line, o.checkpoint_every, going_on,
                                              of_start, o.verify, watch, course, o.autosave},
                                             o);
    progress.finish();
    const int code = report(summary, o, folder.string(), warnings);
    if (!o.no_report) write_report(folder);
    return code;
}

// Options that every member of an ensemble gets as they were given.
std::vector<std::string> member_words(const ice::Options& o) {
    std::vector<std::string> words;
    if (o.simd != "auto") words.insert(words.end(), {"--simd", o.simd});
    if (o.messages.colour != "auto") words.insert(words.end(), {"--color", o.messages.colour});
    if (o.threads > 0) words.insert(words.end(), {"--threads", std::to_string(o.threads)});
    if (o.checkpoint_every > 0.0)
        words.insert(words.end(), {"--checkpoint-every", fmt::format("{}", o.checkpoint_every)});
    else if (o.autosave != ice::Options().autosave)
        words.insert(words.end(), {"--autosave", fmt::format("{}", o.autosave)});
    for (const auto& [given, word] :
         {std::pair(o.allow_overlap, "--allow-overlap"), std::pair(o.verify, "--verify"),
          std::pair(o.no_report, "--no-report"), std::pair(o.messages.quiet, "-q")})
        if (given) words.emplace_back(word);
    return words;
}

// The command of an ensemble in a folder, which also resumes it.
std::string command_of_seeds(const ice::Options& o, const std::filesystem::path& folder) {
    std::vector<std::string> words{o.case_file, "--seeds", std::to_string(o.seeds), "--out",
                                   folder.string()};
    for (const std::string& text : o.overrides) words.insert(words.end(), {"--set", text});
    for (const std::string& word : member_words(o)) words.push_back(word);
    std::string line = ice::typed_program();
    for (const std::string& word : words) line += " " + ice::shell_word(word);
    return line;
}

// An ensemble: each member is a program of its own, so that one that fails takes none with it.
int run_seeds(const ice::Options& o, const std::string& command_line) {
    const auto folder = folder_of_run(o);
    if (o.overwrite) {  // a case that cannot start removes nothing
        ice::World world = ice::build_world(ice::read_case(o.case_file, o.overrides));
        ice::check_start(world, o.allow_overlap);
    }
    const auto [summary, code] = ice::run_ensemble(
        {o.case_file, o.overrides, o.seeds, folder, o.overwrite, member_words(o), command_line,
         command_of_seeds(o, (folder / "").parent_path().string() + "-seeds"),
         command_of_seeds(o, folder) + " --overwrite"});
    if (summary.ensemble) {
        if (o.json) ice::write_data(ice::summary_text(summary));
        ice::say(ice::ensemble_line(summary));
        ice::say(ice::describe_rules(summary));
        say_warnings(summary.warnings);
        ice::say(fmt::format("results in {}", folder.string()));
    }
    if (code == static_cast<int>(ice::ExitCode::interrupted))
        ice::say_warning("interrupted; go on with the members that are missing with\n  " +
                         command_of_seeds(o, folder));
    return code;
}

int run_icesolve(const ice::Options& o, const std::string& command_line) {
    // the short answers first: they need no case
    if (!o.explain.empty()) {
        ice::write_data(ice::explain_key(ice::case_schema(), o.explain));
    } else if (o.schema) {
        ice::write_data(ice::json_schema(ice::case_schema()));
    } else if (o.defaults) {
        ice::write_data(ice::default_text(ice::case_schema()));
    } else if (!o.fresh.empty()) {
        std::vector<std::string> of_mesh;
        for (const auto& [name, value] : o.of_mesh)
            if (!value.empty()) of_mesh.insert(of_mesh.end(), {name, value});
        const auto file =
            ice::write_new_case({o.fresh[0], o.fresh.size() > 1 ? o.fresh[1] : std::string(),
                                 o.fresh_case, std::move(of_mesh)});
        ice::say(
            fmt::format("wrote {}: look at the lines marked CHECK, then\n  icesolve {} --check",
                        file.string(), ice::shell_word(file.string())));
    } else if (o.case_file.empty()) {
        throw ice::bad_input("", "no case file given", "icesolve --help lists its options");
    } else if (o.seeds > 0 && !o.check) {
        return run_seeds(o, command_line);
    } else {
        return run_case(o, command_line);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Simulates ice pieces sliding and rotating around a ship: case in, run folder out.",
        "icesolve");
    ice::Options o;
    ice::declare_options(app, o);
    return ice::run_command_line(
        app, argc, argv, o.messages, "use fewer floes or larger spheres",
        [&](const std::string& command_line) { return run_icesolve(o, command_line); });
}
