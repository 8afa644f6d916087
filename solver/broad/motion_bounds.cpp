// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/broad/motion_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace ice {

namespace {

// A turn by more than this between two updates [rad] counts as any: beyond it the chord of two
// quaternions is no close bound of the angle. Smaller drops neighbour lists of floes that spin
// fast; a step turns a floe by far less.
constexpr double kLargeTurn = 0.5;

// Farther than any two bodies are apart [m]: a path of that length makes every list stale. Any
// larger value gives the same.
constexpr double kAnywhere = 1e9;

// The angle of a turn is at most this many times |q - p| [-]: 2 for small turns and at most 1 %
// more below kLargeTurn, as |q - p| is 2 sin(angle / 4) for the nearer of +-p. Larger renews lists
// earlier; with a smaller one it is no bound, and contacts could be missed.
constexpr double kTurnOfChord = 2.02;

// An upper bound of the angle of the turn from p to q [rad].
double turn_between(const Quaternion& p, const Quaternion& q) {
    const double apart =
        std::min((q.coeffs() - p.coeffs()).norm(), (q.coeffs() + p.coeffs()).norm());
    return apart > 0.5 * kLargeTurn ? kAnywhere : kTurnOfChord * apart;
}

}  // namespace

void MotionBounds::forget(const Scene& scene, const std::vector<std::int32_t>& bodies) {
    for (const std::int32_t body : bodies) {
        const auto i = static_cast<std::size_t>(body);
        if (i >= path_.size()) continue;  // not met yet
        path_[i] = path_after_step_[i] = rotation_[i] = crushed_[i] = 0.0;
        position_[i] = scene.bodies.position[i];
        orientation_[i] = scene.bodies.orientation[i];
    }
}

void MotionBounds::update(const Scene& scene, double dt) {
    const Bodies& b = scene.bodies;
    const std::size_t known = std::min(path_.size(), b.size());
    path_.resize(b.size(), 0.0);
    path_after_step_.resize(b.size(), 0.0);
    rotation_.resize(b.size(), 0.0);
    crushed_.resize(b.size(), 0.0);
    position_.resize(b.size());
    orientation_.resize(b.size());
    // A path grows by |dx| + theta (R + kSurround) in a step (section 9); at the end of the coming
    // step by the present velocities instead of the difference of poses.
    const auto add_motion = [&](std::size_t i) {
        if (i < known) {
            double arm = MotionBounds::lever(scene.shapes[static_cast<std::size_t>(b.shape[i])]);
            const double turn = turn_between(orientation_[i], b.orientation[i]);
            rotation_[i] += turn;
            path_[i] += (b.position[i] - position_[i]).norm() + arm * turn;
            if (i == kShip) arm += b.ship.centre.norm();  // its velocity is of that point
            path_after_step_[i] =
                path_[i] + dt * (b.velocity[i].norm() + arm * b.angular_velocity[i].norm());
        }
        position_[i] = b.position[i];
        orientation_[i] = b.orientation[i];
    };
    for (std::size_t i = known; i < b.size(); ++i) add_motion(i);
    if (known < b.size()) return update(scene, dt);  // path_after_step of those just met
    // a crushed sphere moves in its body as if the body had moved
    for (const CrushedIce::CrushEvent& event : scene.crushed.recent) {
        for (auto* sum : {&path_, &path_after_step_, &crushed_})
            (*sum)[static_cast<std::size_t>(event.body)] += event.depth;
    }
    // Only bodies that can move are measured: the ship, free floes, and held ones that drift.
    add_motion(kShip);
    for (const std::int32_t i : b.moving) add_motion(static_cast<std::size_t>(i));
    for (std::size_t i = 1; b.held_drift && i < b.size(); ++i)
        if (b.held[i]) add_motion(i);
}

}  // namespace ice
