// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/write_report.hpp"

#include <fmt/format.h>

#include <limits>

#include "common/base/part_file.hpp"
#include "postprocess/report/page.hpp"
#include "postprocess/report/pictures.hpp"
#include "postprocess/report/tables.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::report {

using views::escape;
using views::readable;

namespace {

constexpr std::size_t kSceneBudget =
    1100000;                             // bytes: with the histories the page stays below 2 MB
constexpr std::size_t kMostTracked = 8;  // floes with charts of their own
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

std::string statistics(const Summary& s) {
    std::string out = key_numbers(s) + warning_list(s.warnings);
    out += section("forces", "Force of the ice on the ship",
                   fmt::format("Means over t \u2265 {} s. \u00b1 is the half width of the 95 % "
                               "confidence interval from batch means. Lindqvist's formula is an "
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

std::string make_report(const read::RunFolder& run) {
    const RunData data = with_few_tracks(run.data);
    std::string body = page_header(run) + "<main>\n";
    if (run.summary)
        body += statistics(*run.summary);
    else
        body +=
            warning_list({"The run ended before it wrote summary.json: there are no statistics, "
                          "and pictures and histories end with the last flush."});
    body += scene_section(data, kSceneBudget);
    body += history_section(
        data, run.summary ? run.summary->average_from : 0.0,
        run.summary ? run.summary->resistance.mean : std::numeric_limits<double>::quiet_NaN());
    body += track_section(data);
    if (run.summary) {
        const std::string energy = energy_table(*run.summary);
        if (!energy.empty())
            body += section("energy", "Where the ship's work went",
                            "Work of the ship + opened overlaps = all that follows them.", energy);
        body +=
            section("numerics", "Contacts and computing time", "", numerics_table(*run.summary));
    }
    body += origin(run) + "</main>\n";
    return make_page(run.data.header.title, body);
}

void write_report(const read::RunFolder& run, const std::filesystem::path& file) {
    write_text_file(file, make_report(run));
}

}  // namespace ice::report
