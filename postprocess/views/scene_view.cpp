// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/views/scene_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "postprocess/views/axis.hpp"
#include "postprocess/views/chart.hpp"
#include "postprocess/views/depth_map.hpp"
#include "postprocess/views/floe_style.hpp"
#include "postprocess/views/hull_drawing.hpp"
#include "postprocess/views/sheet_drawing.hpp"
#include "postprocess/views/view_window.hpp"

namespace ice::views {

namespace {

// Margins of the plot area [px]: numbers and name of the y axis, half a label, the title, numbers
// and name of the x axis. Smaller ones cut these texts.
constexpr double kLeft = 52.0, kRight = 10.0, kTop = 26.0, kBottom = 40.0;

bool from_a_side(ViewFrom from) { return from == ViewFrom::side || from == ViewFrom::port; }

// One floe to paint.
struct Item {
    std::size_t body;
    double nearness;
    bool before_hull;
};

}  // namespace

struct SceneView::Parts {
    ViewFrom from;
    ViewOptions options;
    bool flat = false;  // a 2D run
    Projection projection;
    Window window{};
    PageScale scale;
    double width = 0.0, height = 0.0;      // of the plot area [px]
    std::vector<std::vector<Face>> faces;  // per shape, body axes
    std::vector<double> radius;            // of each shape about its origin [m]
    std::vector<std::int32_t> body_shape;
    Eigen::AlignedBox3d hull_box;
    std::unique_ptr<DepthMap> depth;
    std::unique_ptr<Sheet> sheet;
    // The hull; of level ice seen from below its wet part, as the sheet hides the dry one.
    std::string hull, dry_hull;

