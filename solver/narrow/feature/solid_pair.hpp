// SPDX-License-Identifier: GPL-3.0-or-later
/// Pairs of bodies that meet as solids.
#pragma once

#include <cstdint>

#include "common/math/ordered_products.hpp"
#include "solver/narrow/feature/pair_view.hpp"
#include "solver/narrow/feature/separating_axis.hpp"

namespace ice {

/// How a pair's contacts are found.
enum class PairRule {
    spheres,  ///< by the contact spheres: pairs that are none of the following
    solids,   ///< two convex floes, in rigid ice also a convex hull: the corners of the polygon in
              ///< which they meet
    parts,    ///< pieces of level ice, which only the ship crushes: as solids, part by part
};

/// How b moves relative to a in a step, if nothing hinders the two; a's axes.
struct RelativeStep {
    Vec3 shift = Vec3::Zero();  ///< of b's point in a's origin [m]
    Vec3 turn = Vec3::Zero();   ///< [rad]

    /// Displacement of b's point at `point`, relative to a [m].
    Vec3 at(const Vec3& point) const { return shift + turn.cross(point); }
};

/// The motion of a pair in the step; few pairs need it.
class PairStep {
public:
    PairStep() = default;  ///< without motion
    /// @param view  referred to, not copied @param dt  time step [s]
    PairStep(const PairView& view, double dt) : view_(&view), dt_(dt) {}

    RelativeStep relative() const {
        if (view_ == nullptr) return {};
        const Bodies& bodies = view_->scene.bodies;
        const std::int32_t a = view_->pair.a, b = view_->pair.b;
        const Vec3& origin = bodies.position[a];
        const auto velocity_there = [&](std::int32_t i) {
            return Vec3(bodies.velocity[i] +
                        bodies.angular_velocity[i].cross(bodies.arm(i, origin)));
        };
        // turns a velocity into a displacement: the world's axes to a's, times the step
        const auto in_step = [&](const Vec3& velocity) {
            return Vec3(dt_ * ordered_transposed(bodies.rotation[a], velocity));
        };
        return {in_step(velocity_there(b) - velocity_there(a)),
                in_step(bodies.angular_velocity[b] - bodies.angular_velocity[a])};
    }

private:
    const PairView* view_ = nullptr;
    double dt_ = 0.0;
};

/// Two convex solids and where they are.
struct SolidPair {
    const ConvexPiece &a, &b;
    RelativePose pose;
};
/// Of two bodies, without the ice that floes have crushed.
inline SolidPair solids_of(const PairView& view) {
    return {view.scene.solid_of(view.pair.a),
            view.scene.solid_of(view.pair.b),
            {view.rotation_ab, view.translation_ab}};
}

}  // namespace ice
