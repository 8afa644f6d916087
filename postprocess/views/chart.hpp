// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "postprocess/views/svg.hpp"

namespace ice::views {

/// One curve of a chart, already thinned (decimate.hpp).
struct Curve {
    std::string name, color;
    std::vector<Vec2> points;
    double width = 1.2;  ///< of the line [px]
    std::string dash;    ///< SVG dash pattern, e.g. "6 3": tells curves apart without colour
    double opacity = 1.0;
};

/// A line chart over time.
struct Chart {
    std::string title, x_title = "time [s]", y_title;
    std::vector<Curve> curves;
    std::optional<std::pair<double, double>> y_range;   ///< shown; else all; what is beyond is cut
    std::optional<double> level;                        ///< dashed line across, e.g. the mean
    std::string level_name;                             ///< its name in the legend
    std::optional<std::pair<double, double>> averaged;  ///< x range shaded as averaging window
    double width = 560.0, height = 250.0;               ///< [px]
};

/// Draws axes with units, legend and curves as one SVG element; empty charts say "no data".
std::string draw_chart(const Chart& chart);

/// Colours that people with colour-blindness can tell apart (Okabe and Ito 2008).
inline constexpr const char* kBlue = "#0072b2";
inline constexpr const char* kOrange = "#d55e00";
inline constexpr const char* kGreen = "#009e73";
inline constexpr const char* kPurple = "#aa4499";
inline constexpr const char* kBlack = "#222222";

}  // namespace ice::views
