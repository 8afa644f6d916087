// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sensitivity/write_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "postprocess/report/page.hpp"
#include "postprocess/sensitivity/tornado.hpp"
#include "postprocess/sweep/sweep_columns.hpp"
#include "postprocess/sweep/sweep_tables.hpp"
#include "postprocess/sweep/write_sweep.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::sensitivity {

using report::ForceUnit;
using views::escape;

namespace {

// all a study's texts and charts need
struct Result {
    explicit Result(const Study& study)
        : inputs(rank_inputs(study)),
          base(estimate_ensemble(study.base)),
          unit(choose(study)),
          // the uncertainty of broken ice does not apply in level ice, where the error is known
          model(study.level_ice ? ModelError{kLeastLevelIceError, kLargestLevelIceError, true}
                                : ModelError{kModelUncertainty, kModelUncertainty, false}) {}

    std::vector<RankedInput> inputs;
    Estimate base;
    ForceUnit unit;
    ModelError model;

    // Signed: a share has the direction in which the input changes the resistance.
    std::string percent(double force) const {
        // a mean of 0 has no shares
        return std::isfinite(force) && base.mean != 0.0
                   ? fmt::format("{:+.1f} %", 100.0 * force / std::abs(base.mean))
                   : "n/a";
    }
    std::string with_interval(const Estimate& e) const { return sweep::with_interval(unit, e); }
    // Of the base's mean, in the unit.
    std::string share_of_mean(double share) const { return unit.text(share * std::abs(base.mean)); }

private:
    ForceUnit choose(const Study& study) const {
        // One unit for all charts and tables, by the largest mean of any change.
        double largest = std::abs(base.mean);
        for (const RankedInput& input : inputs)
            for (const Change& change : input.changes)
                if (std::isfinite(change.resistance.mean))
                    largest = std::max(largest, std::abs(change.resistance.mean));
        return report::choose_unit(largest, study.dimension);
    }
};

// With one run there is no scatter between seeds: the sentence names the error on which the
// intervals rest.
std::string sentence_on_seeds(const Study& study) {
    const std::size_t n = study.base.resistance.size();
    return n == 1 ? "one run, its own interval" : fmt::format("{} seeds", n);
}

std::string model_words(const ModelError& model) {
    if (model.measured)
        return fmt::format(
            "{:.0f} to {:.0f} % mean error against model tests in level ice, on top "
            "of it",
            100.0 * model.least, 100.0 * model.largest);
    return fmt::format("\u00b1 {:g} % stated model uncertainty, on top of it", 100.0 * model.least);
}

std::string model_force(const Result& r) {
    return r.model.measured ? r.share_of_mean(r.model.least) + " to " +
                                  r.share_of_mean(r.model.largest) + " " + r.unit.name
                            : "\u00b1 " + r.share_of_mean(r.model.least) + " " + r.unit.name;
}

// Says of the chart's grey bands where they come from.
std::string band_words(const ModelError& model) {
    return model.measured ? "those are the grey bands, the least and the largest mean error "
                            "against model tests (docs/validation-measured.md), and the bars."
                          : "that is the grey band, stated and not computed, and the bars.";
}

// widths in characters, not bytes: all but ASCII here is two bytes wide
std::size_t letters(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    }));
}

