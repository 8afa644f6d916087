// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/views/load_view.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "postprocess/views/axis.hpp"
#include "postprocess/views/depth_map.hpp"
#include "postprocess/views/hull_drawing.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::views {

namespace {

// Steps of the colour scale from 0 to its end [-]: more steps cannot be told apart by eye and add
// paths to the page.
constexpr int kSteps = 20;
// Least cosine between a face's normal and the way to the viewer [-]: faces that are turned away by
// more than 87 degrees are left bare. Smaller, they fleck the outline; larger, the ship's sides
// lose their loads.
constexpr double kEdgeOn = 0.05;
// Cells of the picture that have one colour [px]. Halving them makes four times as many to test and
// about twice the bytes; larger ones show as steps along the outline.
constexpr double kCell = 3.0;
constexpr double kMapLeft = 52.0, kMapRight = 10.0, kMapTop = 26.0,
                 kMapBottom = 40.0;  // margins [px]
const HullColours kBare{{222, 226, 230}, {236, 239, 241}};

// the viewer's ramp (web/src/colours.js)
std::string load_colour(double x) {
    // Light to dark and grey to violet: the order is seen in grey prints, and by colour-blind
    // people.
    static const Eigen::Vector3d stops[] = {
        {214, 219, 224}, {250, 212, 120}, {238, 120, 60}, {176, 42, 90}, {66, 10, 104}};
    const double at = std::clamp(x, 0.0, 1.0) * 4.0;
    const int k = std::min(3, static_cast<int>(at));
    const Eigen::Vector3d c = stops[k] + (at - k) * (stops[k + 1] - stops[k]);
    return shade(c.array().round().cast<int>().matrix(), 1.0);
}

// linear; a step of 0 has the hull's own colour
int step_of(double load, double end) {
    return std::min(kSteps, static_cast<int>(kSteps * load / end));
}
std::string step_colour(int step) { return load_colour(static_cast<double>(step) / kSteps); }

// Cells of the picture by the load of the face seen there; cells of one colour in a row are one
// piece, and all pieces of a colour one path.
std::string draw_loads(const HullLoad& hull, const Projection& projection, const PageScale& scale,
                       const Eigen::AlignedBox3d& page) {
    const double cell = kCell / scale.per_metre;
    const auto columns = static_cast<int>(page.sizes().x() / cell) + 1;
    const auto rows = static_cast<int>(page.sizes().y() / cell) + 1;
    // finer than the cells, so that each cell's middle has a face
    const DepthMap seen(hull.mesh, projection, 2 * std::max(columns, rows));
    std::map<int, std::string> paths;
    for (int row = 0; row < rows; ++row) {
        const double up = page.max().y() - (row + 0.5) * cell;
        const auto step_at = [&](int column) {
            const auto t = seen.triangle(page.min().x() + (column + 0.5) * cell, up);
            // The load of the face that the viewer sees in this cell. A path per triangle would be
            // exact, but is far longer.
            // a face seen nearly edge-on would show as flecks along the outline
            if (!t || hull.mesh.area_vector(*t).normalized().dot(projection.toward) < kEdgeOn)
                return 0;
            return step_of(hull.load[*t], hull.scale_end);
        };
        for (int column = 0, end = 0; column < columns; column = end) {
            const int step = step_at(column);
            for (end = column + 1; end < columns && step_at(end) == step; ++end) {
            }
            if (step == 0) continue;
            const Vec2 corner = scale.pixel(page.min().x() + column * cell, up + 0.5 * cell);
            paths[step] += fmt::format("M{} {}h{}v{}h-{}z", pixels(corner.x()), pixels(corner.y()),
                                       pixels((end - column) * kCell), pixels(kCell),
                                       pixels((end - column) * kCell));
        }
    }
    std::string out;
    for (const auto& [step, data] : paths)
        out += fmt::format("<path d=\"{}\" fill=\"{}\"/>\n", data, step_colour(step));
    return out;
}

// which way is port or the bow: jams are often on one side only
std::string name_sides(ViewFrom from) {
    switch (from) {
        case ViewFrom::below:
            return " (starboard up, port down)";
        case ViewFrom::front:
            return " (starboard left, port right)";
        case ViewFrom::port:
            return " (bow left)";
        case ViewFrom::side:
            return " (bow right)";
        default:
            return "";
    }
}

}  // namespace

std::string draw_load_view(const HullLoad& hull, ViewFrom from, double width) {
    const Projection projection = projection_of(from);
    Eigen::AlignedBox3d page;
    for (const Vec3& v : hull.mesh.vertices) page.extend(projection.apply(v));
    // 3 % of room on all sides, and one scale along both axes: the picture keeps the hull's
    // proportions
    const double room = 0.03 * std::max(page.sizes().x(), page.sizes().y());
    const double left = page.min().x() - room, right = page.max().x() + room;
    const double low = page.min().y() - room, high = page.max().y() + room;
    // as wide as the page, and at most about half as high
    const double per_metre =
        std::min((width - kMapLeft - kMapRight) / (right - left), 0.55 * width / (high - low));
    const double wide = per_metre * (right - left), tall = per_metre * (high - low);
    const PageScale scale{left, high, kMapLeft, kMapTop, per_metre};

    const std::string title = view_caption(from) + name_sides(from);
    std::string out = svg_open(kMapLeft + wide + kMapRight, kMapTop + tall + kMapBottom, title);
    out += text_element(kMapLeft, 17.0, title, "start", "font-weight=\"600\"");
    const bool below = from == ViewFrom::below;
    Axis x{left, right, kMapLeft, kMapLeft + wide};
    // seen from port or below an axis runs the other way
    if (from == ViewFrom::port) x = {-left, -right, kMapLeft, kMapLeft + wide};
    Axis y{low, high, kMapTop + tall, kMapTop};
    if (below) y = {-low, -high, kMapTop + tall, kMapTop};
    out += draw_axes(x, y,
                     from == ViewFrom::front ? "y on the ship [m], to port" : "x on the ship [m]",
                     below ? "y on the ship [m]" : "z on the ship [m]");
    out += draw_hull_faces(hull.hull, projection, scale, hull.waterline, kBare);
    if (hull.scale_end > 0.0) out += draw_loads(hull, projection, scale, page);
    out += draw_hull_lines(hull.hull, projection, scale, hull.waterline);
    return out + "</svg>\n";
}

std::string draw_load_legend(const std::string& half, const std::string& end,
                             const std::string& unit, const std::string& what) {
    const double left = 20.0, box = 12.0;
    std::string out = svg_open(340.0, 60.0, "Meaning of the colours");
    out += text_element(left, 14.0, what + " [" + unit + "], linear scale", "start");
    for (int k = 0; k <= kSteps; ++k)
        out += fmt::format("<rect x=\"{}\" y=\"22\" width=\"{}\" height=\"14\" fill=\"{}\"/>\n",
                           pixels(left + k * box), pixels(box), step_colour(k));
    // the last box is for all loads above the end
    out += text_element(left, 52.0, "0", "middle");
    out += text_element(left + 0.5 * kSteps * box, 52.0, half, "middle");
    out += text_element(left + kSteps * box, 52.0, "\u2265 " + end, "middle");
    return out + "</svg>\n";
}

}  // namespace ice::views
