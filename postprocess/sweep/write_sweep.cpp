// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/write_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "common/base/version.hpp"
#include "postprocess/report/page.hpp"
#include "postprocess/sweep/key_names.hpp"
#include "postprocess/sweep/sweep_charts.hpp"
#include "postprocess/sweep/sweep_tables.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::sweep {

using report::section;
using views::escape;

namespace {

constexpr std::size_t kMostNamed = 12;    // runs without numbers in a message
constexpr std::size_t kMostPanels = 200;  // small multiples drawn

std::size_t count_completed(const Sweep& sweep) {
    return static_cast<std::size_t>(std::count_if(sweep.runs.begin(), sweep.runs.end(),
                                                  [](const SweepRun& r) { return r.summary; }));
}

std::string header(const Sweep& sweep) {
    const std::size_t good = count_completed(sweep), all = sweep.runs.size();
    std::string axes;
    for (const std::string& axis : sweep.axes)
        axes += (axes.empty() ? "" : ", ") + axis_title(axis);
    return "<header><div class=\"inner\">\n<h1>" + escape(sweep.title) +
           "</h1>\n<span class=\"status" + (good == all ? "" : " bad") + "\">" +
           fmt::format("{} of {} runs completed", good, all) + "</span>\n<p>" +
           escape(axes.empty() ? "Nothing but the seed varies." : "Over " + axes + ".") +
           "</p>\n</div></header>\n";
}

std::string download(const std::string& file, const std::string& csv) {
    return "<p><a download=\"" + file + "\" href=\"data:text/csv;charset=utf-8," +
           encode_address(csv) + "\">" + file + "</a></p>\n";
}

// which regions were counted to which part
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

std::string parts_section(const Sweep& sweep, const std::vector<Curve>& curves,
                          const report::ForceUnit& unit) {
    std::vector<Curve> drawn = curves;
    if (drawn.size() > kMostPanels) drawn.resize(kMostPanels);
    std::string intro =
        "Normal forces on bow, sides, bottom and rest, and (dashed) the friction on all of them, "
        "add "
        "up to the resistance. The table below has the friction of each. " +
        region_note(sweep);
    if (drawn.size() < curves.size())
        intro += fmt::format(" The first {} of {} combinations are drawn; the table has all.",
                             drawn.size(), curves.size());
    return section("parts", "Where the resistance comes from", intro,
                   report::figures(draw_parts(sweep, drawn, unit)));
}

std::string curve_sections(const Sweep& sweep, const std::vector<Point>& points,
                           const report::ForceUnit& unit) {
    if (points.empty()) return "";
    const std::string what =
        "Points are means over the runs of a combination. Bars: 95 % interval, "
        "Student's over seeds; of a single run, from batch means. Long bars are cut off. "
        "Lindqvist (1989) is an estimate of the submersion part only.";
    if (sweep.x.empty())
        return section("curve", "Resistance", "No number varies: there is no curve to draw.", "");
    const auto curves = make_curves(sweep, points);
    std::string tied;
    for (const std::string& key : sweep.tied) tied += (tied.empty() ? "" : ", ") + key;
    if (!tied.empty()) tied = " Varying with it: " + tied + ".";
    std::string out;
    const std::string overview = draw_overview(sweep, curves, unit);
    if (!overview.empty())
        out += section("curve", "Resistance against " + axis_title(sweep.x), what + tied,
                       "<div class=\"opening\">" + overview + "</div>\n");
    return out + parts_section(sweep, curves, unit);
}

// runs without numbers and why; the table has the rest of a long list
std::string fault_list(const Sweep& sweep) {
    std::vector<std::string> texts;
    for (const SweepRun& run : sweep.runs)
        if (!run.summary) texts.push_back(run.name + ": " + run.status + ". " + run.fault);
    texts.insert(texts.end(), sweep.warnings.begin(), sweep.warnings.end());
    if (texts.empty()) return "";
    const std::size_t count = texts.size();
    if (count > kMostNamed) texts.resize(kMostNamed);
    std::string out =
        "<section id=\"faults\" class=\"warnings\">\n<b>Runs without a result, "
        "and other warnings</b>\n<ul>\n";
    for (const std::string& text : texts) out += "<li>" + escape(text) + "</li>\n";
    if (texts.size() < count)
        out += fmt::format("<li>and {} more: see \"All runs\"</li>\n", count - texts.size());
    return out + "</ul>\n</section>\n";
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
               : draw_overview(sweep, make_curves(sweep, points), choose_sweep_unit(points));
}

std::string make_sweep_page(const Sweep& sweep, const std::filesystem::path& page) {
    const auto points = make_points(sweep);
    const report::ForceUnit unit = choose_sweep_unit(points);
    std::string out =
        report::open_page(sweep.title) + header(sweep) + "<main>\n" + fault_list(sweep);
    out += curve_sections(sweep, points, unit);
    if (!points.empty())
        out += section("points", "All points",
                       "Lindqvist's formula (1989) is an empirical estimate of the submersion part "
                       "of level ice; it is not fitted to these runs.",
                       point_table(sweep, points, unit, page) +
                           download("points.csv", point_csv(sweep, points)));
    if (!points.empty())
        out += section("work", "Where the ship's work went",
                       "Energy per metre of the ship's travel [" + unit.name +
                           "], over the whole run with its start; the first column is the sum of "
                           "the others.",
                       work_table(sweep, points, unit));
    out += section("runs", "All runs", "",
                   run_table(sweep, unit, page) + download("runs.csv", run_csv(sweep)));
    return out + "</main>\n<footer><div class=\"inner\">Made by icepost " + escape(version()) +
           " (" + escape(git_commit()) +
           "). Forces are those of the ice on the ship.</div></footer>\n</body>\n</html>\n";
}

}  // namespace ice::sweep