std::string aligned(const std::vector<std::vector<std::string>>& rows) {
    // Two passes: a column is as wide as its longest cell. Rows may have different numbers of
    // cells, as only significant ones end in a star.
    std::vector<std::size_t> widths;
    for (const auto& row : rows)
        for (std::size_t k = 0; k < row.size(); ++k) {
            if (widths.size() <= k) widths.push_back(0);
            widths[k] = std::max(widths[k], letters(row[k]));
        }
    std::string out;
    for (const auto& row : rows) {
        std::string line;
        for (std::size_t k = 0; k < row.size(); ++k) {
            const std::string room(widths[k] - letters(row[k]), ' ');
            line +=
                k < 3 ? row[k] + room + "  " : room + row[k] + "  ";  // names left, numbers right
        }
        out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return out;
}

std::vector<std::string> heads(const Result& r) {
    return {"input", "case", "value", "resistance [" + r.unit.name + "]", "difference \u00b1 95 %",
            "share"};
}

std::vector<std::string> cells(const Result& r, const RankedInput& input, const Change& change) {
    return {input.name,
            input.base,
            change.label,
            r.with_interval(change.resistance),
            r.with_interval(change.difference),
            r.percent(change.difference.mean)};
}

std::string cards(const Study& study, const Result& r) {
    const auto card = [](const std::string& number, const std::string& words) {
        return "<div class=\"card\"><b>" + escape(number) + "</b><span>" + escape(words) +
               "</span></div>\n";
    };
    std::string out = "<div class=\"cards\">\n";
    out += card(r.with_interval(r.base) + " " + r.unit.name,
                "the case, 95 %, " + sentence_on_seeds(study));
    out += card(model_force(r), model_words(r.model));
    // inputs are in order of their effect, so the first has the largest
    if (!r.inputs.empty() && r.inputs.front().largest() > 0.0)
        out += card("\u00b1 " + r.unit.text(r.inputs.front().largest()) + " " + r.unit.name,
                    "at most, by " + r.inputs.front().name + " within its range");
    return out + "</div>\n";
}

std::string table_of_changes(const Result& r) {
    std::vector<std::vector<std::string>> rows;
    for (const RankedInput& input : r.inputs)
        for (const Change& change : input.changes) {
            auto row = cells(r, input, change);
            // A star, not a colour: it survives copying and printing.
            if (change.significant()) row.back() += " *";
            rows.push_back(row);
        }
    return report::table(heads(r), rows);
}

std::string table_of_sources(const Study& study, const Result& r) {
    std::vector<std::vector<std::string>> rows;
    for (const RankedInput& input : r.inputs)
        rows.push_back({input.name, input.base, input.source});
    for (const auto& [name, why] : study.left_out) rows.push_back({name, "left out", why});
    return report::table({"Input", "In the case", "Source of its range"}, rows);
}

}  // namespace

std::string make_tornado(const Study& study) {
    const Result r(study);
    return draw_tornado(r.inputs, r.base, r.unit, r.model);
}

std::string study_text(const Study& study) {
    const Result r(study);
    std::string out = study.title + "\n";
    out += fmt::format("  {} {} (95 %, {}); {}: {}\n\n", r.with_interval(r.base), r.unit.name,
                       sentence_on_seeds(study), model_words(r.model), model_force(r));
    // the same rows as the page's, with the star in a column of its own
    std::vector<std::vector<std::string>> rows{heads(r)};
    for (const RankedInput& input : r.inputs)
        for (const Change& change : input.changes) {
            rows.push_back(cells(r, input, change));
            rows.back().push_back(change.significant() ? "*" : "");
        }
    out += aligned(rows) + "\n* the 95 % interval of the difference leaves out zero\n";
    for (const auto& [name, why] : study.left_out)
        out += fmt::format("left out: {}, because {}\n", name, why);
    return out;
}

std::string make_study_page(const Study& study) {
    const Result r(study);
    const std::string faults = sweep::list_faults(study.runs);
    std::string out =
        report::open_page(study.title) + "<header><div class=\"inner\">\n<h1>" +
        escape(study.title) +
        "</h1>\n<p>Inputs that decide the answer: one input at a time, over the range in "
        "which it is not known.</p>\n</div></header>\n<main>\n";
    if (!faults.empty())
        out += "<section id=\"faults\" class=\"warnings\">\n<b>" + escape(faults) +
               "</b>\n</section>\n";
    // The answer first, then the chart, then all numbers, and last where the ranges come from.
    out += cards(study, r);
    out += report::section(
        "tornado", "Inputs that move the resistance",
        "Whiskers: Welch's 95 % interval of the difference from the case, over the seeds; pale "
        "bars "
        "may be no change at all. The interval of the case says how well the mean is known, not "
        "whether the model or the inputs are right: " +
            band_words(r.model),
        "<div class=\"opening\">" + draw_tornado(r.inputs, r.base, r.unit, r.model) + "</div>\n");
    out += report::section("changes", "All values",
                           "* the 95 % interval of the difference leaves out zero.",
                           table_of_changes(r));
    out += report::section("ranges", "Where the ranges come from", "", table_of_sources(study, r));
    return out + "</main>\n" + report::close_page();
}

}  // namespace ice::sensitivity
