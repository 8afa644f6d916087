// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/views/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ice::views {

namespace {

constexpr const char* kGrid = "stroke=\"#dde3e8\" stroke-width=\"1\"";

// Distance of ticks for at most `most` of them over `extent`, in the extent's unit.
double choose_step(double extent, int most) {
    // the next of 1, 2, 5 times a power of ten
    const double raw = extent / std::max(1, most);
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= raw * (1.0 - 1e-9)) return factor * power;
    return 10.0 * power;
}

// Values and labels, about one per 34 px: two lines of text. A smaller distance lets labels
// collide.
std::vector<std::pair<double, std::string>> upright_ticks(const Axis& y) {
    const auto values = choose_ticks(std::min(y.low, y.high), std::max(y.low, y.high),
                                     static_cast<int>((y.from - y.to) / 34.0) + 1);
    const double step = values.size() > 1 ? values[1] - values[0] : 1.0;
    std::vector<std::pair<double, std::string>> ticks;
    for (const double v : values) ticks.emplace_back(v, tick_label(v, step));
    return ticks;
}

}  // namespace

std::vector<double> choose_ticks(double low, double high, int most) {
    if (!(high > low) || !std::isfinite(high - low)) return {low};
    const double step = choose_step(high - low, most);
    std::vector<double> ticks;
    // counted in whole steps: adding steps up would drift
    // a millionth of a step: rounding does not lose a tick that lies on the end of the range
    const double slack = 1e-6;
    for (double k = std::ceil(low / step - slack); k <= high / step + slack; k += 1.0)
        ticks.push_back(k * step);
    return ticks;
}

std::string tick_label(double value, double step) {
    // a value that is 0 but for rounding is 0, not 1e-17
    if (value != 0.0 && std::abs(value) < 1e-9 * step) value = 0.0;
    const double size = std::max(std::abs(value), step);
    // Large and tiny numbers as powers of ten; else as many decimals as the step has.
    if (size >= 1e6 || step < 1e-4) return fmt::format("{:g}", value);
    const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-6)), 0, 6);
    return fmt::format("{:.{}f}", value == 0.0 ? 0.0 : value, decimals);
}

void widen(double& low, double& high) {
    if (!(high > low)) {
        low -= 1.0;
        high += 1.0;
        return;
    }
    // 8 ticks at most: with fewer the rounded ends leave more of the chart empty, with more the
    // axis no longer begins at a number that is easy to read.
    // Ends on ticks: the outermost grid lines are the frame.
    const double step = choose_step(high - low, 8);
    low = std::floor(low / step) * step;
    high = std::ceil(high / step) * step;
}

double label_width(const Axis& y) {
    double widest = 0.0;
    for (const auto& [value, label] : upright_ticks(y))
        widest = std::max(widest, text_width(label));
    return widest;
}

std::string draw_axes(const Axis& x, const Axis& y, const std::string& x_title,
                      const std::string& y_title) {
    std::string out;
    // about one label per 70 px: the width of seven digits with a gap
    const auto xs = choose_ticks(std::min(x.low, x.high), std::max(x.low, x.high),
                                 static_cast<int>((x.to - x.from) / 70.0) + 1);
    const auto step = [](const std::vector<double>& ticks) {
        return ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
    };
    for (const double v : xs) {
        // decades only: labels between them would be unreadable powers
        if (x.logarithmic && v != std::round(v)) continue;
        out += line_element(x.pixel(v), y.from, x.pixel(v), y.to, kGrid);
        const std::string label =
            x.logarithmic ? fmt::format("{:g}", std::pow(10.0, v)) : tick_label(v, step(xs));
        out += text_element(x.pixel(v), y.from + 16.0, label, "middle");
    }
    for (const auto& [v, label] : upright_ticks(y)) {
        out += line_element(x.from, y.pixel(v), x.to, y.pixel(v), kGrid);
        out += text_element(x.from - 6.0, y.pixel(v) + 4.5, label, "end");
    }
    out += text_element(0.5 * (x.from + x.to), y.from + 33.0, x_title, "middle");
    const double middle = 0.5 * (y.from + y.to);
    out += text_element(14.0, middle, y_title, "middle",
                        fmt::format("transform=\"rotate(-90 14 {})\"", pixels(middle)));
    return out;
}

}  // namespace ice::views
