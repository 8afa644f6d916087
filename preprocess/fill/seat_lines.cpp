// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/seat_lines.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "common/base/parallel.hpp"
#include "preprocess/fill/corners.hpp"
#include "preprocess/fill/edge_chains.hpp"
#include "preprocess/fill/mirror_seat.hpp"
#include "preprocess/fill/point_grid.hpp"

namespace ice {

namespace {

// Least distance of spheres of different edges that represent the same faces [spacings]. Smaller
// places more spheres where edges meet, larger drops those of edges beside each other.
constexpr double kEdgeSeparation = 0.5;
// By which the separation may be missed [spacings]: without it rounding decides whether a sphere
// just that far from a corner stays. A larger value places spheres nearer by as much.
constexpr double kEdgeRounding = 1e-6;
// A sphere nearer to the centre plane is moved into it [spacings]: half the separation, as its
// image is as far on the other side. Larger moves more spheres, smaller lets a sphere and its image
// come nearer to each other.
constexpr double kEdgeMirrorGap = 0.25;

using Line = std::vector<Vec3>;

// In 2D the outline is all of the surface: most of it is no crease.
std::optional<Seat> settle_on_line(const SurfaceTree& tree, const LayerOptions& o,
                                   const Vec3& start) {
    if (o.dimension == 3) return settle_in_crease(tree, start, o.radius);
    auto seat = settle(tree, start, o.radius);
    if (seat) find_crease(tree, o.radius, *seat);
    return seat;
}

using Seats = std::vector<std::optional<Seat>>;

Seats settle_starts(const SurfaceTree& tree, const LayerOptions& o, const Line& starts) {
    Seats seats(starts.size());
    parallel_for(starts.size(), is_fine_for(tree, o.radius) ? 16 : 4096,
                 [&](std::size_t k) { seats[k] = settle_on_line(tree, o, starts[k]); });
    return seats;
}

// Drops the starts that have two neighbours on either side on one straight line: a place between
// two settled places of a straight edge is settled, too. Two are kept at each end, because
// the first may lie beyond the next face.
Line drop_between(const Line& starts) {
    const auto straight = [&](std::size_t k) {
        const Vec3 in = starts[k] - starts[k - 1], out = starts[k + 1] - starts[k];
        return in.dot(out) > 0.0 && in.cross(out).norm() <= 1e-9 * in.dot(out);
    };
    Line kept;
    for (std::size_t k = 0; k < starts.size(); ++k) {
        const bool between =
            k >= 2 && k + 2 < starts.size() && straight(k - 1) && straight(k) && straight(k + 1);
        if (!between) kept.push_back(starts[k]);
    }
    return kept;
}

// Of starts along many short edges one in a quarter of the usual step.
Line drop_near(const Line& starts, double step) {
    Line kept;
    for (std::size_t k = 0; k < starts.size(); ++k)
        if (k == 0 || k + 1 == starts.size() || (starts[k] - kept.back()).norm() >= 0.25 * step)
            kept.push_back(starts[k]);
    return kept;
}

// Settled centres along an edge, and the edge's direction at each.
struct SettledLine {
    Line centers, directions;
};

// The settled centres of a line of starts, cut where the edge is too sharp for a sphere.
std::vector<SettledLine> settle_line(const SurfaceTree& tree, const LayerOptions& o,
                                     const Line& starts) {
    const Seats seats = settle_starts(tree, o, starts);
    std::vector<SettledLine> out(1);
    for (std::size_t k = 0; k < seats.size(); ++k) {
        const auto& seat = seats[k];
        const Line& line = out.back().centers;
        const double apart = k > 0 ? (starts[k] - starts[k - 1]).norm() : 0.0;
        // a start that settled on another edge ends the line: the path there is no edge
        const bool jump = seat && !line.empty() &&
                          (seat->center - line.back()).norm() > std::max(o.spacing, 1.5 * apart);
        if ((!seat || jump) && !line.empty()) out.emplace_back();
        if (!seat) continue;
        // the points near a corner all settle in it: equal neighbours are one
        const Line& present = out.back().centers;
        const bool again =
            !present.empty() && (seat->center - present.back()).norm() <= 1e-7 * o.radius;
        if (again) continue;
        out.back().centers.push_back(seat->center);
        out.back().directions.push_back(starts[std::min(k + 1, starts.size() - 1)] -
                                        starts[k > 0 ? k - 1 : 0]);
    }
    return out;
}

// Do two of the faces that a seat touches meet in an edge along this direction or against it?
bool is_in_edge(const Seat& seat, const Vec3& direction) {
    // Cosine of 20 degrees [-]: knuckles of one edge. A larger value ends lines at knuckles, a
    // smaller one takes an edge that crosses for the line's own.
    constexpr double kSameEdge = 0.94;
    for (std::size_t i = 0; i + 1 < static_cast<std::size_t>(seat.touches); ++i)
        for (std::size_t j = i + 1; j < static_cast<std::size_t>(seat.touches); ++j) {
            const Vec3 along = seat.touch[i].cross(seat.touch[j]);
            if (std::abs(along.dot(direction)) >= kSameEdge * along.norm() * direction.norm())
                return true;
        }
    return false;
}

// The corner at a line's end. It should end there already, but its last starts, which lie beyond
// the next face or were moved inwards from narrow ones (a chamfer's), may settle short of it or on
// other edges. So from the first centre on, seen from the end, that is in the line's own edge.
std::optional<Seat> find_corner(const SurfaceTree& tree, double radius, const SettledLine& line,
                                double sign) {
    // How far from the end centres may be out of line [radii]. A larger value searches longer, a
    // smaller one misses corners beside wide chamfers.
    constexpr double kStray = 3.0;
    const Line& centers = line.centers;
    for (std::size_t k = centers.size(); k-- > 0;) {
        const double apart = (centers.back() - centers[k]).norm();
        if (apart > kStray * radius) break;
        Seat seat{centers[k], Vec3::UnitZ(), tree.closest(centers[k]).triangle};
        find_crease(tree, radius, seat);
        // beside a short side the end may have settled in the corner at its other end
        if (!is_in_edge(seat, line.directions[k])) continue;
        if (is_corner(seat)) return seat;
        if (seat.touches != 2) continue;
        Vec3 along = seat.touch[0].cross(seat.touch[1]).normalized();
        if (sign * along.dot(line.directions[k]) < 0.0) along = -along;
        return slide_to_corner(tree, radius, seat, along, apart + 2.0 * radius);
    }
    return std::nullopt;
}

// Leads a line on to the corners at both ends; appends these.
void lead_to_corners(const SurfaceTree& tree, double radius, SettledLine& line,
                     std::vector<Seat>& corners) {
    std::array<std::optional<Seat>, 2> found;
    for (const int end : {1, 0}) {
        if (!line.centers.empty())
            found[static_cast<std::size_t>(end)] =
                find_corner(tree, radius, line, end ? 1.0 : -1.0);
        std::reverse(line.centers.begin(), line.centers.end());
        std::reverse(line.directions.begin(), line.directions.end());
    }
    Line& centers = line.centers;
    for (const std::size_t end : {1u, 0u}) {
        if (found[end]) {
            const Vec3& corner = found[end]->center;
            const auto is_other = [&](const Vec3& p) {
                return end == 0 && found[1] && p == found[1]->center;
            };
            while (!centers.empty() && (centers.back() - corner).norm() < radius &&
                   !is_other(centers.back()))
                centers.pop_back();
            // one corner may be both ends
            if (centers.empty() || centers.back() != corner) centers.push_back(corner);
            corners.push_back(*found[end]);
        }
        std::reverse(centers.begin(), centers.end());
    }
}

// Starts so far on the mirrored side that none settles on this one.
bool is_image(const Line& starts, double radius) {
    return std::all_of(starts.begin(), starts.end(),
                       [&](const Vec3& p) { return p.y() < -0.5 * radius; });
}

class LineSeats {
public:
    LineSeats(const SurfaceTree& tree, const LayerOptions& options)
        : tree_(tree), o_(options), placed_(options.spacing) {}

