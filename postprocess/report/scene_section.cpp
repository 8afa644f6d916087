// SPDX-License-Identifier: GPL-3.0-or-later
// Drawings of ship and ice at several instants, as many as the page has room for.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/error.hpp"
#include "postprocess/report/page.hpp"
#include "postprocess/report/sections.hpp"
#include "postprocess/views/chart.hpp"
#include "postprocess/views/floe_style.hpp"

namespace ice::report {

using views::SceneView;
using views::ViewFrom;

namespace {

std::size_t nearest_frame(const RunData& run, double time) {
    const auto nearest = std::min_element(
        run.frames.begin(), run.frames.end(), [&](const RunFrame& a, const RunFrame& b) {
            return std::abs(a.time - time) < std::abs(b.time - time);
        });
    return static_cast<std::size_t>(nearest - run.frames.begin());
}

// evenly spaced up to the end; the first moments, when nothing is touched yet, are left out
std::vector<std::size_t> choose_frames(const RunData& run, std::size_t count) {
    std::vector<std::size_t> chosen;
    const double end = run.frames.back().time;
    for (std::size_t k = 1; k <= count; ++k) {
        const std::size_t frame =
            nearest_frame(run, end * static_cast<double>(k) / static_cast<double>(count));
        if (chosen.empty() || chosen.back() != frame) chosen.push_back(frame);
    }
    return chosen;
}

// rows of a list, from its middle outwards
std::vector<std::size_t> middle_first(std::size_t count) {
    std::vector<std::size_t> rows(count);
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    const auto distance = [&](std::size_t k) {
        return k > count / 2 ? k - count / 2 : count / 2 - k;
    };
    std::stable_sort(rows.begin(), rows.end(),
                     [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
    return rows;
}

}  // namespace

views::ViewOptions view_options(const RunData& run) {
    views::ViewOptions options;
    if (run.frames.empty() || run.header.shapes.empty()) return options;
    double length = 10.0, hull_half = 0.0, field_half = 0.0;
    Eigen::AlignedBox3d hull;
    for (const Vec3& v : run.header.shapes[0].mesh.vertices) hull.extend(v);
    if (!hull.isEmpty()) {
        length = hull.sizes().x();
        hull_half = std::max(std::abs(hull.min().y()), std::abs(hull.max().y()));
    }
    // the breadth shown: the hull and some ice beside it, and not more of the field than useful
    const RunFrame& first = run.frames.front();
    for (std::size_t b = 0; b < first.position.size(); ++b) {
        double radius = 0.0;
        const auto shape = static_cast<std::size_t>(run.header.body_shape[b]);
        for (const Vec3& v : run.header.shapes[shape].mesh.vertices)
            radius = std::max(radius, std::abs(v.y()));
        field_half = std::max(field_half,
                              std::abs(first.position[b].y() - first.ship_position.y()) + radius);
    }
    // At least 30 % more than the hull, at most 0.4 of its length: a broader field would make the
    // ship small.
    options.half_breadth = std::max(1.3 * hull_half, std::min(field_half, 0.4 * length));
    options.waterline = -first.ship_position.z();
    return options;
}

std::vector<views::Trail> make_trails(const RunData& run) {
    std::vector<views::Trail> trails;
    for (std::size_t k = 0; k < run.tracks.size(); ++k) {
        views::Trail trail;
        trail.floe = run.header.tracked[k];
        trail.color = views::trail_style(k).color;
        trail.dash = views::trail_style(k).dash;
        // at most about a thousand points of a path are drawn
        const std::size_t count = run.tracks[k].size(), stride = count / 1000 + 1;
        for (std::size_t s = 0; s < count; s += stride) {
            trail.time.push_back(run.tracks[k][s].time);
            trail.offset.emplace_back(run.tracks[k][s].position - run.history[s].ship_position);
        }
        trails.push_back(std::move(trail));
    }
    return trails;
}

std::string draw_view(const RunData& run, ViewFrom from, double time) {
    if (run.frames.empty())
        throw bad_input(run.header.title, "the run has no frames to draw",
                        "set output.frames_every in the case and run it again");
    views::ViewOptions options = view_options(run);
    options.legend = true;
    options.width = 900.0;
    return SceneView(run.header, from, options)
        .draw(run.frames[nearest_frame(run, time)], make_trails(run));
}

namespace {

// Ship and ice at an angle, at the middle instant; "" where the picture has more than `most` bytes.
std::string draw_opening(const RunData& run, const std::vector<std::size_t>& instants,
                         const std::vector<views::Trail>& trails, std::size_t most) {
    views::ViewOptions options = view_options(run);
    options.width = 1000.0;
    std::string picture = SceneView(run.header, ViewFrom::quarter, options)
                              .draw(run.frames[instants[instants.size() / 2]], trails);
    return picture.size() > most ? "" : picture;
}

// The pictures of each instant and the hulls to which they refer. The page's limit in bytes bounds
// their number.
struct Pictures {
    std::vector<std::vector<std::string>> at;  // [instants x views]; empty: left out
    std::string hulls;
    std::size_t dropped = 0;
};

// Views that are drawn in any case, at the last instant: a section without a picture says nothing.
constexpr std::size_t kAlways = 2;

Pictures draw_instants(const RunData& run, const std::vector<SceneView>& views,
                       const std::vector<std::size_t>& instants,
                       const std::vector<views::Trail>& trails, std::size_t used,
                       std::size_t budget) {
    Pictures out;
    out.at.assign(instants.size(), std::vector<std::string>(views.size()));
    std::vector<char> defined(views.size(), 0);
    const auto draw = [&](std::size_t k, std::size_t v, bool always) {
        if (!out.at[k][v].empty()) return;
        std::string picture = views[v].draw(run.frames[instants[k]], trails);
        const std::string hull = defined[v] ? "" : views[v].define_hull();
        // a smaller picture may still fit, so the search continues
        if (!always && used + picture.size() + hull.size() > budget) {
            ++out.dropped;
            return;
        }
        used += picture.size() + hull.size();
        defined[v] = 1;
        out.hulls += hull;
        out.at[k][v] = std::move(picture);
    };
    for (std::size_t v = 0; v < std::min(kAlways, views.size()); ++v)
        draw(instants.size() - 1, v, true);
    // every side at one instant first: the other instants are the first to be left out
    for (const std::size_t k : middle_first(instants.size()))
        for (std::size_t v = 0; v < views.size(); ++v) draw(k, v, false);
    for (auto& group : out.at) std::erase(group, "");
    return out;
}

// A 2D run has one view per instant, which go side by side; a 3D run has a row per instant.
std::string arrange(const RunData& run, const std::vector<std::size_t>& instants,
                    const Pictures& pictures) {
    if (run.header.dimension == 2) {
        std::vector<std::string> all;
        for (const auto& group : pictures.at) all.insert(all.end(), group.begin(), group.end());
        return figures(all);
    }
    std::string rows;
    for (std::size_t k = 0; k < instants.size(); ++k)
        if (!pictures.at[k].empty())
            rows += fmt::format("<h3>t = {:.2f} s</h3>\n", run.frames[instants[k]].time) +
                    figures(pictures.at[k]);
    return rows;
}

}  // namespace

std::string scene_section(const RunData& run, std::size_t budget) {
    if (run.frames.empty()) return "";
    const bool flat = run.header.dimension == 2;
    const auto instants = choose_frames(run, flat ? 6 : 4);
    const auto trails = make_trails(run);
    // from below first: it shows ice under the bottom, which no other view does, and is dropped
    // last
    const std::vector<ViewFrom> sides =
        flat ? std::vector<ViewFrom>{ViewFrom::side}
             : std::vector<ViewFrom>{ViewFrom::below, ViewFrom::top, ViewFrom::side,
                                     ViewFrom::front};
    // a third of the room at most, so that the plain views, which can be measured, keep the rest
    const std::string opening = flat ? "" : draw_opening(run, instants, trails, budget / 3);
    // each view defines the hull once and its pictures refer to it, which keeps the page small
    std::vector<SceneView> views;
    for (std::size_t v = 0; v < sides.size(); ++v) {
        views::ViewOptions options = view_options(run);
        options.hull_id = fmt::format("hull-{}", v);
        views.emplace_back(run.header, sides[v], options);
    }
    const Pictures pictures = draw_instants(run, views, instants, trails, opening.size(), budget);
    std::string body =
        pictures.hulls + "<div class=\"legend\">" + views::draw_legend(640.0) + "</div>\n";
    if (!opening.empty()) body += "<div class=\"opening\">" + opening + "</div>\n";
    body += arrange(run, instants, pictures);
    if (pictures.dropped > 0)
        body += fmt::format(
            "<p>{} more views would make this page too large; draw them with icepost view.</p>\n",
            pictures.dropped);
    return section(
        "drawings", "Hull and ice, drawn",
        "The picture moves with the ship; axes are world coordinates. Paths are those of "
        "tracked floes as seen from the ship; the dashed line is calm water. From ahead "
        "only floes beside the forebody are shown.",
        "<details id=\"views\" open=\"open\"><summary>Views at several instants"
        "</summary>\n" +
            body + "</details>\n");
}

}  // namespace ice::report
