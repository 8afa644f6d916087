// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/views/sheet_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <polyclipping/clipper.hpp>

#include "postprocess/views/faces.hpp"
#include "postprocess/views/floe_style.hpp"

namespace ice::views {

namespace {

namespace cl = ClipperLib;

// Clipper works on whole numbers: steps of this length [m]. Coarser is seen in a model of a metre.
constexpr double kStep = 1e-6;
// Parts grow by this share of the ship's length, and by this length at least [m]: far below a
// pixel. Less leaves lines between parts whose common border is rounded.
constexpr double kGrow = 1e-4, kLeastGrow = 1e-3;
// Ice this far from the hull is drawn [ship lengths]: farther than any view shows.
constexpr double kFar = 2.5;

cl::Path to_path(const Loop& loop) {
    cl::Path out;
    for (const Vec2& p : loop)
        out.emplace_back(std::llround(p.x() / kStep), std::llround(p.y() / kStep));
    return out;
}

Loop box_loop(const Eigen::AlignedBox2d& box) {
    const Vec2 &a = box.min(), &b = box.max();
    return {a, {b.x(), a.y()}, b, {a.x(), b.y()}};
}

// A wall of the plate that is turned to the viewer.
struct Wall {
    std::vector<Vec3> corners;
    Vec3 normal;
    double nearness;
};

std::vector<Wall> walls_of(const std::vector<Loop>& loops, double low, double high,
                           const Projection& projection) {
    std::vector<Wall> out;
    for (const Loop& loop : loops)
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const Vec2 &a = loop[k], &b = loop[(k + 1) % loop.size()];
            // outwards: to the right of the way around, of holes as well
            const Vec3 normal = Vec3(b.y() - a.y(), a.x() - b.x(), 0.0).normalized();
            if (!(normal.dot(projection.toward) > 1e-6)) continue;
            const Vec3 middle(0.5 * (a.x() + b.x()), 0.5 * (a.y() + b.y()), 0.5 * (low + high));
            out.push_back({{{a.x(), a.y(), low},
                            {b.x(), b.y(), low},
                            {b.x(), b.y(), high},
                            {a.x(), a.y(), high}},
                           normal,
                           projection.apply(middle).z()});
        }
    std::stable_sort(out.begin(), out.end(),
                     [](const Wall& l, const Wall& r) { return l.nearness < r.nearness; });
    return out;
}

std::string path(const std::string& data, const Vec3& normal, const Projection& projection) {
    return fmt::format("<path d=\"{}\" fill=\"{}\"/>\n", data,
                       shade(floe_style(FloeState::held).color, brightness(normal, projection)));
}

}  // namespace

std::vector<Loop> united(const std::vector<Loop>& loops, double grow,
                         const Eigen::AlignedBox2d& within) {
    cl::ClipperOffset offset;
    for (const Loop& loop : loops) offset.AddPath(to_path(loop), cl::jtMiter, cl::etClosedPolygon);
    cl::Paths all;
    offset.Execute(all, grow / kStep);
    cl::Clipper clipper;
    clipper.AddPaths(all, cl::ptSubject, true);
    clipper.AddPath(to_path(box_loop(within)), cl::ptClip, true);
    cl::Paths cut;
    clipper.Execute(cl::ctIntersection, cut, cl::pftNonZero, cl::pftNonZero);
    std::vector<Loop> out;
    for (const cl::Path& one : cut) {
        out.emplace_back();
        for (const cl::IntPoint& p : one)
            out.back().emplace_back(kStep * static_cast<double>(p.X),
                                    kStep * static_cast<double>(p.Y));
    }
    return out;
}

Sheet::Sheet(const RunHeader& header, const Eigen::AlignedBox3d& hull, ViewFrom from)
    : projection_(projection_of(from)), band_(std::abs(projection_.toward.z()) < 1e-6) {
    const double length = hull.sizes().x(), far = kFar * length;
    grow_ = std::max(kLeastGrow, kGrow * length);
    within_ = {hull.min().head<2>().array() - far, hull.max().head<2>().array() + far};
    // from ahead the ice beside the forebody alone, as of floes
    if (from == ViewFrom::front) {
        within_.min().x() = hull.center().x();
        within_.max().x() = hull.max().x();
    }
    if (header.sheet_group < 0) return;
    for (std::size_t b = 0; b < header.body_group.size(); ++b) {
        if (header.body_group[b] != header.sheet_group) continue;
        const TriangleMesh& mesh =
            header.shapes[static_cast<std::size_t>(header.body_shape[b])].mesh;
        body_.push_back(b);
        outlines_.emplace_back();
        for (const Face& face : make_faces(mesh)) {
            if (face.normal.z() < 0.9) continue;
            outlines_.back().emplace_back();
            for (const Vec3& corner : face.corners)
                outlines_.back().back().push_back(corner.head<2>());
        }
        for (const Vec3& v : mesh.vertices) {
            low_ = std::min(low_, v.z());
            high_ = std::max(high_, v.z());
        }
    }
}

bool Sheet::has(std::size_t body) const {
    return std::binary_search(body_.begin(), body_.end(), body);
}

double Sheet::height(const RunFrame& frame) const {
    return frame.position[body_.front()].z() - frame.ship_position.z();
}

std::vector<Loop> Sheet::outlines(const RunFrame& frame) const {
    std::vector<Loop> all;
    for (std::size_t k = 0; k < body_.size(); ++k) {
        if (frame.state[body_[k]] == FloeState::absent) continue;
        const Vec3 offset = frame.position[body_[k]] - frame.ship_position;
        for (Loop loop : outlines_[k]) {
            for (Vec2& p : loop) p += offset.head<2>();
            all.push_back(std::move(loop));
        }
    }
    return united(all, grow_, within_);
}

std::string Sheet::draw(const RunFrame& frame, const PageScale& scale) const {
    const std::vector<Loop> loops = outlines(frame);
    if (loops.empty()) return "";
    const double low = height(frame) + low_, high = height(frame) + high_;
    const std::vector<Wall> walls = walls_of(loops, low, high, projection_);
    const auto data = [&](const std::vector<Vec3>& corners) {
        std::vector<Vec2> points;
        for (const Vec3& corner : corners) {
            const Vec3 p = projection_.apply(corner);
            points.push_back(scale.pixel(p.x(), p.y()));
        }
        return path_data(points, true);
    };
    std::string out;
    if (band_) {
        // one outline around all walls on the page
        std::vector<Loop> seen;
        Eigen::AlignedBox2d page;
        for (const Wall& wall : walls) {
            seen.emplace_back();
            for (const Vec3& corner : wall.corners) {
                seen.back().push_back(projection_.apply(corner).head<2>());
                page.extend(seen.back().back());
            }
        }
        std::string all;
        for (const Loop& loop : united(seen, grow_, page)) {
            std::vector<Vec2> points;
            for (const Vec2& p : loop) points.push_back(scale.pixel(p.x(), p.y()));
            all += path_data(points, true);
        }
        return path(all, projection_.toward, projection_);
    }
    for (const Wall& wall : walls) out += path(data(wall.corners), wall.normal, projection_);
    // last: seen through a face, the walls behind it are hidden
    const double level = projection_.toward.z() > 0.0 ? high : low;
    std::string face;
    for (const Loop& loop : loops) {
        std::vector<Vec3> corners;
        for (const Vec2& p : loop) corners.emplace_back(p.x(), p.y(), level);
        face += data(corners);
    }
    return out + path(face, projection_.toward, projection_);
}

}  // namespace ice::views
