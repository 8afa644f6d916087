// SPDX-License-Identifier: GPL-3.0-or-later
// icepost: a run folder -> report, pictures, ParaView files, or a verdict on its numbers.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "common/base/error.hpp"
#include "common/base/part_file.hpp"
#include "common/base/version.hpp"
#include "common/cli/command_line.hpp"
#include "common/cli/console.hpp"
#include "common/cli/picture_file.hpp"
#include "common/cli/quantity_option.hpp"
#include "postprocess/check/check_run.hpp"
#include "postprocess/paraview/write_paraview.hpp"
#include "postprocess/report/compare_runs.hpp"
#include "postprocess/report/draw_plot.hpp"
#include "postprocess/report/pictures.hpp"
#include "postprocess/report/write_report.hpp"
#include "postprocess/sensitivity/write_study.hpp"
#include "postprocess/sweep/split_sweep.hpp"
#include "postprocess/sweep/sweep_markdown.hpp"
#include "postprocess/sweep/write_sweep.hpp"

namespace {

struct Options {
    std::filesystem::path run, out, expected, junit, svg;
    std::size_t every = 1, frames = ice::report::kReportFrames;
    double time = 0.0;
    std::string from = "below";
    std::vector<std::string> runs;
    bool points_only = false, csv = false, markdown = false;
    ice::MessageOptions messages;
};

int report(const Options& o) {
    ice::check_page_name(o.out);
    const auto run = ice::read::read_run_folder(o.run);
    const auto file = o.out.empty() ? run.path / "report.html" : o.out;
    ice::report::write_report(run, file, o.frames);
    ice::say(fmt::format("wrote {}", file.string()));
    return 0;
}

int view(const Options& o) {
    ice::check_picture_name(o.out);
    const auto run = ice::read::read_run_folder(o.run);
    ice::write_picture(o.out,
                       ice::report::draw_view(run.data, *ice::views::parse_view(o.from), o.time));
    const double first = run.data.frames.front().time, last = run.data.frames.back().time;
    if (o.time < first || o.time > last)
        ice::say_warning(fmt::format(
            "the run has frames from {:g} to {:g} s, none at {:g} s: the nearest was drawn", first,
            last, o.time));
    ice::say(fmt::format("wrote {}", o.out.string()));
    return 0;
}

int plot(const Options& o) {
    if (!o.out.empty()) ice::check_picture_name(o.out);
    const auto run = ice::read::read_run_folder(o.run);
    const auto file = o.out.empty() ? run.path / "plot.svg" : o.out;
    ice::write_picture(file, ice::report::draw_plot(run));
    ice::say(fmt::format("wrote {}", file.string()));
    return 0;
}

int compare_runs(const Options& o) {
    std::vector<ice::report::NamedSummary> runs;
    for (const std::string& run : o.runs)
        runs.emplace_back(run, ice::read_summary(ice::read::find_summary(run)));
    ice::write_data(o.csv ? ice::report::compare_csv(runs) : ice::report::compare_text(runs));
    return 0;
}

// one file, or one for each dimension: x-2d.svg and x-3d.svg
void write_sweep_curves(const Options& o, const ice::sweep::Sweep& runs) {
    const auto parts = ice::sweep::split_sweep(runs);
    bool drawn = false;
    for (const auto& part : parts) {
        const std::string curve = ice::sweep::make_sweep_curve(part);
        if (curve.empty()) continue;
        auto file = o.svg;
        if (parts.size() > 1)
            file.replace_filename(fmt::format("{}-{}d{}", file.stem().string(),
                                              ice::sweep::dimension_of(part),
                                              file.extension().string()));
        ice::write_picture(file, curve);
        ice::say(fmt::format("wrote {}", file.string()));
        drawn = true;
    }
    if (!drawn)
        throw ice::bad_input(o.run.string(), "has no curve to draw: " + o.svg.string(),
                             "leave out --svg, or let one or two numbers vary");
}

int sweep(const Options& o) {
    ice::check_page_name(o.out);
    if (!o.svg.empty()) ice::check_picture_name(o.svg);
    const auto runs = ice::sweep::read_sweep(o.run);
    const auto file = o.out.empty() ? o.run / "sweep.html" : o.out;
    ice::write_text_file(file, ice::sweep::make_sweep_page(runs, file));
    if (const std::string faults = ice::sweep::list_faults(runs); !faults.empty())
        ice::say_warning(faults);
    ice::say(fmt::format("wrote {}", file.string()));
    if (!o.svg.empty()) write_sweep_curves(o, runs);
    if (o.markdown) ice::write_data(ice::sweep::sweep_markdown(runs));
    return 0;
}

int sensitivity(const Options& o) {
    ice::check_page_name(o.out);
    if (!o.svg.empty()) ice::check_picture_name(o.svg);
    const auto study = ice::sensitivity::read_study(o.run);
    const auto file = o.out.empty() ? o.run / "sensitivity.html" : o.out;
    ice::write_text_file(file, ice::sensitivity::make_study_page(study));
    if (const std::string faults = ice::sweep::list_faults(study.runs); !faults.empty())
        ice::say_warning(faults);
    ice::say(fmt::format("wrote {}", file.string()));
    if (!o.svg.empty()) {
        ice::write_picture(o.svg, ice::sensitivity::make_tornado(study));
        ice::say(fmt::format("wrote {}", o.svg.string()));
    }
    ice::write_data(ice::sensitivity::study_text(study));
    return 0;
}

int paraview(const Options& o) {
    const auto run = ice::read::read_run_folder(o.run);
    const auto folder = o.out.empty() ? run.path / "paraview" : o.out;
    const double load_from = run.summary ? run.summary->average_from : 0.0;
    const std::size_t count =
        ice::paraview::write_paraview(run.data, folder, {o.every, o.points_only, load_from});
    ice::say(fmt::format("wrote {} frames: open {}", count,
                         (folder / (o.points_only ? "bodies.pvd" : "run.pvd")).string()));
    return 0;
}

int check(const Options& o) {
    const auto expected = ice::check::read_expected(o.expected);
    const auto numbers = ice::read_json_numbers(ice::read::find_summary(o.run));
    const auto verdicts = ice::check::check_numbers(numbers, expected, o.expected);
    ice::write_data(ice::check::verdict_table(verdicts));
    if (!o.junit.empty())
        ice::write_text_file(o.junit, ice::check::junit_text(verdicts, o.run.string()));
    return ice::check::all_passed(verdicts) ? 0 : static_cast<int>(ice::ExitCode::failed);
}

}  // namespace

