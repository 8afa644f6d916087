// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/write_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "postprocess/report/formula_section.hpp"
#include "postprocess/report/page.hpp"
#include "postprocess/sweep/affected_runs.hpp"
#include "postprocess/sweep/formula_curves.hpp"
#include "postprocess/sweep/key_names.hpp"
#include "postprocess/sweep/split_sweep.hpp"
#include "postprocess/sweep/sweep_charts.hpp"
#include "postprocess/sweep/sweep_head.hpp"
#include "postprocess/sweep/sweep_tables.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::sweep {

using report::section;
using views::escape;

namespace {

// Runs without numbers that a message names [-]: more do not fit a terminal or the head of a page.
constexpr std::size_t kMostNamed = 12;
// Small charts drawn at most [-], one per combination; each adds to the page's size. The table has
// all points.
constexpr std::size_t kMostPanels = 200;
// Widths of charts [px]: the page's text, about two thirds of it for the small charts, and a phone
// held upright.
constexpr double kWide = 860.0, kHalf = 600.0, kPhone = 400.0;

std::size_t count_completed(const Sweep& sweep) {
    return static_cast<std::size_t>(std::count_if(sweep.runs.begin(), sweep.runs.end(),
                                                  [](const SweepRun& r) { return r.summary; }));
}

bool all_level_ice(const Sweep& sweep) {
    return count_completed(sweep) > 0 &&
           std::all_of(sweep.runs.begin(), sweep.runs.end(), [](const SweepRun& run) {
               return !run.summary || is_level_ice(run.summary->ice);
           });
}

std::string header(const Sweep& sweep, const std::vector<Sweep>& parts) {
    // The share of completed runs comes first: a curve of half a sweep does not differ from a whole
    // one.
    const std::size_t good = count_completed(sweep), all = sweep.runs.size();
    std::string affected = affected_line(sweep);
    if (!affected.empty()) affected = "<p><a href=\"#affected\">" + escape(affected) + "</a></p>\n";
    std::set<std::string> axes;
    for (const Sweep& part : parts)
        for (const std::string& axis : part.axes) axes.insert(axis_title(axis));
    return "<header><div class=\"inner\">\n<h1>" + escape(sweep.title) +
           "</h1>\n<span class=\"status" + (good == all ? "" : " bad") + "\">" +
           fmt::format("{} of {} runs completed", good, all) + "</span>\n" + affected +
           "<p>Ice resistance of a ship" + (all_level_ice(sweep) ? " in level ice" : "") +
           ", simulated: " +
           escape(axes.empty() ? "nothing but the seed varies"
                               : fmt::format("over {}", fmt::join(axes, ", "))) +
           ".</p>\n</div></header>\n";
}

// a wide drawing and a narrow one, whose text can be read on a phone: the page shows one of them
std::string two_widths(const std::string& kind, const std::string& wide,
                       const std::string& narrow) {
    return "<div class=\"both\"><div class=\"" + kind + "desk\">" + wide + "</div><div class=\"" +
           kind + "phone\">" + narrow + "</div></div>";
}

std::string download(const std::string& file, const std::string& csv) {
    // The CSV lies inside the page as an address, so that one file is enough.
    return "<p>All digits: <a download=\"" + file + "\" href=\"data:text/csv;charset=utf-8," +
           encode_address(csv) + "\">" + file + "</a></p>\n";
}

// which regions were counted to which part: names decide, and a reader may see how
std::string region_note(const Sweep& sweep) {
    std::map<Part, std::set<std::string>> names;
    for (const SweepRun& run : sweep.runs)
        if (run.summary)
            for (const auto& [name, region] : run.summary->regions)
                names[part_of_region(name)].insert(name);
    std::string out;
    for (const auto& [part, regions] : names)
        out += (out.empty() ? "Regions of the hull by name: " : "; ") +
               fmt::format("{}: {}", part_name(part), fmt::join(regions, ", "));
    return out.empty() ? out : out + ".";
}

// what the parts of the charts add up to
std::string parts_words(const std::vector<Curve>& curves) {
    bool level = false, broken = false;
    for (const Curve& curve : curves) (curve.points.front().level_ice ? level : broken) = true;
    std::string out;
    if (level)
        out +=
            "In level ice breaking and submersion add up to the resistance: breaking is the force "
            "of the ice before it breaks off, submersion all else. The formulas' parts (dashed) "
            "have the colour of the part that they compare with. The table below has the parts by "
            "place on the hull. ";
    if (broken)
        out += std::string(level ? "In broken ice normal" : "Normal") +
               " forces on bow, sides, bottom and rest, and (dashed) the friction on all of them, "
               "add up to the resistance. The table below has the friction of each. ";
    return out;
}

std::string parts_section(const Sweep& sweep, const std::vector<Curve>& curves,
                          const report::ForceUnit& unit, const std::string& ending) {
    // Drawn up to a bound, listed without one: a sweep over many axes has thousands of
    // combinations.
    std::vector<Curve> drawn = curves;
    if (drawn.size() > kMostPanels) drawn.resize(kMostPanels);
    std::string intro = parts_words(curves) + region_note(sweep);
    if (drawn.size() < curves.size())
        intro += fmt::format(" The first {} of {} combinations are drawn; the table has all.",
                             drawn.size(), curves.size());
    const auto wide = draw_parts(sweep, drawn, unit, kHalf),
               narrow = draw_parts(sweep, drawn, unit, kPhone);
    std::vector<std::string> charts;
    for (std::size_t k = 0; k < wide.size(); ++k)
        charts.push_back(two_widths("", wide[k], narrow[k]));
    return section("parts" + ending, "Where the resistance comes from", intro,
                   report::figures(charts));
}

// which parts of the formulas are shown beside the runs
std::string compared(const std::vector<Point>& points) {
    std::string out;
    for (const FormulaCurve& f : comparable_curves({{"", points}}))
        out += (out.empty() ? "" : "; ") + f.name + ", " + f.part;
    return out.empty() ? "none, as their inputs are unknown" : out;
}

std::string curve_sections(const Sweep& sweep, const std::vector<Point>& points,
                           const report::ForceUnit& unit, const std::string& ending) {
    if (points.empty()) return "";
    const std::string what =
        std::string(
            "Points are means over the runs of a combination. Bars: 95 % interval, "
            "Student's over seeds, dashed where there are two runs only, which makes t = 12.7 and "
            "says little; of a single run, its own. Long bars are cut off. "
            "The band spans the formulas that compare with these runs: ") +
        compared(points) + ".";
    if (sweep.x.empty())
        return section("curve" + ending, "Resistance",
                       "No number varies: there is no curve to draw.", "");
    const auto curves = make_curves(sweep, points);
    std::string tied;
    for (const std::string& key : sweep.tied) tied += (tied.empty() ? "" : ", ") + key;
    if (!tied.empty()) tied = " Varying with it: " + tied + ".";
    std::string out;
    const std::string overview = draw_overview(sweep, curves, unit, kWide);
    if (!overview.empty())
        out +=
            section("curve" + ending,
                    "Resistance [" + unit.name + "] against " + axis_title(sweep.x), what + tied,
                    two_widths("opening ", overview, draw_overview(sweep, curves, unit, kPhone)));
    // Peaks have a chart of their own: beside means their height would flatten all other curves.
    const std::string peaks = draw_peaks(sweep, curves, kWide);
    if (!peaks.empty())
        out +=
            section("peaks" + ending, "Peaks",
                    "A force is the sum of the impulses of a step divided by the time step, so "
                    "the height of a single hit depends on the step; of more runs, and of longer "
                    "ones, the largest is larger.",
                    two_widths("opening ", peaks, draw_peaks(sweep, curves, kPhone)));
    return out + parts_section(sweep, curves, unit, ending);
}

// runs without numbers and why; the table has the rest of a long list
std::string fault_list(const Sweep& sweep) {
    std::vector<std::string> texts;
    for (const SweepRun& run : sweep.runs)
        if (!run.summary) texts.push_back(run.name + ": " + run.status + ". " + run.fault);
    texts.insert(texts.end(), sweep.warnings.begin(), sweep.warnings.end());
    if (texts.empty()) return "";
    const std::size_t count = texts.size();
    // the first ones: they are in the plan's order, and a sweep often fails for one reason
    if (count > kMostNamed) texts.resize(kMostNamed);
    std::string out =
        "<section id=\"faults\" class=\"warnings\">\n<b>Runs without a result, "
        "and other warnings</b>\n<ul>\n";
    for (const std::string& text : texts) out += "<li>" + escape(text) + "</li>\n";
    if (texts.size() < count)
        out += fmt::format("<li>and {} more: see \"All runs\"</li>\n", count - texts.size());
    return out + "</ul>\n</section>\n";
}

// charts and tables of runs of one dimension
std::string part_of_page(const Sweep& sweep, const std::filesystem::path& page, bool one_of_two) {
    const auto points = make_points(sweep);
    const report::ForceUnit unit = choose_sweep_unit(points);
    const bool flat = dimension_of(sweep) == 2;
    // A folder may have runs in 2D and 3D; forces per metre and whole forces never share a chart.
    // The ending keeps anchors of the two parts apart.
    const std::string ending = !one_of_two ? "" : flat ? "-2d" : "-3d";
    std::string out;
    if (one_of_two)
        out += flat ? "<h2 class=\"part\" id=\"part-2d\">2D: forces per metre of breadth</h2>\n"
                    : "<h2 class=\"part\" id=\"part-3d\">3D: forces on the whole ship</h2>\n";
    const std::string facts = head_facts(sweep);
    if (!facts.empty()) out += section("head" + ending, "Ship, ice and speed", "", facts);
    out += curve_sections(sweep, points, unit, ending);
    if (!points.empty())
        out += section("points" + ending, "All points [" + unit.name + "]",
                       "Intervals are those of 95 %. Formulas are empirical estimates of the part "
                       "that the chart names; they are not fitted to these runs. \"largest\" is "
                       "the largest resistance in one step of all runs. " +
                           report::formula_footnote(formula_columns(points)),
                       point_table(sweep, points, unit, page) +
                           download("points" + ending + ".csv", point_csv(sweep, points)));
    const std::string work = points.empty() ? "" : work_table(sweep, points, unit);
    if (!work.empty())
        out += section("work" + ending, "Where the ship's work went",
                       "Energy per metre of the ship's travel [" + unit.name +
                           "], over the whole run with its start; the first column is the sum of "
                           "the others.",
                       work);
    return out + section("runs" + ending, "All runs", "",
                         run_table(sweep, unit, page) +
                             download("runs" + ending + ".csv", run_csv(sweep)));
}

}  // namespace

