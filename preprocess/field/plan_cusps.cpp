// SPDX-License-Identifier: GPL-3.0-or-later
// Pattern "cusps": row after row, each bounded behind by the arcs of the row before.
#include <algorithm>
#include <cmath>

#include "common/base/counter_random.hpp"
#include "common/base/error.hpp"
#include "preprocess/field/plan_floes.hpp"

namespace ice {

namespace {

// Straight pieces of an arc over a whole breaking width [-]: each turns by a few degrees. More give
// smoother cusps with more corners, hence more spheres.
constexpr int kPieces = 8;
// Distance over the width [-] up to which a cusp's end is moved to a knot: edges shorter than that
// have no room for spheres.
constexpr double kSnap = 0.02;

// The edge of the ice behind a row: x over y, straight between knots.
class Front {
public:
    void add(double y, double x) { knots_.push_back({x, y}); }

    double at(double y) const {
        const auto above = std::upper_bound(knots_.begin(), knots_.end(), y,
                                            [](double v, const Vec2& k) { return v < k.y(); });
        if (above == knots_.begin()) return knots_.front().x();
        if (above == knots_.end()) return knots_.back().x();
        const Vec2 &b = *above, &a = *std::prev(above);
        return a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    }

    double snapped(double y, double range) const {
        double best = y, least = range;
        for (const Vec2& knot : knots_)
            if (std::abs(knot.y() - y) < least) {
                least = std::abs(knot.y() - y);
                best = knot.y();
            }
        return best;
    }

    // Its points from y = low to high, the ends included.
    Outline between(double low, double high) const {
        const double apart = 1e-9 * (high - low);
        Outline out{{at(low), low}};
        for (const Vec2& knot : knots_)
            if (knot.y() > low + apart && knot.y() < high - apart) out.push_back(knot);
        out.push_back({at(high), high});
        return out;
    }

private:
    std::vector<Vec2> knots_;  // y rising
};

class CuspMaker {
public:
    explicit CuspMaker(const FieldSpec& spec)
        : s_(spec),
          breadth_(spec.extent[1]),
          across_(count(breadth_, spec.breaking_width)),
          rows_(count(spec.extent[0], spec.breaking_length)),
          width_(breadth_ / across_),
          slope_(std::max(0.0, 1.0 / std::tan(spec.entrance_angle))) {}

    FieldPlan make() {
        if (static_cast<double>(rows_) * across_ > kMostFloes)
            throw bad_input("floes.breaking_length", "needs more than a million cusps",
                            "use longer or wider cusps, or a smaller area");
        FieldPlan plan;
        Front behind = front_of(0, ends_of(0, nullptr));
        for (int row = 1; row <= rows_; ++row) {
            const std::vector<double> ends = ends_of(row, &behind);
            const Front front = front_of(row, ends);
            for (std::size_t k = 0; k + 1 < ends.size(); ++k)
                add_floe(behind, front, ends[k], ends[k + 1], plan);
            behind = front;
        }
        for (const Outline& floe : plan.loose)
            for (const Vec2& corner : floe) plan.area.extend(corner);
        // the sides are where they are, whatever the gaps
        plan.area.extend(Vec2(plan.area.min().x(), s_.origin[1] - 0.5 * breadth_));
        plan.area.extend(Vec2(plan.area.min().x(), s_.origin[1] + 0.5 * breadth_));
        return plan;
    }

private:
    // pieces of about that length in a whole; beyond the most there may be, one more than that
    static int count(double whole, double piece) {
        return static_cast<int>(std::clamp(std::round(whole / piece), 1.0, kMostFloes + 1.0));
    }

    // y where the cusps of a row meet, from one side of the channel to the other
    std::vector<double> ends_of(int row, const Front* behind) const {
        const double low = s_.origin[1] - 0.5 * breadth_;
        const bool odd = row % 2 == 1;
        std::vector<double> ends{low};
        for (int k = 1; k < across_ + (odd ? 1 : 0); ++k) {
            const auto number = (static_cast<std::uint64_t>(row) << 32) + k;
            double y = low + (k - (odd ? 0.5 : 0.0)) * width_;
            y += 0.5 * s_.jitter * width_ *
                 random_offset(static_cast<std::uint64_t>(s_.seed), number);
            // an end a hair beside a knot of the row behind would give a floe an edge too short
            // to be filled
            ends.push_back(behind ? behind->snapped(y, kSnap * width_) : y);
        }
        ends.push_back(low + breadth_);
        return ends;
    }

    double base(int row, double y) const {
        return s_.origin[0] + row * s_.breaking_length +
               slope_ * (0.5 * breadth_ - std::abs(y - s_.origin[1]));
    }

    Front front_of(int row, const std::vector<double>& ends) const {
        Front front;
        front.add(ends[0], base(row, ends[0]));
        for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
            const double half = 0.5 * (ends[k + 1] - ends[k]), middle = ends[k] + half;
            // a narrow cusp is less deep
            const double depth = s_.breaking_depth * std::min(1.0, 2.0 * half / width_);
            const int pieces =
                std::max(2, static_cast<int>(std::lround(kPieces * 2.0 * half / width_)));
            std::vector<double> at;
            for (int p = 1; p < pieces; ++p) at.push_back(middle - half + 2.0 * half * p / pieces);
            const double apex = s_.origin[1];  // of the bow's water line: a corner of its own
            const bool near = std::any_of(at.begin(), at.end(), [&](double y) {
                return std::abs(y - apex) < kSnap * width_;
            });
            if (slope_ > 0.0 && !near && std::abs(apex - middle) < (1.0 - kSnap) * half)
                at.insert(std::upper_bound(at.begin(), at.end(), apex), apex);
            for (const double y : at) front.add(y, base(row, y) + arc(y - middle, half, depth));
            front.add(ends[k + 1], base(row, ends[k + 1]));
        }
        return front;
    }

    // height of a circle's arc above its chord of 2 `half`, at `y` from the middle
    static double arc(double y, double half, double depth) {
        if (depth == 0.0) return 0.0;
        // radius from half the chord and the height: R^2 = half^2 + (R - depth)^2
        const double radius = (half * half + depth * depth) / (2.0 * depth);
        return std::sqrt(radius * radius - y * y) - (radius - depth);
    }

    void add_floe(const Front& behind, const Front& front, double low, double high,
                  FieldPlan& plan) const {
        // no gap towards the sides of the channel
        const double side = s_.origin[1] - 0.5 * breadth_;
        if (low > side) low += 0.5 * s_.gap[1];
        if (high < side + breadth_) high -= 0.5 * s_.gap[1];
        // anticlockwise: along the front from low y to high y, and back along the row behind
        Outline outline = front.between(low, high);
        for (Vec2& p : outline) p.x() -= 0.5 * s_.gap[0];
        Outline back = behind.between(low, high);
        bool open = low < high;
        for (Vec2& p : back) {
            p.x() += 0.5 * s_.gap[0];
            open = open && p.x() < front.at(p.y()) - 0.5 * s_.gap[0];
        }
        if (!open)
            throw bad_input("floes.gap", "leaves nothing of a cusp",
                            "use a smaller gap or less jitter");
        outline.insert(outline.end(), back.rbegin(), back.rend());
        plan.loose.push_back(without_straight_corners(outline));
    }

    const FieldSpec& s_;
    double breadth_;
    int across_, rows_;
    double width_, slope_;
};

}  // namespace

FieldPlan plan_cusps(const FieldSpec& spec) { return CuspMaker(spec).make(); }

}  // namespace ice
