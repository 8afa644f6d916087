// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sensitivity/tornado.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "postprocess/views/axis.hpp"
#include "postprocess/views/chart.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::sensitivity {

using views::line_element;
using views::pixels;
using views::text_element;

namespace {

// Width of the chart and ends of its axis [px]: names of inputs are left of kLeft. Larger ones
// leave the page, smaller ones cut long names.
constexpr double kWidth = 860.0, kLeft = 236.0, kRight = 846.0;
// Top of the plot, height of a bar, distance between inputs, room for axis and legend below [px].
constexpr double kTop = 66.0, kBar = 20.0, kBetween = 12.0, kFoot = 76.0;
// Mean width of a letter of the common font at 13 px [px]: labels beside the bars get room by it.
// Too small a value lets long labels leave the chart.
constexpr double kLetter = 7.2;
constexpr const char* kSmall = "font-size=\"11.5\" fill=\"#555\"";
constexpr const char* kModelColor = "#e4e7ea";
constexpr const char* kLargestColor = "#f1f3f5";
constexpr const char* kIntervalColor = "#b9d6ea";

std::string rectangle(double x1, double x2, double top, double bottom, const std::string& more) {
    return fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}/>\n",
                       pixels(std::min(x1, x2)), pixels(top), pixels(std::abs(x2 - x1)),
                       pixels(bottom - top), more);
}

double row_height(const RankedInput& input) {
    return std::max(2.0, static_cast<double>(input.changes.size())) * kBar + kBetween;
}

class Tornado {
public:
    Tornado(const std::vector<RankedInput>& inputs, const Estimate& base,
            const report::ForceUnit& unit, const ModelError& model)
        : inputs_(inputs),
          base_(base),
          unit_(unit),
          model_(model),
          half_(std::isfinite(base.half) ? base.half : 0) {
        // the rows decide the picture's height
        bottom_ = kTop;
        for (const RankedInput& input : inputs) bottom_ += row_height(input);
        choose_range();
    }

    std::string draw() const {
        std::string out =
            views::svg_open(kWidth, bottom_ + kFoot, "Inputs that move the resistance");
        // SVG paints in order: bands, axes, bars, and the line of the mean over all
        if (model_.largest > model_.least)
            out += band(std::abs(base_.mean) * model_.largest, kLargestColor);
        out += band(std::abs(base_.mean) * model_.least, kModelColor) + band(half_, kIntervalColor);
        out += axes();
        double top = kTop;
        for (const RankedInput& input : inputs_) {
            out += row(input, top);
            top += row_height(input);
        }
        const double x = x_.pixel(base_.mean / unit_.newtons);
        out += line_element(x, kTop, x, bottom_, "stroke=\"#222\" stroke-width=\"1.2\"");
        return out + legend() + "</svg>\n";
    }

private:
    // all bars, intervals as long as the bars at most, both bands, and room for the labels
    void choose_range() {
        const double model = std::abs(base_.mean) * model_.largest;
        double low = base_.mean - model, high = base_.mean + model;
        const auto each = [&](const auto& use) {
            for (const RankedInput& input : inputs_)
                for (const Change& change : input.changes)
                    if (std::isfinite(change.resistance.mean)) use(change);
        };
        each([&](const Change& c) {
            low = std::min(low, c.resistance.mean);
            high = std::max(high, c.resistance.mean);
        });
        const double span = high - low;
        double left = low, right = high;
        each([&](const Change& c) {
            const double half = std::isfinite(c.difference.half) ? c.difference.half : 0.0;
            left = std::min(left, std::max(c.resistance.mean - half, low - 0.5 * span));
            right = std::max(right, std::min(c.resistance.mean + half, high + 0.5 * span));
        });
        if (!(right > left)) {  // no force in any run
            left -= unit_.newtons;
            right += unit_.newtons;
        }
        // labels are outside their bars: the longest, as a share of the plot
        std::size_t longest = 1;
        each([&](const Change& c) { longest = std::max(longest, c.label.size()); });
        const double share =
            std::min(0.25, (static_cast<double>(longest) * kLetter + 10.0) / (kRight - kLeft));
        // room r on both sides with r = share * (width + 2 r)
        const double room = share / (1.0 - 2.0 * share) * (right - left);
        x_ = {(left - room) / unit_.newtons, (right + room) / unit_.newtons, kLeft, kRight};
    }

    double place(double force) const {
        return std::clamp(x_.pixel(force / unit_.newtons), kLeft, kRight);
    }

    std::string band(double half, const char* color) const {
        // without an interval of the case there is no band
        if (!(half > 0.0)) return "";
        return rectangle(place(base_.mean - half), place(base_.mean + half), kTop, bottom_,
                         fmt::format("fill=\"{}\"", color));
    }

