// SPDX-License-Identifier: GPL-3.0-or-later
/// Paths of tracked floes in a picture.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/formats/run_data.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::views {

/// Path of a floe's centre of mass as the ship sees it.
struct Trail {
    std::int32_t floe = 0;     ///< id, from 1
    std::string color, dash;   ///< floe_style.hpp, trail_style()
    std::vector<double> time;  ///< [s], rising
    std::vector<Vec3> offset;  ///< position minus ship position [m]
};

/// Place on the page [px] of a point relative to the ship [m].
using Place = std::function<Vec2(const Vec3&)>;

/// The paths up to the frame's time, then the floes' numbers. A number that would lie on another
/// one moves up or down and keeps a line to its floe; floes outside have none.
/// @param size of the picture [px]
std::string draw_trails(const RunFrame& frame, const std::vector<Trail>& trails, const Place& place,
                        const Vec2& size);

/// Lines and their floes, in rows of the given width [px]; each row is 18 px high.
/// No trails: "", no rows.
struct TrailLegend {
    std::string svg;  ///< elements, the first row's text at y = 13
    int rows = 0;     ///< count
};
TrailLegend draw_trail_legend(const std::vector<Trail>& trails, double width);

}  // namespace ice::views
