// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/write_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "common/base/part_file.hpp"
#include "postprocess/report/find_sweep.hpp"
#include "postprocess/report/page.hpp"
#include "postprocess/report/pictures.hpp"
#include "postprocess/report/tables.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::report {

using views::escape;
using views::readable;

namespace {

constexpr std::size_t kPageSize = 1950000;     // bytes: drawn views take what is left of them,
constexpr std::size_t kLeastBudget = 150000;   // but at least this much
constexpr std::size_t kMostBudget = 500000;    // and at most this much
constexpr std::size_t kMostTracked = 12;       // floes with charts of their own
constexpr std::size_t kMostCaseText = 200000;  // bytes of the case shown

std::string page_header(const read::RunFolder& run) {
    const std::string status = run.summary ? run.summary->status : "interrupted";
    std::string line = run.data.header.dimension == 2 ? "2D, per metre of breadth" : "3D";
    if (run.summary)
        line +=
            fmt::format(", {} s in {} steps, {} threads, {}", readable(run.summary->simulated_s),
                        run.summary->steps, run.summary->threads, run.summary->simd);
    else if (!run.data.history.empty())
        line += fmt::format(", recorded up to {} s", readable(run.data.history.back().time));
    return "<header><div class=\"inner\">\n<h1>" + escape(run.data.header.title) +
           "</h1>\n<span class=\"status" + (status == "completed" ? "" : " bad") + "\">" +
           escape(status) + "</span>\n<p>Ship-ice sliding: forces of ice pieces on a hull. " +
           escape(line) + ".</p>\n</div></header>\n";
}

std::string statistics_sections(const Summary& s) {
    std::string out = section(
        "forces", "Force of the ice on the ship",
        fmt::format("Means over t \u2265 {} s. \u00b1 is the half width of the 95 % "
                    "confidence interval from the autocorrelation. Lindqvist's formula is an "
                    "empirical estimate and covers the submersion of ice only.",
                    readable(s.average_from)),
        force_table(s));
    const std::string regions = region_table(s);
    if (!regions.empty())
        out += section(
            "regions", "Regions of the hull",
            "A hit is counted when a floe begins to touch the region; an impulse is that of "
            "one floe in one step.",
            regions);
    return out;
}

std::string balance_sections(const Summary& s) {
    std::string out;
    const std::string energy = energy_table(s);
    if (!energy.empty())
        out += section("energy", "Where the ship's work went",
                       "Work of the ship + opened overlaps = all that follows them.", energy);
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
        rows.emplace_back("Wall time", readable(run.summary->wall_s) + " s");
    }
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

}  // namespace

std::string make_report(const read::RunFolder& run, std::size_t frames) {
    const RunData data = with_few_tracks(run.data);
    const double from = run.summary ? run.summary->average_from : 0.0;
    const double mean =
        run.summary ? run.summary->resistance.mean : std::numeric_limits<double>::quiet_NaN();
    const RunFigures figures{statistics::make_load_map(data, from),
                             statistics::measure_bottom_coverage(data, frames),
                             force_histories(data, from, mean), from, data.header.dimension};
    const ViewerData viewer = make_viewer_data(data, figures, frames);
    PageParts page{data.header.title, page_header(run), "", "", viewer.meta, viewer.arrays};
    if (run.summary)
        page.summary = key_numbers(*run.summary) + warning_list(run.summary->warnings);
    else
        page.summary =
            warning_list({{"The run ended before it wrote summary.json: there are no statistics, "
                           "and pictures and histories end with the last flush"}});
    page.body = history_section(data, figures);
    if (run.summary) page.body += statistics_sections(*run.summary);
    page.body += load_section(data, figures);
    std::string rest = track_section(data);
    if (run.summary) rest += balance_sections(*run.summary);
    rest += origin(run);
    const std::size_t used = make_page(page).size() + rest.size();
    page.body += scene_section(
        data, std::clamp(kPageSize - std::min(kPageSize, used), kLeastBudget, kMostBudget));
    page.body += rest;
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
