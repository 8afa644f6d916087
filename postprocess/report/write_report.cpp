// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/write_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/part_file.hpp"
#include "common/base/uncertainty.hpp"
#include "common/formulas/formula_band.hpp"
#include "postprocess/report/find_sweep.hpp"
#include "postprocess/report/formula_section.hpp"
#include "postprocess/report/page.hpp"
#include "postprocess/report/sections.hpp"
#include "postprocess/report/tables.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::report {

using views::escape;
using views::readable;

namespace {

// Size of the page that drawn views may fill up [bytes]: the page stays below 2 MB and can be
// mailed. A larger value draws more views.
constexpr std::size_t kPageSize = 1950000;
// Least and most that the drawn views take [bytes]: about one view in a page that is full already,
// and no more than a reader needs. A page of much data exceeds 2 MB by the least.
constexpr std::size_t kLeastBudget = 150000;
constexpr std::size_t kMostBudget = 500000;
// Tracked floes with charts of their own [-]; each takes some 20 kB of the page. run.h5 has all of
// them.
constexpr std::size_t kMostTracked = 12;
// Part of the case that is shown [bytes]: a case with many [[floes]] may be longer than the report.
constexpr std::size_t kMostCaseText = 200000;

std::string page_header(const read::RunFolder& run) {
    const std::string status = run.summary ? run.summary->status : "interrupted";
    std::string line = run.data.header.dimension == 2 ? "2D, forces per metre of breadth" : "3D";
    const bool level = run.summary && is_level_ice(run.summary->ice);
    if (!run.summary && !run.data.history.empty())
        line += fmt::format(", recorded up to {} s", readable(run.data.history.back().time));
    return "<header><div class=\"inner\">\n<h1>" + escape(run.data.header.title) +
           "</h1>\n<span class=\"status" + (status == "completed" ? "" : " bad") + "\">" +
           escape(status) + "</span>\n<p>Ice resistance of a ship" +
           (level ? " in level ice" : "") + ", simulated. " + escape(line) +
           ".</p>\n</div></header>\n";
}

// whether the mean is steady, in a sentence
std::string steadiness(const ForceStatistics& f, const ForceUnit& unit) {
    // a series too short for an interval has no trend either
    if (!std::isfinite(f.correlation_time)) return "";
    std::string text = fmt::format(
        " Forces at neighbouring instants are alike, so the averaged time tells as much as {} "
        "independent values; the interval is theirs.",
        std::lround(f.effective_samples));
    if (std::isfinite(f.trend))
        text += fmt::format(
            " From the start to the end of the averaged time the resistance {} by {} {} (a "
            "straight "
            "line through it): {}.",
            f.trend < 0.0 ? "falls" : "rises", unit.text(std::abs(f.trend)), unit.name,
            f.trend_significant.value_or(false)
                ? "the scatter of the force alone rarely makes so much, so the resistance is not "
                  "steady; average later or longer"
                : "the scatter of the force alone often makes as much, so nothing speaks against "
                  "a steady resistance");
    return text;
}

// The error of the model, which the interval does not contain.
std::string model_words(const IceParticulars& ice) {
    if (is_level_ice(ice))
        return fmt::format(
            "the error of the model, {:.0f} to {:.0f} % against model tests in level ice,",
            100.0 * kLeastLevelIceError, 100.0 * kLargestLevelIceError);
    return fmt::format("the uncertainty of the model, about {:.0f} %,", 100.0 * kModelUncertainty);
}

std::string force_section(const Summary& s, const ForceUnit& unit) {
    return section(
        "forces", "Force of the ice on the ship",
        fmt::format(
            "Means over t \u2265 {} s. \u00b1 is the half width of the 95 % confidence interval "
            "from the autocorrelation of this run; {} is "
            "not in it. Formulas are empirical estimates of the part that they name.",
            readable(s.average_from), model_words(s.ice)) +
            steadiness(s.resistance, unit),
        force_table(s, unit));
}

std::string balance_sections(const Summary& s) {
    std::string out;
    const std::string energy = energy_table(s);
    if (!energy.empty())
        out += section("energy", "Where the ship's work went", energy_balance(s), energy);
    return out + section("numerics", "Contacts and computing time", "", numerics_table(s));
}

std::string origin(const read::RunFolder& run) {
    const RunHeader& header = run.data.header;
    std::vector<std::pair<std::string, std::string>> rows{{"Solver", header.created_by},
                                                          {"Commit", header.git_commit},
                                                          {"Command", header.command_line}};
    if (run.summary) {
        rows.emplace_back("Case file", run.summary->case_file);
        rows.emplace_back("State hash", fmt::format("{:016x}", run.summary->state_hash));
        rows.emplace_back(
            "Computed in",
            fmt::format("{} s, {} steps, {} thread{}, {}", readable(run.summary->wall_s),
                        run.summary->steps, run.summary->threads,
                        run.summary->threads == 1 ? "" : "s", run.summary->simd));
    }
    // The case that was run, not the file that is there now: the file may have changed since.
    std::string text = header.case_toml.substr(0, kMostCaseText);
    if (text.size() < header.case_toml.size()) text += "\n# ... see case.resolved.cfg\n";
    return section("origin", "Case and origin",
                   "The case with every key, as the solver ran it; the same text is in "
                   "case.resolved.cfg.",
                   facts(rows) + "<details open=\"open\"><summary>Resolved case</summary>\n<pre>" +
                       escape(text) + "</pre>\n</details>\n");
}

// the first tracked floes only, when somebody tracks hundreds
RunData with_few_tracks(const RunData& run) {
    RunData few = run;
    if (few.tracks.size() > kMostTracked) {
        few.tracks.resize(kMostTracked);
        few.header.tracked.resize(kMostTracked);
    }
    return few;
}

// links to the headings of a page's sections
std::string contents(const std::string& html) {
    std::string links;
    const std::string opening = "<section id=\"", heading = "<h2>";
    for (std::size_t at = html.find(opening); at != std::string::npos;
         at = html.find(opening, at + 1)) {
        const std::size_t id = at + opening.size(), title = html.find(heading, at);
        // sections without a heading of their own get no link
        if (title == std::string::npos || title > html.find("</section>", at)) continue;
        const std::size_t text = title + heading.size();
        links += "<li><a href=\"#" + html.substr(id, html.find('"', id) - id) + "\">" +
                 html.substr(text, html.find("</h2>", text) - text) + "</a></li>\n";
    }
    return links.empty() ? "" : "<nav class=\"contents\"><ul>\n" + links + "</ul></nav>\n";
}

RunFigures make_figures(const read::RunFolder& run, const RunData& data, std::size_t frames) {
    const double from = run.summary                               ? run.summary->average_from
                        : std::isfinite(data.header.average_from) ? data.header.average_from
                                                                  : 0.0;
    const double mean =
        // without a summary there is no stated mean to draw
        run.summary ? run.summary->resistance.mean : std::numeric_limits<double>::quiet_NaN();
    const ForceUnit unit = page_unit(run);
    return {statistics::make_load_map(data, from),
            statistics::measure_bottom_coverage(data, frames),
            force_histories(data, from, mean, unit),
            region_histories(data, from, unit),
            moment_histories(data, from, unit),
            motion_histories(data, from, unit),
            unit,
            from,
            data.header.dimension};
}

}  // namespace