    double nearness_to_hull(const Face& face, const Vec3& at, const Mat3& turn) const;
    std::vector<Item> sort_floes(const RunFrame& frame) const;
    std::string draw_floe(std::size_t body, const RunFrame& frame, bool outlined) const;
    std::string draw_floes(const RunFrame& frame, const std::vector<Trail>& trails) const;
    std::string draw_ship(const char* part, const std::string& drawn) const;
    std::string draw_sheet(const RunFrame& frame, bool nearer) const;
    bool lies_beyond_sheet(std::size_t body, const RunFrame& frame) const;
    std::string draw_frame_axes(const RunFrame& frame) const;
    std::string draw_water() const;
    Vec2 place(const Vec3& offset) const {
        const Vec3 p = projection.apply(offset);
        return scale.pixel(p.x(), p.y());
    }
};

SceneView::SceneView(const RunHeader& header, ViewFrom from, const ViewOptions& options)
    : parts_(std::make_unique<Parts>()) {
    Parts& s = *parts_;
    s.from = from;
    s.options = options;
    s.flat = header.dimension == 2;
    s.projection = projection_of(from);
    s.body_shape = header.body_shape;
    for (std::size_t k = 0; k < header.shapes.size(); ++k) {
        const TriangleMesh& mesh = header.shapes[k].mesh;
        // At most 400 triangles for a floe, which is small in the picture. The hull is drawn once,
        // with all of its faces.
        s.faces.push_back(k == 0 ? std::vector<Face>{} : make_faces(simplify_mesh(mesh, 400)));
        double radius = 0.0;
        for (const Vec3& v : mesh.vertices) radius = std::max(radius, v.norm());
        s.radius.push_back(radius);
    }
    TriangleMesh hull;
    if (!header.shapes.empty()) hull = header.shapes[0].mesh;
    for (const Vec3& v : hull.vertices) s.hull_box.extend(v);
    if (hull.vertices.empty()) s.hull_box = Eigen::AlignedBox3d(Vec3(-5, -1, -1), Vec3(5, 1, 1));

    s.sheet = std::make_unique<Sheet>(header, s.hull_box, from);
    double floe_size = 0.0;
    for (std::size_t b = 0; b < s.body_shape.size(); ++b)
        if (!s.sheet->has(b))
            floe_size = std::max(floe_size, s.radius[static_cast<std::size_t>(s.body_shape[b])]);
    s.window = choose_window(s.hull_box, from, floe_size, options.half_breadth, options.waterline);
    const double across = s.window.right - s.window.left, tall = s.window.top - s.window.bottom;
    // of the given width, but not taller than three quarters of that
    const double room = options.width - kLeft - kRight;
    const double per_metre = std::min(room / across, 0.75 * room / tall);
    s.width = across * per_metre;
    s.height = tall * per_metre;
    s.scale = {s.window.left, s.window.top, 0.0, 0.0, per_metre};
    // Nearness of the visible hull in 400 cells along it: floes are sorted before and behind
    // it by this map, because a hull reaches from before a floe to behind it and has no single
    // distance.
    s.depth = std::make_unique<DepthMap>(hull, s.projection, 400);
    if (s.sheet->exists() && s.projection.toward.z() < -1e-6) {
        const CutMesh cut = cut_mesh(hull, options.waterline);
        s.dry_hull = draw_hull(cut.above, s.projection, s.scale, options.waterline);
        hull = cut.below;
    }
    s.hull = draw_hull(hull, s.projection, s.scale, options.waterline);
}

SceneView::SceneView(SceneView&&) noexcept = default;
SceneView::~SceneView() = default;

std::string SceneView::define_hull() const {
    return fmt::format(
        "<svg width=\"0\" height=\"0\" style=\"position:absolute\" aria-hidden=\"true\"><defs>"
        "<g id=\"{0}\">\n{1}</g><g id=\"{0}-dry\">\n{2}</g></defs></svg>\n",
        escape(parts_->options.hull_id), parts_->hull, parts_->dry_hull);
}

// > 0 when the face is nearer to the viewer than the hull where both are seen
double SceneView::Parts::nearness_to_hull(const Face& face, const Vec3& at,
                                          const Mat3& turn) const {
    double sum = 0.0;
    for (const Vec3& corner : face.corners) {
        const Vec3 p = projection.apply(at + turn * corner);
        const double hull_nearness = depth->nearness(p.x(), p.y());
        // A sum over all corners, not the nearest one: a floe that touches the hull lies partly on
        // both sides.
        if (std::isfinite(hull_nearness)) sum += p.z() - hull_nearness;
    }
    return sum;
}

std::vector<Item> SceneView::Parts::sort_floes(const RunFrame& frame) const {
    std::vector<Item> items;
    for (std::size_t b = 0; b < frame.position.size() && b < body_shape.size(); ++b) {
        if (frame.state[b] == FloeState::absent || sheet->has(b)) continue;
        const auto shape = static_cast<std::size_t>(body_shape[b]);
        const Vec3 offset = frame.position[b] - frame.ship_position;
        const Vec3 p = projection.apply(offset);
        const double r = radius[shape];
        // outside the picture
        if (p.x() + r < window.left || p.x() - r > window.right || p.y() + r < window.bottom ||
            p.y() - r > window.top)
            continue;
        // from ahead: floes beside the forebody, not the whole field in one plane
        if (from == ViewFrom::front &&
            (offset.x() - r > hull_box.max().x() || offset.x() + r < hull_box.center().x()))
            continue;
        const Mat3 turn = frame.orientation[b].toRotationMatrix();
        double nearer = 0.0;
        for (const Face& face : faces[shape]) nearer += nearness_to_hull(face, offset, turn);
        items.push_back({b, p.z(), nearer >= 0.0});
    }
    // Painter's order by the middles of floes. Floes are small and lie in one layer, so middles
    // suffice.
    std::stable_sort(items.begin(), items.end(),
                     [](const Item& a, const Item& b) { return a.nearness < b.nearness; });
    return items;
}

std::string SceneView::Parts::draw_floe(std::size_t body, const RunFrame& frame,
                                        bool outlined) const {
    const auto shape = static_cast<std::size_t>(body_shape[body]);
    const Vec3 offset = frame.position[body] - frame.ship_position;
    const Mat3 turn = frame.orientation[body].toRotationMatrix();
    const FloeState state = frame.state[body];
    const bool touched = frame.contact_force[body].squaredNorm() > 0.0;
    // held floes between viewer and hull would hide it
    const bool veil =
        state == FloeState::held && !flat && (from_a_side(from) || from == ViewFrom::front);
    std::string out;
    for (const Face& face : faces[shape]) {
        const Vec3 normal = turn * face.normal;
        // Faces away from the viewer are hidden by the floe itself, which is convex or nearly so.
        if (normal.dot(projection.toward) <= 1e-6) continue;
        std::vector<Vec2> points;
        for (const Vec3& corner : face.corners) points.push_back(place(offset + turn * corner));
        out += fmt::format("<path d=\"{}\" fill=\"{}\"{}{}/>", path_data(points, true),
                           shade(floe_style(state).color, brightness(normal, projection)),
                           veil ? " opacity=\".45\"" : "",
                           outlined  ? " stroke=\"#111\" stroke-width=\"1.5\""
                           : touched ? " stroke=\"#d55e00\" stroke-width=\"1.3\""
                                     : "");
    }
    return out + "\n";
}

std::string SceneView::Parts::draw_floes(const RunFrame& frame,
                                         const std::vector<Trail>& trails) const {
    const auto items = sort_floes(frame);
    std::string beyond, behind, before;
    for (const Item& item : items) {
        const bool outlined = std::any_of(trails.begin(), trails.end(), [&](const Trail& trail) {
            return trail.floe == static_cast<std::int32_t>(item.body) + 1;
        });
        (lies_beyond_sheet(item.body, frame) ? beyond
         : item.before_hull                  ? before
                                             : behind) += draw_floe(item.body, frame, outlined);
    }
    const std::string open =
        "<g stroke=\"#51697a\" stroke-width=\".5\" stroke-linejoin=\"round\">\n";
    std::string ship = draw_ship("", hull);
    // seen from above the hull would hide the floes under it
    if (from == ViewFrom::top) ship = "<g opacity=\"0.62\">" + ship + "</g>\n";
    if (!sheet->exists()) return open + behind + "</g>\n" + ship + open + before + "</g>\n";
    const std::string dry = dry_hull.empty() ? "" : draw_ship("-dry", dry_hull);
    return dry + open + beyond + draw_sheet(frame, false) + behind + "</g>\n" + ship + open +
           before + draw_sheet(frame, true) + "</g>\n";
}

std::string SceneView::Parts::draw_ship(const char* part, const std::string& drawn) const {
    return options.hull_id.empty()
               ? drawn
               : fmt::format("<use href=\"#{}{}\"/>\n", escape(options.hull_id), part);
}

// From a side and from ahead the sheet is on both sides of the hull, which its nearer half veils.
std::string SceneView::Parts::draw_sheet(const RunFrame& frame, bool nearer) const {
    if (!nearer) return sheet->draw(frame, scale);
    if (flat || !(from_a_side(from) || from == ViewFrom::front)) return "";
    return "<g opacity=\".45\">" + sheet->draw(frame, scale) + "</g>\n";
}

// Seen from above, the floes under the sheet; from below, those on top of it. The sheet hides them,
// wherever their middles are on the page.
bool SceneView::Parts::lies_beyond_sheet(std::size_t body, const RunFrame& frame) const {
    if (!sheet->exists() || std::abs(projection.toward.z()) < 1e-6) return false;
    const double above = frame.position[body].z() - frame.ship_position.z() - sheet->height(frame);
    return above * projection.toward.z() < 0.0;
}

std::string SceneView::Parts::draw_water() const {
    std::string out = fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"#fbfdfe\"/>\n",
                                  pixels(width), pixels(height));
    if (from == ViewFrom::quarter || from == ViewFrom::top || from == ViewFrom::below)
        return fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"#e4f0f7\"/>\n", pixels(width),
                           pixels(height));
    const double y = scale.pixel(0.0, options.waterline).y();
    out += fmt::format("<rect y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#e4f0f7\"/>\n", pixels(y),
                       pixels(width), pixels(std::max(0.0, height - y)));
    return out;
}

