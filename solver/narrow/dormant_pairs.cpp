// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/dormant_pairs.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

#include "solver/narrow/deep_seats.hpp"
#include "solver/narrow/separation.hpp"
#include "solver/narrow/solid_contacts.hpp"

namespace ice {

namespace {

// A pair is looked ahead as far as it goes in so many steps, within these bounds: more keeps more
// spheres, less has to be found anew sooner.
constexpr double kLookAhead = 5.0;
constexpr double kLeastAngle = 0.0075, kMostAngle = 0.015;  // [rad]
constexpr double kLeastShare = 0.3, kMostShare = 0.6;       // of the ice's radius

// Up to so many entries gaps do not matter.
constexpr std::size_t kFewestDormant = 4096;

// How far a pair has gone relative to each other from where b was in a's axes, and turned [rad].
// |R - R0| is sqrt(8) sin(angle / 2), below half a radian at least 0.99 sqrt(2) angle.
Leeway distance_gone(const PairView& view, const Mat3& turn, const Vec3& shift) {
    const double turned = (view.turn - turn).norm() / (0.99 * std::numbers::sqrt2);
    return {(view.shift - shift).norm() + Travel::arm(view.shape_b) * turned, turned};
}

}  // namespace

void DormantPairs::match(const std::vector<BodyPair>& pairs) {
    if (pairs == pairs_) return;
    moved_.assign(pairs.size(), Row{});
    kept_ = 0;
    std::size_t old = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        while (old < pairs_.size() && pairs_[old] < pairs[k]) ++old;
        if (old < pairs_.size() && pairs_[old] == pairs[k]) moved_[k] = rows_[old];
        kept_ += moved_[k].count;
    }
    rows_.swap(moved_);
    pairs_ = pairs;
}

void DormantPairs::keep(std::size_t k, std::span<const SpherePair> near) {
    Row& row = rows_[k];
    kept_ += near.size() - row.count;
    row.count = near.size();
    row.first = near_.size();
    near_.insert(near_.end(), near.begin(), near.end());
    if (near_.size() > kFewestDormant && near_.size() > 2 * kept_) close_gaps();
}

void DormantPairs::close_gaps() {
    moved_near_.clear();
    for (Row& row : rows_) {
        const auto first = near_.begin() + static_cast<std::ptrdiff_t>(row.first);
        row.first = moved_near_.size();
        moved_near_.insert(moved_near_.end(), first,
                           first + static_cast<std::ptrdiff_t>(row.count));
    }
    near_.swap(moved_near_);
}

void DormantPairs::settle(std::size_t k, const PairView& view, const Travel& travel,
                          const Leeway& leeway, double free) {
    Row& row = rows_[k];
    row.turn = view.turn;
    row.shift = view.shift;
    row.crushed = travel.crushed(view.pair.a) + travel.crushed(view.pair.b);
    row.free = free;
    row.leeway = leeway;
    remind(row, view.pair, travel, 0.0, 0.0);
}

// Since it was settled the bodies have gone and turned so much relative to each other; what is left
// they may go separately before that has to be looked at again.
void DormantPairs::remind(Row& row, BodyPair pair, const Travel& travel, double gone,
                          double turned) {
    const double now = travel.way(pair.a) + travel.way(pair.b);
    // what lies deep in each other has contacts even where no spheres may touch
    row.soon_wake = row.deep ? -std::numeric_limits<double>::infinity()
                             : now + std::min(row.free - gone, row.room);
    row.soon_unknown = now + row.leeway.distance - gone;
    row.turn_unknown = travel.turn(pair.a) + travel.turn(pair.b) + row.leeway.angle - turned;
}

void DormantPairs::set_room(std::size_t k, const PairView& view, double room) {
    Row& row = rows_[k];
    row.seat_turn = view.turn;
    row.seat_shift = view.shift;
    row.seat_room = room;
}

double DormantPairs::room_left(const Row& row, const PairView& view, double apart) {
    if (view.shape_a.dimension == 2 || is_convex_pair(view))
        return std::numeric_limits<double>::infinity();  // deep solids are seen by their axis
    if (apart > 0.0) return deep_slack(view);
    if (row.seat_room < 0.0) return row.seat_room;
    return row.seat_room - distance_gone(view, row.seat_turn, row.seat_shift).distance;
}

double DormantPairs::part_solids(Row& row, const PairView& view, double enough) {
    const ConvexPiece &a = view.shape_a.convex, &b = view.shape_b.convex;
    const RelativePose pose{view.turn, view.shift};
    // the plane that parted them last mostly still does
    const SeparatingAxes& last = row.axes;
    if (last.plane_a >= 0 || last.plane_b >= 0) {
        const bool of_a = last.plane_b < 0 || last.face_a >= last.face_b;
        const double gap = gap_along_plane(a, b, pose, of_a ? last.plane_a : -1, last.plane_b);
        if (gap > enough) return gap;
    }
    row.axes = find_axes(a, b, pose, enough);
    return row.axes.widest();
}

DormantPairs::State DormantPairs::look(std::size_t k, const Scene& scene, BodyPair pair,
                                       const Travel& travel, double dt, double margin,
                                       bool polygon) {
    Row& row = rows_[k];
    const double soon = travel.soon(pair.a) + travel.soon(pair.b);
    if (soon < std::min(row.soon_wake, row.soon_unknown) &&
        travel.turn(pair.a) + travel.turn(pair.b) < row.turn_unknown)
        return State::asleep;
    const PairView view(scene, pair);
    const double closing = dt * closing_speed(scene, pair);
    const double apart = (polygon ? part_solids(row, view, closing + margin)
                                  : separation(view, closing + margin, row.axis)) -
                         margin;
    if (apart > closing) {
        row.soon_wake = travel.way(pair.a) + travel.way(pair.b) + apart / separation_share(view);
        row.soon_unknown = row.turn_unknown = std::numeric_limits<double>::infinity();
        return State::asleep;
    }
    if (polygon) {
        row.soon_unknown = row.turn_unknown = std::numeric_limits<double>::infinity();
        row.soon_wake = -row.soon_unknown;
        return State::polygon;
    }
    row.room = room_left(row, view, apart + margin);
    row.deep = is_deep(view, apart + margin) || row.room <= 0.0;
    if (row.leeway.distance < 0.0) return State::unknown;  // never settled
    const auto [moved, turned] = distance_gone(view, row.turn, row.shift);
    const double gone = moved + travel.crushed(pair.a) + travel.crushed(pair.b) - row.crushed;
    const double then = gone + closing;
    if (then >= row.leeway.distance || turned >= row.leeway.angle) return State::unknown;
    remind(row, pair, travel, gone, turned);
    return row.deep || then >= row.free ? State::known : State::asleep;
}

Leeway dormant_leeway(const Scene& scene, BodyPair pair, double dt) {
    const Bodies& b = scene.bodies;
    const auto shape = static_cast<std::size_t>(b.shape[static_cast<std::size_t>(pair.b)]);
    const double radius = scene.shapes[shape].largest_radius, ahead = kLookAhead * dt;
    const Vec3 turning = b.angular_velocity[pair.b] - b.angular_velocity[pair.a];
    return {
        std::clamp(ahead * closing_speed(scene, pair), kLeastShare * radius, kMostShare * radius),
        std::clamp(ahead * turning.norm(), kLeastAngle, kMostAngle)};
}

}  // namespace ice