std::string make_report(const read::RunFolder& run, std::size_t frames) {
    // figures first: several sections and the viewer use them
    const RunData data = with_few_tracks(run.data);
    const RunFigures figures = make_figures(run, data, frames);
    const ViewerData viewer = make_viewer_data(data, figures, frames);
    PageParts page{data.header.title, page_header(run), "", "", viewer.meta, viewer.arrays};
    const bool stated = run.summary && std::isfinite(run.summary->ship.speed_mean);
    const double speed =
        stated ? run.summary->ship.speed_mean : mean_speed(data, figures.average_from);
    std::string head;
    if (run.summary) {
        page.summary =
            key_numbers(*run.summary, figures.unit, speed) + warning_list(run.summary->warnings);
        head = particulars_section(*run.summary, speed);
    } else {
        page.summary =
            warning_list({{"The run ended before it wrote summary.json: there are no statistics, "
                           "and pictures and histories end with the last flush"}});
    }
    if (run.summary) page.body += force_section(*run.summary, figures.unit);
    if (run.summary) page.body += formula_section(*run.summary, figures.unit);
    page.body += history_section(data, figures);
    page.body +=
        region_section(figures, run.summary ? region_table(*run.summary, figures.unit) : "");
    page.body += local_load_section(
        run, figures, run.summary ? run.summary->travel.averaged_lengths : std::nan(""));
    page.body += load_section(data, figures);
    page.body += motion_section(data, figures);
    page.body += moment_section(data, figures);
    std::string rest = track_section(data, figures.unit);
    if (run.summary) rest += balance_sections(*run.summary);
    rest += origin(run);
    // The 3D scene takes the room that the rest of the page leaves: the page stays small enough to
    // mail.
    // everything else is made first, since its size is known only then
    const std::size_t used = make_page(page).size() + head.size() + rest.size();
    page.body += scene_section(
        data, std::clamp(kPageSize - std::min(kPageSize, used), kLeastBudget, kMostBudget));
    page.body += rest;
    page.summary += contents(head + page.body) + head;
    return make_page(page);
}

void write_report(const read::RunFolder& run, const std::filesystem::path& file,
                  std::size_t frames) {
    std::string page = make_report(run, frames);
    // a page that lies elsewhere has another way to the sweep
    const bool beside = std::filesystem::absolute(file).parent_path().lexically_normal() ==
                        std::filesystem::absolute(run.path).lexically_normal();
    const std::string sweep = beside ? find_sweep(run.path) : "";
    if (const auto end = page.find("</div></header>"); !sweep.empty() && end != std::string::npos)
        page.insert(end,
                    "<p><a href=\"" + sweep + "\">The sweep that this run belongs to</a></p>\n");
    write_text_file(file, page);
}

}  // namespace ice::report