    std::string axes() const {
        std::string out;
        // Two scales: forces below, per cent of the case's mean above. Both come from one axis, so
        // they cannot disagree.
        const auto ticks = views::choose_ticks(x_.low, x_.high, 8);
        const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
        for (const double v : ticks) {
            out += line_element(x_.pixel(v), kTop, x_.pixel(v), bottom_, "stroke=\"#d3dade\"");
            out += text_element(x_.pixel(v), bottom_ + 16.0, views::tick_label(v, step), "middle");
        }
        out += text_element(0.5 * (kLeft + kRight), bottom_ + 34.0,
                            "resistance [" + unit_.name + "]", "middle");
        const double percent = 0.01 * base_.mean / unit_.newtons;
        const double mean = base_.mean / unit_.newtons;
        // of a mean of zero there are no per cent
        if (percent == 0.0) return out;
        double low = (x_.low - mean) / percent, high = (x_.high - mean) / percent;
        if (low > high) std::swap(low, high);
        for (const double v : views::choose_ticks(low, high, 8)) {
            const double x = x_.pixel(mean + v * percent);
            out += line_element(x, kTop - 5.0, x, kTop, "stroke=\"#555\"");
            out += text_element(x, kTop - 9.0, v == 0.0 ? "0 %" : fmt::format("{:+g} %", v),
                                "middle", kSmall);
        }
        return out;
    }

    std::string row(const RankedInput& input, double top) const {
        std::string out = line_element(8.0, top, kRight, top, "stroke=\"#eef1f3\"");
        const double middle = top + 0.5 * (row_height(input));
        out += text_element(kLeft - 12.0, middle - 3.0, input.name, "end", "font-weight=\"600\"");
        out += text_element(kLeft - 12.0, middle + 12.0, "case: " + input.base, "end", kSmall);
        double y = top + 0.5 * kBetween;
        // a single bar is in the middle of the row
        if (input.changes.size() < 2) y += 0.5 * kBar;
        for (const Change& change : input.changes) {
            out += bar(change, y);
            y += kBar;
        }
        return out;
    }

    std::string bar(const Change& change, double top) const {
        if (!std::isfinite(change.resistance.mean))
            return text_element(place(base_.mean) + 6.0, top + 14.0, change.label + ": no result",
                                "start", kSmall);
        const double end = place(change.resistance.mean), middle = top + 0.5 * kBar;
        // Colour shows the direction; a pale bar may be chance.
        const bool rises = change.difference.mean >= 0.0;
        std::string out = rectangle(
            place(base_.mean), end, top + 3.0, top + kBar - 3.0,
            fmt::format("fill=\"{}\" fill-opacity=\"{}\"", rises ? views::kOrange : views::kBlue,
                        change.significant() ? "1" : "0.35"));
        double low = end, high = end;
        if (std::isfinite(change.difference.half)) {
            low = place(change.resistance.mean - change.difference.half);
            high = place(change.resistance.mean + change.difference.half);
            const char* stroke = "stroke=\"#222\" stroke-width=\"1.2\"";
            out += line_element(low, middle, high, middle, stroke);
            for (const double x : {low, high})
                out += line_element(x, middle - 3.5, x, middle + 3.5, stroke);
        }
        const double label = rises ? high + 6.0 : low - 6.0;
        return out + text_element(label, middle + 4.5, change.label, rises ? "start" : "end");
    }

    std::string legend() const {
        const double y = bottom_ + 48.0;
        const auto entry = [&](double x, const char* color, double opacity,
                               const std::string& text) {
            return rectangle(x, x + 16.0, y, y + 12.0,
                             fmt::format("fill=\"{}\" fill-opacity=\"{}\"", color, opacity)) +
                   text_element(x + 22.0, y + 10.5, text, "start", kSmall);
        };
        std::string out = text_element(8.0, 18.0, "Inputs that move the resistance", "start",
                                       "font-weight=\"600\" font-size=\"15\"");
        out += text_element(kLeft, 38.0, "one input at a time, against the case", "start", kSmall);
        return out + entry(8.0, kIntervalColor, 1.0, "the case's own interval, 95 %") +
               entry(214.0, kModelColor, 1.0,
                     model_.measured ? fmt::format("error in model tests, {:.0f} to {:.0f} %",
                                                   100.0 * model_.least, 100.0 * model_.largest)
                                     : fmt::format("model uncertainty, \u00b1{:g} %, stated",
                                                   100.0 * model_.least)) +
               entry(452.0, views::kOrange, 1.0, "more") + entry(522.0, views::kBlue, 1.0, "less") +
               entry(584.0, "#777777", 0.35, "pale: within the 95 % interval of no change");
    }

    const std::vector<RankedInput>& inputs_;
    Estimate base_;
    const report::ForceUnit& unit_;
    ModelError model_;
    double half_, bottom_ = 0.0;
    views::Axis x_;
};

}  // namespace

std::string draw_tornado(const std::vector<RankedInput>& inputs, const Estimate& base,
                         const report::ForceUnit& unit, const ModelError& model) {
    return Tornado(inputs, base, unit, model).draw();
}

}  // namespace ice::sensitivity