std::string SceneView::Parts::draw_frame_axes(const RunFrame& frame) const {
    const Vec3& ship = frame.ship_position;
    // axes have the world's coordinates, the picture moves with the ship
    const double x_shift = from == ViewFrom::front ? ship.y() : ship.x();
    Axis x{window.left + x_shift, window.right + x_shift, kLeft, kLeft + width};
    Axis y{window.bottom, window.top, kTop + height, kTop};
    std::string x_title = "x in the world [m]", y_title = "y [m], to port";
    // From port the bow is on the left: x runs from right to left.
    if (from == ViewFrom::port) {
        x.low = ship.x() - window.left;
        x.high = ship.x() - window.right;
    }
    if (from_a_side(from) || from == ViewFrom::front) {
        y.low -= options.waterline;  // heights above the water
        y.high -= options.waterline;
        y_title = "z [m]";
    } else if (from == ViewFrom::below) {
        // Seen from below port is at the bottom.
        y.low = -(window.bottom) + ship.y();
        y.high = -(window.top) + ship.y();
    } else {
        y.low += ship.y();
        y.high += ship.y();
    }
    if (from == ViewFrom::front) x_title = "y [m], to port";
    return draw_axes(x, y, x_title, y_title);
}

std::string SceneView::draw(const RunFrame& frame, const std::vector<Trail>& trails) const {
    const Parts& s = *parts_;
    const bool oblique = s.from == ViewFrom::quarter;
    const double total_width = kLeft + s.width + kRight;
    const TrailLegend paths =
        draw_trail_legend(s.options.legend ? trails : std::vector<Trail>{}, total_width);
    const double legend = s.options.legend ? 26.0 + 18.0 * paths.rows : 0.0;
    const double total_height = kTop + s.height + (oblique ? 8.0 : kBottom) + legend;
    const std::string title = fmt::format("{}, t = {:.2f} s", view_caption(s.from), frame.time);
    std::string out = svg_open(total_width, total_height, title);
    out += text_element(kLeft, 17.0, title, "start", "font-weight=\"600\"");
    if (!oblique) out += s.draw_frame_axes(frame);
    // the inner svg cuts off floes and paths at the border of the plot area
    out += fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\">\n", pixels(kLeft),
                       pixels(kTop), pixels(s.width), pixels(s.height));
    // back to front: SVG paints later elements over earlier ones
    out += s.draw_water();
    out += s.draw_floes(frame, trails);
    if (from_a_side(s.from) || s.from == ViewFrom::front) {
        const double y = s.scale.pixel(0.0, s.options.waterline).y();
        out += line_element(0.0, y, s.width, y,
                            "stroke=\"#2b7bb9\" stroke-width=\"1\" stroke-dasharray=\"8 3\"");
    }
    out += draw_trails(
        frame, trails, [&](const Vec3& offset) { return s.place(offset); },
        Vec2(s.width, s.height));
    out += "</svg>\n";
    out += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" "
        "stroke=\"#8a949c\"/>\n",
        pixels(kLeft), pixels(kTop), pixels(s.width), pixels(s.height));
    if (s.options.legend)
        out += fmt::format("<svg y=\"{}\">{}</svg>\n<svg y=\"{}\">{}</svg>\n",
                           pixels(total_height - legend), draw_legend(total_width),
                           pixels(total_height - legend + 24.0), paths.svg);
    return out + "</svg>\n";
}

}  // namespace ice::views
