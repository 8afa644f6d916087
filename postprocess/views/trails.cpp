// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/views/trails.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace ice::views {

namespace {

// Height of a line of floe numbers [px], a little above the 13 px text. Less lets numbers of
// neighbouring floes overlap, more moves them farther from their floes.
constexpr double kLine = 14.0;

std::string draw_path(const Trail& trail, double until, const Place& place) {
    std::vector<Vec2> points;
    for (std::size_t k = 0; k < trail.time.size() && trail.time[k] <= until; ++k) {
        const Vec2 p = place(trail.offset[k]);
        // steps below half a pixel only make the file longer
        if (points.empty() || (p - points.back()).norm() > 0.5) points.push_back(p);
    }
    const std::string data = path_data(points, false);
    if (data.empty()) return "";
    return fmt::format(
        "<path d=\"{0}\" fill=\"none\" stroke=\"#fff\" stroke-width=\"3\" opacity=\".7\"/>"
        "<path d=\"{0}\" fill=\"none\" stroke=\"{1}\" stroke-width=\"1.7\"{2}/>\n",
        data, trail.color,
        trail.dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", trail.dash));
}

Eigen::AlignedBox2d box_around(const Vec2& middle, const std::string& text) {
    const Vec2 half(0.5 * text_width(text), 0.5 * kLine - 0.5);
    return {middle - half, middle + half};
}

// the place nearest to `at`, above or below it, where the text meets no other
Vec2 free_place(const Vec2& at, const std::string& text,
                const std::vector<Eigen::AlignedBox2d>& taken) {
    // 40 places, up to five lines away: beyond, the number is no longer seen to belong to its floe
    // and may overlap
    for (int step = 0; step < 40; ++step) {
        // alternately above and below, a quarter of a line farther each time
        const int away = (step + 1) / 2;
        const double up = (step % 2 == 0 ? -0.25 : 0.25) * kLine * away;
        Vec2 place = at + Vec2(0.0, up);
        const auto box = box_around(place, text);
        if (std::none_of(taken.begin(), taken.end(),
                         [&](const auto& other) { return other.intersects(box); }))
            return place;
    }
    return at;
}

}  // namespace

std::string draw_trails(const RunFrame& frame, const std::vector<Trail>& trails, const Place& place,
                        const Vec2& size) {
    std::string out;
    for (const Trail& trail : trails) out += draw_path(trail, frame.time, place);
    std::vector<Eigen::AlignedBox2d> taken;
    for (const Trail& trail : trails) {
        const auto body = static_cast<std::size_t>(trail.floe - 1);
        if (body >= frame.position.size()) continue;
        const std::string text = std::to_string(trail.floe);
        const Vec2 at = place(frame.position[body] - frame.ship_position);
        // nor is there room for a number that would be cut at the edge
        const Eigen::AlignedBox2d page(Vec2::Zero(), size);
        if (!page.contains(box_around(at, text))) continue;
        const Vec2 there = free_place(at, text, taken);
        taken.push_back(box_around(there, text));
        if ((there - at).norm() > kLine)
            out += line_element(at.x(), at.y(), there.x(), there.y(),
                                fmt::format("stroke=\"{}\" stroke-width=\"0.8\"", trail.color));
        out += text_element(there.x(), there.y() + 4.5, text, "middle",
                            "font-weight=\"700\" stroke=\"#fff\" "
                            "stroke-width=\"3\" paint-order=\"stroke\"");
    }
    return out;
}

TrailLegend draw_trail_legend(const std::vector<Trail>& trails, double width) {
    TrailLegend legend;
    if (trails.empty()) return legend;
    const std::string title = "paths of floes";
    double x = 8.0, y = 13.0;
    legend.svg = text_element(x, y, title, "start");
    legend.rows = 1;
    const double first = x + text_width(title) + 8.0;
    x = first;
    for (const Trail& trail : trails) {
        const std::string text = std::to_string(trail.floe);
        // sample, number and gap; a key that does not fit begins a new row below the first key
        const double wide = 30.0 + text_width(text) + 12.0;
        if (x + wide > width && x > first) {
            x = first;
            y += 18.0;
            ++legend.rows;
        }
        legend.svg +=
            line_element(x, y - 4.0, x + 25.0, y - 4.0,
                         fmt::format("stroke=\"{}\" stroke-width=\"2.2\" stroke-dasharray=\"{}\"",
                                     trail.color, trail.dash.empty() ? "none" : trail.dash));
        legend.svg += text_element(x + 30.0, y, text, "start");
        x += wide;
    }
    return legend;
}

}  // namespace ice::views
