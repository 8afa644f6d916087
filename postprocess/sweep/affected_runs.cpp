// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/affected_runs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "postprocess/sweep/sweep_tables.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::sweep {

using views::escape;

namespace {

// Warnings listed at most [-]: more make the page of a large sweep long, and each run has its own.
constexpr std::size_t kMostListed = 200;

std::vector<Warning> affecting(const SweepRun& run) {
    std::vector<Warning> out;
    if (!run.summary) return out;
    for (const Warning& w : run.summary->warnings)
        if (w.affects_mean.value_or(false)) out.push_back(w);
    return out;
}

}  // namespace

std::string affected_line(const Sweep& sweep) {
    std::size_t completed = 0, affected = 0;
    std::vector<Warning> all;
    for (const SweepRun& run : sweep.runs) {
        if (run.summary) ++completed;
        const std::vector<Warning> warnings = affecting(run);
        if (!warnings.empty()) ++affected;
        all.insert(all.end(), warnings.begin(), warnings.end());
    }
    if (affected == 0) return "";
    const bool one = affected == 1;
    const std::string who =
        fmt::format("{} of {} completed runs {} warnings that affect {} mean", affected, completed,
                    one ? "has" : "have", one ? "its" : "their");
    const auto share = affected_share(all);
    if (!share) return who + "; by how much was not measured";
    const double percent = 100.0 * *share;
    return who + (percent < 9.95 ? fmt::format(", by up to {:.2g} %", percent)
                                 : fmt::format(", by up to {:.0f} %", percent));
}

std::string affected_section(const Sweep& sweep, const std::filesystem::path& page) {
    const std::string line = affected_line(sweep);
    if (line.empty()) return "";
    std::string rows;
    std::size_t count = 0;
    for (const SweepRun& run : sweep.runs)
        for (const Warning& w : affecting(run))
            // all are counted, the first ones are listed
            if (count++ < kMostListed)
                rows += "<li>" + link_to_run(run, run.name, page) + ": " + escape(with_verdict(w)) +
                        "</li>\n";
    if (count > kMostListed)
        rows +=
            fmt::format("<li>and {} more: see the reports of the runs</li>\n", count - kMostListed);
    return "<section id=\"affected\" class=\"warnings\">\n<details><summary>" + escape(line) +
           "</summary>\n<ul>\n" + rows + "</ul></details>\n</section>\n";
}

}  // namespace ice::sweep
