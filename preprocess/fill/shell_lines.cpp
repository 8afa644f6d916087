// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/shell_lines.hpp"

#include <algorithm>

#include "common/base/parallel.hpp"
#include "preprocess/fill/edge_chains.hpp"
#include "preprocess/fill/mirror_seat.hpp"
#include "preprocess/fill/point_grid.hpp"

namespace ice {

namespace {

// In units of the spacing.
constexpr double kSeparation = 0.5;  // between spheres of different edges
constexpr double kMirrorGap = 0.25;  // half of it: a sphere and its image

using Line = std::vector<Vec3>;

// In 2D the outline is all of the surface: most of it is no crease.
std::optional<Seat> settle_on_line(const SurfaceTree& tree, const ShellOptions& o,
                                   const Vec3& start) {
    if (o.dimension == 3) return settle_in_crease(tree, start, o.radius);
    auto seat = settle(tree, start, o.radius);
    if (seat) find_crease(tree, o.radius, *seat);
    return seat;
}

using Seats = std::vector<std::optional<Seat>>;

Seats settle_starts(const SurfaceTree& tree, const ShellOptions& o, const Line& starts) {
    Seats seats(starts.size());
    parallel_for(starts.size(), 4096,
                 [&](std::size_t k) { seats[k] = settle_on_line(tree, o, starts[k]); });
    return seats;
}

// The starts without those that have two neighbours on either side on one straight line: what lies
// between two settled places of a straight edge is settled, too. Two are kept at each end, because
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

// Settled centres along a line of starts, cut where the edge is too sharp for a sphere.
std::vector<Line> settle_line(const SurfaceTree& tree, const ShellOptions& o, const Line& starts) {
    const Seats seats = settle_starts(tree, o, starts);
    std::vector<Line> out(1);
    for (std::size_t k = 0; k < seats.size(); ++k) {
        const auto& seat = seats[k];
        Line& line = out.back();
        const double apart = k > 0 ? (starts[k] - starts[k - 1]).norm() : 0.0;
        const bool jump = seat && !line.empty() &&
                          (seat->center - line.back()).norm() > std::max(o.spacing, 1.5 * apart);
        if ((!seat || jump) && !line.empty()) out.emplace_back();
        if (!seat) continue;
        // the points near a corner all settle in it: equal neighbours are one
        const bool again =
            !out.back().empty() && (seat->center - out.back().back()).norm() <= 1e-7 * o.radius;
        if (!again) out.back().push_back(seat->center);
    }
    return out;
}

// Starts so far on the mirrored side that none settles on this one.
bool is_image(const Line& starts, double radius) {
    return std::all_of(starts.begin(), starts.end(),
                       [&](const Vec3& p) { return p.y() < -0.5 * radius; });
}

class LineSeats {
public:
    LineSeats(const SurfaceTree& tree, const ShellOptions& options)
        : tree_(tree), o_(options), placed_(options.spacing) {}

    void place(const Line& line) {
        for (const Vec3& start : line.size() < 2 ? line : resample(line, o_.spacing)) {
            if (o_.mirror && start.y() < -1e-6 * o_.radius) continue;
            auto seat = settle_on_line(tree_, o_, start);
            if (seat && o_.mirror)
                seat = mirror_seat(tree_, *seat, o_.radius, kMirrorGap * o_.spacing);
            if (!seat) continue;
            const std::span<const Vec3> normals = normals_at(tree_, o_.radius, *seat, found_);
            if (placed_.any_within(seat->center, kSeparation * o_.spacing, [&](std::int32_t k) {
                    return seats_[static_cast<std::size_t>(k)].agrees(normals);
                }))
                continue;
            placed_.add(seat->center);
            seats_.push_back(*seat);
        }
    }
    std::vector<Seat> take() { return std::move(seats_); }

private:
    const SurfaceTree& tree_;
    ShellOptions o_;
    PointGrid placed_;
    std::vector<Seat> seats_;
    std::vector<Vec3> found_;  // scratch
};

}  // namespace

std::vector<Seat> seat_lines(const SurfaceTree& tree, const ShellOptions& options) {
    const double step = options.line_step * options.spacing;
    const auto lines = options.dimension == 2 ? trace_section(tree, options.radius, step)
                                              : trace_sharp_edges(tree, options.radius, step);
    LineSeats seats(tree, options);
    for (const Line& starts : lines) {
        if (options.mirror && is_image(starts, options.radius)) continue;
        for (const Line& line :
             settle_line(tree, options, options.by_ends ? drop_between(starts) : starts))
            seats.place(line);
    }
    return seats.take();
}

}  // namespace ice