std::string list_faults(const Sweep& sweep) {
    std::vector<std::string> names;
    for (const SweepRun& run : sweep.runs)
        if (!run.summary) names.push_back(run.name);
    if (names.empty()) return "";
    const std::size_t count = names.size();
    if (count > kMostNamed) {
        names.resize(kMostNamed);
        names.push_back("...");
    }
    return fmt::format("{} of {} runs have no result: {}", count, sweep.runs.size(),
                       fmt::join(names, "; "));
}

std::string make_sweep_curve(const Sweep& sweep) {
    const auto points = make_points(sweep);
    return sweep.x.empty() || points.empty()
               ? ""
               : draw_overview(sweep, make_curves(sweep, points), choose_sweep_unit(points), kWide);
}

std::string make_sweep_page(const Sweep& sweep, const std::filesystem::path& page) {
    const auto parts = split_sweep(sweep);
    std::string out = report::open_page(sweep.title) + header(sweep, parts) + "<main>\n" +
                      fault_list(sweep) + affected_section(sweep, page);
    if (parts.size() > 1)
        out +=
            "<p class=\"note\">Runs in 3D and in 2D: forces in newtons and in newtons per metre of "
            "breadth cannot be compared, so each kind has charts and tables of its own.</p>\n";
    for (const Sweep& part : parts) out += part_of_page(part, page, parts.size() > 1);
    return out + "</main>\n" + report::close_page();
}

}  // namespace ice::sweep
