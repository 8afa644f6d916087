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
    std::vector<Vec2> points;  ///< (x, y) in the units of the axes
    double width = 1.2;        ///< of the line [px]; 0: no line
    std::string dash;          ///< SVG dash pattern, e.g. "6 3": tells curves apart without colour
    double opacity = 1.0;      ///< [-], 0 to 1
    /// Sign at each point: 'o' circle, 's' square, '^' triangle, 'd' diamond, 'v' triangle down,
    /// 'x' cross; 0: none. It, too, tells curves apart without colour.
    char mark = 0;
    bool filled = false;  ///< an area in the colour, without outline, below curves that follow
};

/// A line chart, over time unless its x title says otherwise.
struct Chart {
    std::string title, x_title = "time [s]", y_title;
    std::vector<Curve> curves;
    std::optional<std::pair<double, double>> y_range;   ///< shown; else all; curves are cut there
    std::optional<double> level;                        ///< dashed line across, e.g. the mean
    std::string level_name;                             ///< its name in the legend
    std::optional<std::pair<double, double>> averaged;  ///< x range shaded, the averaged time
    double width = 480.0, height = 240.0;               ///< [px]
    bool x_from_zero = false;                           ///< the x axis includes 0
    /// A second scale above the chart: x times this factor, > 0, with this title, e.g. knots.
    std::optional<std::pair<double, std::string>> top_scale;
    bool x_logarithmic = false;  ///< decades; points need x > 0
};

/// Draws axes with units, legend and curves as one SVG element; empty charts say "no data". The
/// legend takes as many rows as its names need, and the left margin is as wide as the labels.
std::string draw_chart(const Chart& given);

/// Colours that people with colour-blindness can tell apart (Okabe and Ito 2008).
inline constexpr const char* kBlue = "#0072b2";
inline constexpr const char* kOrange = "#d55e00";
inline constexpr const char* kGreen = "#009e73";
inline constexpr const char* kPurple = "#aa4499";
inline constexpr const char* kBlack = "#222222";

}  // namespace ice::views
