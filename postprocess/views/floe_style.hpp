// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/formats/run_data.hpp"

namespace ice::views {

/// Style of the floes of one state.
struct FloeStyle {
    Eigen::Vector3i color;  ///< red, green, blue in [0, 255]
    const char* meaning;    ///< for the legend
};
const FloeStyle& floe_style(FloeState state);

/// Style of the path of the k-th tracked floe, k from 0: ten colours that colour-blind people can
/// tell apart on white (after Tol's "muted" palette, 2021) and three dashes that change with each
/// floe.
struct TrailStyle {
    const char* color;
    const char* dash;  ///< SVG dash pattern, "" for a whole line
};
TrailStyle trail_style(std::size_t k);

/// Colours of the floes' states with their meaning, as SVG of the given width [px], 22 px high.
std::string draw_legend(double width);

}  // namespace ice::views