    /// @param corners  seats of some of the line's centres
    void place(const Line& line, const std::vector<Seat>& corners) {
        for (const Vec3& start : line.size() < 2 ? line : resample(line, o_.spacing)) {
            if (o_.mirror && start.y() < -1e-6 * o_.radius) continue;
            const auto corner = std::find_if(corners.begin(), corners.end(),
                                             [&](const Seat& s) { return s.center == start; });
            const auto seat =
                corner != corners.end() ? std::optional(*corner) : settle_on_line(tree_, o_, start);
            if (seat) place(*seat);
        }
    }
    /// Corners that no line's end came to: an end that settled a hair short of its corner leaves
    /// it empty, since starts beyond the next face and narrow faces (a chamfer's) lead astray.
    void add_missing_corners() {
        std::vector<Seat> corners;
        for (std::size_t k = 0, lines = seats_.size(); k < lines; ++k) {
            find_corners_beside(tree_, o_.radius, seats_[k], o_.spacing, corners);
            for (const Seat& corner : corners) place(corner);
        }
    }
    /// All but the spheres placed beside a corner before it was: the corner represents their faces.
    std::vector<Seat> take() {
        std::vector<Seat> out;
        for (const Seat& seat : seats_) {
            const std::span<const Vec3> normals = normals_at(tree_, o_.radius, seat, found_);
            const bool beside = placed_.any_within(
                seat.center, (kEdgeSeparation - kEdgeRounding) * o_.spacing, [&](std::int32_t k) {
                    const Seat& other = seats_[static_cast<std::size_t>(k)];
                    return is_corner(other) && other.agrees(normals);
                });
            if (is_corner(seat) || !beside) out.push_back(seat);
        }
        return out;
    }

private:
    // Of the half y >= 0. Only a corner may lie at any distance from its own image.
    std::optional<Seat> in_half(const Seat& seat) const {
        if (!o_.mirror) return seat;
        if (is_corner(seat) && seat.center.y() > kSameCorner * o_.spacing) return seat;
        return mirror_seat(tree_, seat, o_.radius, kEdgeMirrorGap * o_.spacing);
    }

