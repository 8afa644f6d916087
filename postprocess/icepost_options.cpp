// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/icepost_options.hpp"

#include "common/cli/quantity_option.hpp"

namespace ice {

namespace {

CLI::App* add_command(CLI::App& app, PostOptions& o, const char* name, const char* text) {
    CLI::App* sub = app.add_subcommand(name, text)->fallthrough();
    sub->add_option("RUN", o.run, "run folder made by icesolve")->required();
    return sub;
}

CLI::App* add_folder_command(CLI::App& app, PostOptions& o, const char* name, const char* text,
                             const char* folder) {
    CLI::App* sub = app.add_subcommand(name, text)->fallthrough();
    sub->add_option("DIR", o.run, folder)->required();
    sub->add_option("-o,--out", o.out, "another file");
    return sub;
}

void add_formula_options(CLI::App& sub, PostOptions& o) {
    sub.add_option("--coefficients", o.coefficients,
                   "coefficients of the component formula (icepost fit), in place of Jeong's");
    sub.add_option(
           "--flexural-strength", o.flexural_strength,
           "flexural strength of level ice, for the formulas (default: the case's, or 500 kPa)")
        ->transform(positive_quantity(Dimension::pressure, "500 kPa"));
}

void declare_runs(CLI::App& app, PostOptions& o, PostCommands& c) {
    // All commands share one set of options: only one of them runs, and names mean the same in
    // each.
    c.report = add_command(app, o, "report", "write RUN/report.html, one file that opens anywhere");
    c.report->add_option("-o,--out", o.out, "another file");
    c.report
        ->add_option("--frames", o.frames,
                     "largest number of frames in the 3D playback, evenly chosen")
        ->capture_default_str()
        ->check(CLI::Range(2, 1000000));
    add_formula_options(*c.report, o);
    c.view = add_command(app, o, "view", "draw hull and ice at one instant");
    c.view->add_option("--time", o.time, "the frame nearest to this time [s]")
        ->required()
        ->transform(finite_quantity(Dimension::time, "2.5"));
    c.view->add_option("--from", o.from, "below, top, side (starboard), port, front or quarter")
        ->check(CLI::IsMember({"below", "top", "side", "port", "front", "quarter"}));
    c.view->add_option("-o,--out", o.out, "the picture: .svg, .png or .pdf")->required();
    c.plot = add_command(app, o, "plot",
                         "draw histories, tracked floes' paths and their forces in one picture");
    c.plot->add_option("-o,--out", o.out, "the picture: .svg, .png or .pdf (default RUN/plot.svg)");
    c.table = app.add_subcommand("table", "compare runs, a line each")->fallthrough();
    c.table->add_option("RUN", o.runs, "run folders made by icesolve")->required();
    c.table->add_flag("--csv", o.csv, "comma-separated, all digits");
}

void declare_sweeps(CLI::App& app, PostOptions& o, PostCommands& c) {
    // Folders of many runs; output is beside the runs unless -o says otherwise.
    c.sweep =
        add_folder_command(app, o, "sweep", "write DIR/sweep.html, resistance curves of many runs",
                           "folder of run folders");
    c.sweep->add_option("--svg", o.svg,
                        "also write the first chart, resistance against speed: .svg, .png or .pdf");
    c.sweep->add_flag("--markdown", o.markdown, "also print the points as tables in Markdown");
    add_formula_options(*c.sweep, o);
    c.fit = add_folder_command(app, o, "fit",
                               "fit the component formula to a sweep: DIR/coefficients.toml",
                               "folder of run folders");
    c.fit->add_option("--name", o.name, "name of the ship (default: the sweep's title)");
    c.fit
        ->add_option("--flexural-strength", o.flexural_strength,
                     "flexural strength of level ice in the sweep")
        ->transform(positive_quantity(Dimension::pressure, "500 kPa"));
    c.hv = add_folder_command(app, o, "hv", "write DIR/hv.html, attainable speed against thickness",
                              "folder of run folders over speed and thickness");
    c.hv->add_option("--thrust", o.thrust, "TOML file with [[thrust]] curves");
    c.hv->add_option("--svg", o.svg, "also write the chart: .svg, .png or .pdf");
    c.hv->add_option("--csv", o.csv_file, "also write the points as CSV");
    add_formula_options(*c.hv, o);
    c.sensitivity = add_folder_command(
        app, o, "sensitivity",
        "write DIR/sensitivity.html and print the inputs by their effect on resistance",
        "folder of a sensitivity study");
    c.sensitivity->add_option("--svg", o.svg, "also write the tornado chart");
}

}  // namespace

PostCommands declare_post(CLI::App& app, PostOptions& o) {
    app.footer("Exit codes: 0 ok, 1 the check failed or a file cannot be written, 2 bad input.");
    app.require_subcommand(1);
    app.add_flag("-q,--quiet", o.messages.quiet, "only errors");
    PostCommands c{};
    declare_runs(app, o, c);
    declare_sweeps(app, o, c);
    c.paraview = add_command(app, o, "paraview", "write XDMF and HDF5 files for ParaView");
    c.paraview->add_option("-o,--out", o.out, "folder (default RUN/paraview)");
    c.paraview->add_option("--every", o.every, "keep each N-th frame")
        ->check(CLI::Range(1, 1000000));
    c.paraview->add_flag("--points-only", o.points_only,
                         "floes and contacts as points, no surfaces per frame");
    c.check = add_command(app, o, "check", "compare summary.json with expected numbers");
    c.check->add_option("EXPECTED", o.expected, "TOML file with [[expect]] entries")->required();
    c.check->add_option("--junit", o.junit, "also write the verdicts as JUnit XML");
    return c;
}

}  // namespace ice
