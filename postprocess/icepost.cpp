// SPDX-License-Identifier: GPL-3.0-or-later
// icepost: a run folder -> report, pictures, ParaView files, or a verdict on its numbers.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "common/base/error.hpp"
#include "common/base/part_file.hpp"
#include "common/base/usual_range.hpp"
#include "common/base/version.hpp"
#include "common/cli/command_line.hpp"
#include "common/cli/console.hpp"
#include "common/cli/picture_file.hpp"
#include "common/formulas/coefficients_file.hpp"
#include "postprocess/attain/hv_curves.hpp"
#include "postprocess/check/check_run.hpp"
#include "postprocess/fit/fit_sweep.hpp"
#include "postprocess/icepost_options.hpp"
#include "postprocess/paraview/write_paraview.hpp"
#include "postprocess/report/compare_runs.hpp"
#include "postprocess/report/draw_plot.hpp"
#include "postprocess/report/evaluate_run.hpp"
#include "postprocess/report/sections.hpp"
#include "postprocess/report/write_report.hpp"
#include "postprocess/sensitivity/write_study.hpp"
#include "postprocess/sweep/affected_runs.hpp"
#include "postprocess/sweep/split_sweep.hpp"
#include "postprocess/sweep/sweep_markdown.hpp"
#include "postprocess/sweep/write_sweep.hpp"

