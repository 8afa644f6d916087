// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/neighbours/pair_cache.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

#include "common/base/assert.hpp"
#include "solver/narrow/feature/deep_pair.hpp"
#include "solver/narrow/feature/separation.hpp"

namespace ice {

namespace {

// The skin covers a pair's motion in this many steps, within the bounds below: a thicker skin lists
// more spheres, a thinner one is renewed more often. Half of the largest skin takes 19 % more time
// in the pre-sawn channel; eight steps and 0.9 radii won nothing. Contacts are the same.
constexpr double kLookAhead = 5.0;                          // steps [-]
constexpr double kLeastAngle = 0.0075, kMostAngle = 0.015;  // [rad]
constexpr double kLeastSkin = 0.3, kMostSkin = 0.6;         // of the ice's radius

// |R - R0| is sqrt(8) sin(angle / 2): at least this share of sqrt(2) angle [-] below half a radian.
// Smaller renews lists earlier; nearer to 1 the angle is no bound, and contacts could be missed.
constexpr double kChordShare = 0.99;

// Relative motion and rotation [rad] of a pair since b had the pose (rotation, translation) in a's
// axes.
Skin relative_motion(const PairView& view, const Mat3& rotation, const Vec3& translation) {
    const double turned =
        (view.rotation_ab - rotation).norm() / (kChordShare * std::numbers::sqrt2);
    return {(view.translation_ab - translation).norm() + MotionBounds::lever(view.shape_b) * turned,
            turned};
}

}  // namespace

void PairCache::carry_over(const std::vector<BodyPair>& pairs) {
    if (pairs != lists_.pairs()) lists_.carry_over(pairs, [](std::size_t, std::size_t) {});
}

void PairCache::forget(const std::vector<std::int32_t>& bodies) {
    ICE_ASSERT(std::is_sorted(bodies.begin(), bodies.end()));
    const auto is_one = [&](std::int32_t body) {
        return std::binary_search(bodies.begin(), bodies.end(), body);
    };
    const std::vector<BodyPair>& pairs = lists_.pairs();
    for (std::size_t k = 0; k < pairs.size(); ++k)
        if (is_one(pairs[k].a) || is_one(pairs[k].b)) lists_.drop(k);
}

void PairCache::renew(std::size_t k, const PairView& view, const MotionBounds& motion,
                      const Skin& skin, const Clearance& clearance) {
    Row& row = lists_.row(k);
    row.rotation = view.rotation_ab;
    row.translation = view.translation_ab;
    row.crushed = motion.crushed(view.pair.a) + motion.crushed(view.pair.b);
    row.clearance = clearance;
    row.skin = skin;
    set_clearances(row, view.pair, motion, 0.0, 0.0);
}

// Turns the unused parts of the clearance and of the skin into sums of both bodies' paths: up to
// these their poses need not be compared. `gone` and `turned` are the relative motion since the row
// was renewed.
void PairCache::set_clearances(Row& row, BodyPair pair, const MotionBounds& motion, double gone,
                               double turned) {
    const double now = motion.path(pair.a) + motion.path(pair.b);
    // solids deep in each other have contacts even where no spheres may touch: always
    // measured
    row.path_clearance = row.deep
                             ? -std::numeric_limits<double>::infinity()
                             : now + std::min(row.clearance.spheres, row.clearance.seats) - gone;
    // Stale where the relative motion may exceed the skin: as the sum of paths bounds the
    // motion, the rest of the skin may be spent on it.
    row.path_stale = now + row.skin.distance - gone;
    row.rotation_stale =
        motion.rotation(pair.a) + motion.rotation(pair.b) + row.skin.angle - turned;
}

double PairCache::separation_of_solids(Row& row, const PairView& view, double enough) {
    if (!is_convex_pair(view)) return separation(view, enough, row.axis);  // in several parts
    const auto& [a, b, pose] = solids_of(view);
    // the plane that separated them last mostly still does: one plane instead of all
    const SeparatingAxes& last = row.axes;
    const bool of_a = last.plane_b < 0 || last.face_a >= last.face_b;
    const std::int32_t plane = of_a ? last.plane_a : last.plane_b;
    // Crushing may have numbered the planes anew. That does no harm: a gap along any plane proves
    // that the solids are apart.
    if (plane >= 0 && static_cast<std::size_t>(plane) < (of_a ? a : b).plane_count()) {
        const double gap = gap_along_plane(a, b, pose, of_a ? plane : -1, of_a ? -1 : plane);
        if (gap > enough) return gap;
    }
    row.axes = find_axes(a, b, pose, enough);
    return row.axes.widest();
}

PairCache::State PairCache::state(std::size_t k, const Scene& scene, BodyPair pair,
                                  const MotionBounds& motion, double dt, double margin,
                                  PairRule how) {
    Row& row = lists_.row(k);
    // First without poses: the paths bound the motion since the last comparison.
    const double path = motion.path_after_step(pair.a) + motion.path_after_step(pair.b);
    if (path < std::min(row.path_clearance, row.path_stale) &&
        motion.rotation(pair.a) + motion.rotation(pair.b) < row.rotation_stale)
        return State::separated;
    const PairView view(scene, pair);
    const double closing = dt * closing_speed(scene, pair);
    // Second the solids: where they are apart by more than the step can close, the pair is clear
    // until both paths have used up the rest. The separation shrinks by at most separation_share
    // times the path.
    const double apart =
        (how != PairRule::spheres ? separation_of_solids(row, view, closing + margin)
                                  : separation(view, closing + margin, row.axis)) -
        margin;
    if (apart > closing) {
        row.path_clearance =
            motion.path(pair.a) + motion.path(pair.b) + apart / separation_share(view);
        row.path_stale = row.rotation_stale = std::numeric_limits<double>::infinity();
        return State::separated;
    }
    // Polygons have no list to become stale: they are measured anew in each step.
    if (how != PairRule::spheres) {
        row.path_stale = row.rotation_stale = std::numeric_limits<double>::infinity();
        row.path_clearance = -row.path_stale;
        return State::polygon;
    }
    row.apart = apart + margin;
    row.deep = is_deep(view, row.apart);
    if (row.skin.distance < 0.0) return State::stale;  // never settled
    // Third the skin: how much of it has the motion used up? Crushing moves spheres as motion
    // does.
    const auto [moved, turned] = relative_motion(view, row.rotation, row.translation);
    const double gone = moved + motion.crushed(pair.a) + motion.crushed(pair.b) - row.crushed;
    const double then = gone + closing;
    if (then >= row.skin.distance || turned >= row.skin.angle) return State::stale;
    row.deep = row.deep || gone >= row.clearance.seats;
    set_clearances(row, pair, motion, gone, turned);
    // within the clearance no listed spheres can touch yet
    return row.deep || then >= row.clearance.spheres ? State::listed : State::separated;
}

Skin skin_of(const Scene& scene, BodyPair pair, double dt) {
    const Bodies& b = scene.bodies;
    const auto shape = static_cast<std::size_t>(b.shape[static_cast<std::size_t>(pair.b)]);
    const double radius = scene.shapes[shape].largest_radius, ahead = kLookAhead * dt;
    // a pair that turns uses up the skin by its angle, one that slides by its distance
    const Vec3 turning = b.angular_velocity[pair.b] - b.angular_velocity[pair.a];
    return {std::clamp(ahead * closing_speed(scene, pair), kLeastSkin * radius, kMostSkin * radius),
            std::clamp(ahead * turning.norm(), kLeastAngle, kMostAngle)};
}

bool lasts(const Scene& scene, BodyPair pair, const Skin& skin, double dt) {
    constexpr double kLeastLife = 2.0;  // steps [-]
    return skin.distance > kLeastLife * dt * closing_speed(scene, pair);
}

}  // namespace ice