int main(int argc, char** argv) {
    Options o;
    CLI::App app("Reports, pictures and checks of icesolve's run folders.", "icepost");
    ice::declare_version(app);
    app.footer("Exit codes: 0 ok, 1 the check failed or a file cannot be written, 2 bad input.");
    app.require_subcommand(1);
    app.add_flag("-q,--quiet", o.messages.quiet, "only errors");
    const auto command = [&](const char* name, const char* text) {
        auto* sub = app.add_subcommand(name, text)->fallthrough();
        sub->add_option("RUN", o.run, "run folder made by icesolve")->required();
        return sub;
    };
    auto* make_report = command("report", "write RUN/report.html, one file that opens anywhere");
    make_report->add_option("-o,--out", o.out, "another file");
    make_report->add_option("--frames", o.frames, "of the 3D playback at most, evenly chosen")
        ->capture_default_str()
        ->check(CLI::Range(2, 1000000));
    auto* draw = command("view", "draw hull and ice at one instant");
    draw->add_option("--time", o.time, "the frame nearest to this time [s]")
        ->required()
        ->transform(ice::finite_quantity(ice::Dimension::time, "2.5"));
    draw->add_option("--from", o.from, "below, top, side (starboard), port, front or quarter")
        ->check(CLI::IsMember({"below", "top", "side", "port", "front", "quarter"}));
    draw->add_option("-o,--out", o.out, "the picture: .svg, .png or .pdf")->required();
    auto* plot_run =
        command("plot", "draw histories, tracked floes' paths and their forces in one picture");
    plot_run->add_option("-o,--out", o.out,
                         "the picture: .svg, .png or .pdf (default RUN/plot.svg)");
    auto* table = app.add_subcommand("table", "compare runs, a line each")->fallthrough();
    table->add_option("RUN", o.runs, "run folders made by icesolve")->required();
    table->add_flag("--csv", o.csv, "comma-separated, all digits");
    auto* curve =
        app.add_subcommand("sweep", "write DIR/sweep.html, resistance curves of many runs");
    curve->fallthrough()->add_option("DIR", o.run, "folder of run folders")->required();
    curve->add_option("-o,--out", o.out, "another file");
    curve->add_option("--svg", o.svg,
                      "also write the first chart, resistance against speed: .svg, .png or .pdf");
    curve->add_flag("--markdown", o.markdown, "also print the points as tables in Markdown");
    auto* study = app.add_subcommand(
        "sensitivity", "write DIR/sensitivity.html and print what decides a case's resistance");
    study->fallthrough()->add_option("DIR", o.run, "folder of a sensitivity study")->required();
    study->add_option("-o,--out", o.out, "another file");
    study->add_option("--svg", o.svg, "also write the tornado chart");
    auto* export_files = command("paraview", "write PVD and VTP files for ParaView");
    export_files->add_option("-o,--out", o.out, "folder (default RUN/paraview)");
    export_files->add_option("--every", o.every, "keep each N-th frame")
        ->check(CLI::Range(1, 1000000));
    export_files->add_flag("--points-only", o.points_only,
                           "floes and contacts as points, no surfaces per frame");
    auto* compare = command("check", "compare summary.json with expected numbers");
    compare->add_option("EXPECTED", o.expected, "TOML file with [[expect]] entries")->required();
    compare->add_option("--junit", o.junit, "also write the verdicts as JUnit XML");
    const auto run_icepost = [&](const std::string&) {
        if (make_report->parsed()) return report(o);
        if (draw->parsed()) return view(o);
        if (plot_run->parsed()) return plot(o);
        if (table->parsed()) return compare_runs(o);
        if (curve->parsed()) return sweep(o);
        if (study->parsed()) return sensitivity(o);
        return export_files->parsed() ? paraview(o) : check(o);
    };
    return ice::run_command_line(app, argc, argv, o.messages,
                                 "use fewer frames (report --frames, paraview --every)",
                                 run_icepost);
}