namespace {

using Options = ice::PostOptions;

// A strength that no ice has is most often one in a wrong unit; icesolve warns of it in a case.
void warn_of_strength(const Options& o) {
    if (std::isnan(o.flexural_strength)) return;
    const std::string text =
        ice::outside_usual(ice::kUsualStrength, "--flexural-strength", o.flexural_strength);
    if (!text.empty())
        ice::say_warning(text + " (changes the formulas' values in level ice, not the run's)");
}

// Own coefficients and a strength, by which formulas are evaluated anew: a run's summary has the
// values of the program that made it.
ice::FormulaOptions formula_options(const Options& o) {
    warn_of_strength(o);
    ice::FormulaOptions out;
    if (!o.coefficients.empty()) out.spencer = ice::read_coefficients(o.coefficients);
    out.flexural_strength = o.flexural_strength;
    return out;
}

// a sweep whose runs have the formulas with the options' coefficients and strength
ice::sweep::Sweep read_evaluated(const Options& o) {
    const auto formulas = formula_options(o);
    auto runs = ice::sweep::read_sweep(o.run);
    for (auto& run : runs.runs)
        if (run.summary) ice::report::evaluate_run(*run.summary, formulas);
    return runs;
}

// In all commands names of outputs are checked first: reading a run takes seconds.
int report(const Options& o) {
    ice::check_page_name(o.out);
    const auto formulas = formula_options(o);
    auto run = ice::read::read_run_folder(o.run);
    if (run.summary) ice::report::evaluate_run(*run.summary, formulas);
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
    // A warning, not an error: the picture is useful, but of another time than the user thinks.
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

// Summaries alone: a table of many runs reads no poses.
int compare_runs(const Options& o) {
    std::vector<ice::report::NamedSummary> runs;
    for (const std::string& run : o.runs) runs.emplace_back(run, ice::read::read_with_members(run));
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
    // The user named the curve's file, so its absence is an error; the page says it in a sentence.
    if (!drawn)
        throw ice::bad_input(o.run.string(), "has no curve to draw: " + o.svg.string(),
                             "leave out --svg, or let one or two numbers vary");
}

int sweep(const Options& o) {
    ice::check_page_name(o.out);
    if (!o.svg.empty()) ice::check_picture_name(o.svg);
    const auto runs = read_evaluated(o);
    const auto file = o.out.empty() ? o.run / "sweep.html" : o.out;
    ice::write_text_file(file, ice::sweep::make_sweep_page(runs, file));
    if (const std::string faults = ice::sweep::list_faults(runs); !faults.empty())
        ice::say_warning(faults);
    if (const std::string affected = ice::sweep::affected_line(runs); !affected.empty())
        ice::say_warning(affected);
    ice::say(fmt::format("wrote {}", file.string()));
    if (!o.svg.empty()) write_sweep_curves(o, runs);
    // last, and alone on standard output: it can be piped into a document
    if (o.markdown) ice::write_data(ice::sweep::sweep_markdown(runs));
    return 0;
}

int fit(const Options& o) {
    warn_of_strength(o);
    const auto runs = ice::sweep::read_sweep(o.run);
    const auto points =
        ice::fit::fit_points(runs, ice::sweep::make_points(runs), o.flexural_strength);
    auto fitted = ice::fit::fit_spencer(points);
    // The name appears in the legends of all charts that use the file.
    fitted.coefficients.name = !o.name.empty() ? o.name : runs.title;
    const auto file = o.out.empty() ? o.run / "coefficients.toml" : o.out;
    ice::write_text_file(
        file, ice::coefficients_text(fitted.coefficients, fitted.intervals,
                                     fmt::format("Fitted by icepost {} to {} points of {}.",
                                                 ice::version(), points.size(), o.run.string())));
    for (const std::string& warning : ice::fit::fit_warnings(runs, fitted))
        ice::say_warning(warning);
    ice::say(fmt::format("wrote {}", file.string()));
    ice::write_data(ice::fit::fit_text(fitted, points));
    return 0;
}

int hv(const Options& o) {
    ice::check_page_name(o.out);
    if (!o.svg.empty()) ice::check_picture_name(o.svg);
    const auto thrusts =
        o.thrust.empty() ? std::vector<ice::attain::Thrust>{} : ice::attain::read_thrusts(o.thrust);
    const auto formulas = formula_options(o);
    const auto runs = ice::sweep::read_sweep(o.run);
    const auto study = ice::attain::make_hv(runs, thrusts, formulas);
    const auto file = o.out.empty() ? o.run / "hv.html" : o.out;
    ice::write_text_file(file, ice::attain::make_hv_page(runs, study));
    for (const std::string& warning : study.warnings) ice::say_warning(warning);
    ice::say(fmt::format("wrote {}", file.string()));
    if (!o.svg.empty()) ice::write_picture(o.svg, ice::attain::draw_hv(study, 860.0));
    if (!o.csv_file.empty()) ice::write_text_file(o.csv_file, ice::attain::hv_csv(study));
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
    // The hull's load is a mean over the averaged time; a killed run has no summary and is averaged
    // whole.
    const double load_from = run.summary ? run.summary->average_from : 0.0;
    const std::size_t count =
        ice::paraview::write_paraview(run.data, folder, {o.every, o.points_only, load_from});
    ice::say(fmt::format("wrote {} frames: open {}, or paraview --script={}", count,
                         (folder / "run.xdmf").string(), (folder / "view.py").string()));
    return 0;
}

int check(const Options& o) {
    const auto expected = ice::check::read_expected(o.expected);
    const auto numbers = ice::read_json_numbers(ice::read::find_summary(o.run));
    const auto verdicts = ice::check::check_numbers(numbers, expected, o.expected);
    ice::write_data(ice::check::verdict_table(verdicts));
    if (!o.junit.empty())
        ice::write_text_file(o.junit, ice::check::junit_text(verdicts, o.run.string()));
    // Exit code 1 for numbers that miss, 2 for a file that cannot be read: scripts tell them apart.
    return ice::check::all_passed(verdicts) ? 0 : static_cast<int>(ice::ExitCode::failed);
}

}  // namespace

// Errors become exit codes and messages in run_command_line(), the same for all programs.
int main(int argc, char** argv) {
    Options o;
    CLI::App app("Reports, pictures and checks of icesolve's run folders.", "icepost");
    ice::declare_version(app);
    const ice::PostCommands c = ice::declare_post(app, o);
    // exactly one subcommand was given: CLI11 has checked it
    const auto run_icepost = [&](const std::string&) {
        if (c.report->parsed()) return report(o);
        if (c.view->parsed()) return view(o);
        if (c.plot->parsed()) return plot(o);
        if (c.table->parsed()) return compare_runs(o);
        if (c.sweep->parsed()) return sweep(o);
        if (c.fit->parsed()) return fit(o);
        if (c.hv->parsed()) return hv(o);
        if (c.sensitivity->parsed()) return sensitivity(o);
        return c.paraview->parsed() ? paraview(o) : check(o);
    };
    return ice::run_command_line(app, argc, argv, o.messages,
                                 "use fewer frames (report --frames, paraview --every)",
                                 run_icepost);
}
