// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/icesolve_options.hpp"

#include <fmt/format.h>

#include <tuple>

#include "common/cli/quantity_option.hpp"

namespace ice {

namespace {

// A first case, and the options of spherize for its mesh.
void declare_new(CLI::App& app, Options& o) {
    auto* fresh = app.add_option("--new", o.fresh,
                                 "Write a commented case for a hull (mesh or sphere set) and an "
                                 "ice field (.h5 or .toml); make the sphere set of a mesh and the "
                                 "field of a specification first")
                      ->type_name("HULL [FIELD]")
                      ->expected(1, 2);
    for (const char* of_run : {"--set", "--out", "--seeds", "--restart"})  // --new runs nothing
        fresh->excludes(app.get_option(of_run));
    app.add_option("-o", o.fresh_case, "With --new: the case file (default HULL-stem.cfg)")
        ->type_name("CASE.cfg")
        ->needs(fresh);
    for (const auto& [name, unit, about] :
         {std::tuple("--units", "UNIT", "unit of its file, mm, cm, m, ft or in"),
          std::tuple("--scale", "F", "metres per unit of its file"),
          std::tuple("--up", "y|z|-y|-z", "axis that points up"),
          std::tuple("--forward", "+x|-x|+y|...", "direction of the bow"),
          std::tuple("--mirror", "y", "the file holds one half of the hull")})
        app.add_option(name, o.of_mesh[name],
                       fmt::format("With --new and a mesh, as spherize {0}: {1}", name, about))
            ->type_name(unit)
            ->needs(fresh);
}

// Options of messages and checks; --json and --hash-every both write to stdout.
void declare_messages(CLI::App& app, Options& o) {
    app.add_flag("--allow-overlap", o.allow_overlap,
                 "Run a case whose bodies overlap at the start, with a warning");
    app.add_flag("--verify", o.verify,
                 "Stop at a step that loses momentum; the summary has the worst imbalance");
    app.add_option("--explain", o.explain, "Explain a case key: unit, values, default")
        ->type_name("KEY");
    app.add_flag("--print-schema", o.schema, "JSON schema of the case file");
    app.add_flag("--print-defaults", o.defaults, "A complete case with all defaults");
    app.add_flag("--no-report", o.no_report,
                 "Do not write report.html at the end; icepost report writes it later");
    app.add_flag("--json", o.json, "Print the summary as JSON on stdout")
        ->excludes(app.get_option("--hash-every"));
    app.add_flag("-q,--quiet", o.messages.quiet, "No progress, no messages but errors");
    app.add_option("--color", o.messages.colour, "Colour of messages")
        ->check(CLI::IsMember({"auto", "always", "never"}));
    app.footer(
        "Exit codes: 0 ok; 1 the run failed; 2 bad command line or case; 130 interrupted,\n"
        "checkpoint written. Ctrl-C (SIGINT) and SIGTERM finish the step first; a second "
        "one ends at once.");
}

}  // namespace

void declare_options(CLI::App& app, Options& o) {
    // The order of --help: case and folder, settings, checkpoints, ensembles, checks before a run.
    // Options that exclude each other say so here, so that the error names both.
    declare_version(app);
    app.add_option("case", o.case_file, "Case file (TOML)");
    app.add_option("--out", o.out,
                   "Run folder (default results/NAME: the case file's stem, or the name of its "
                   "folder for case.cfg)");
    app.add_flag("--overwrite", o.overwrite,
                 "Replace a run that the run folder holds; other files in it stay");
    app.add_option("--set", o.overrides, "key=value, replaces a key of the case; repeatable")
        ->allow_extra_args(false)
        ->take_all();
    app.add_option("--threads", o.threads, "Threads (default: all cores)")
        ->check(CLI::Range(1, 4096));
    app.add_option("--simd", o.simd, "Instruction set; results have the same bits on all")
        ->check(CLI::IsMember({"auto", "scalar", "sse4", "avx2", "avx512"}));
    app.add_option("--checkpoint-every", o.checkpoint_every,
                   "Write checkpoint.h5 in the run folder every T simulated seconds and at the end")
        ->type_name("T")
        ->transform(positive_quantity(Dimension::time, "2.5"));
    // by wall time: a kill then loses minutes of work, whatever a simulated second takes
    app.add_option(
           "--autosave", o.autosave,
           "Write checkpoint.h5 every T of computing time (default 5 min) and delete it when "
           "the run completes; not with --checkpoint-every")
        ->type_name("T")
        ->transform(positive_quantity(Dimension::time, "5 min"))
        ->excludes(app.get_option("--checkpoint-every"));
    app.add_option("--restart", o.restart,
                   "Resume from a checkpoint, in its folder (or --out), with the same bits; only "
                   "simulation.duration may have changed")
        ->type_name("FILE");
    auto* restart = app.get_option("--restart");
    auto* hashes =
        app.add_option("--hash-every", o.hash_every, "Print step and state hash every N steps")
            ->check(CLI::PositiveNumber);
    // an ensemble resumes its members by itself, and has no single state to hash
    app.add_option("--seeds", o.seeds,
                   "Run an ensemble of N members in turn, in seed-1, seed-2, ... of the run "
                   "folder; the same command again resumes it")
        ->type_name("N")
        ->check(CLI::Range(1, 10000))
        ->excludes(restart)
        ->excludes(hashes);
    auto* check = app.add_flag("--check", o.check,
                               "Read and build everything, run nothing: ship, ice, course, "
                               "clearance and spheres in numbers");
    app.add_option("--picture", o.picture,
                   "With --check: draw the start from the side (.svg, .png or .pdf)")
        ->type_name("FILE")
        ->needs(check);
    declare_new(app, o);
    declare_messages(app, o);
}

}  // namespace ice