    // Unless there is one near that represents the same faces, or in a corner touches them.
    void place(const Seat& found) {
        const auto seat = in_half(found);
        if (!seat) return;
        const double separation = is_corner(*seat) ? kSameCorner : kEdgeSeparation;
        const std::span<const Vec3> normals = normals_at(tree_, o_.radius, *seat, found_);
        if (placed_.any_within(seat->center, separation * o_.spacing, [&](std::int32_t k) {
                const Seat& other = seats_[static_cast<std::size_t>(k)];
                return is_corner(*seat) ? touch_the_same(other, *seat) : other.agrees(normals);
            }))
            return;
        placed_.add(seat->center);
        seats_.push_back(*seat);
    }

    const SurfaceTree& tree_;
    LayerOptions o_;
    PointGrid placed_;
    std::vector<Seat> seats_;
    std::vector<Vec3> found_;  // scratch
};

}  // namespace

std::vector<Seat> seat_lines(const SurfaceTree& tree, const LayerOptions& options) {
    const double step = options.line_step * options.spacing;
    const auto lines = options.dimension == 2
                           ? trace_section(tree, options.radius, step)
                           : trace_sharp_edges(tree, options.radius, step, options.sharp);
    LineSeats seats(tree, options);
    std::vector<Seat> corners;
    // On a mesh finer than the spheres starts lie closer than seats, and most would be settled for
    // nothing.
    const bool fine = is_fine_for(tree, options.radius);
    for (const Line& all : lines) {
        const Line starts = fine ? drop_near(all, step) : all;
        if (options.mirror && is_image(starts, options.radius)) continue;
        for (SettledLine& line :
             settle_line(tree, options, options.by_ends ? drop_between(starts) : starts)) {
            corners.clear();
            if (options.dimension == 3) lead_to_corners(tree, options.radius, line, corners);
            seats.place(line.centers, corners);
        }
    }
    // Last: a corner is missing only when no line has reached it.
    if (options.dimension == 3) seats.add_missing_corners();
    return seats.take();
}

}  // namespace ice
