// SPDX-License-Identifier: GPL-3.0-or-later
/// Pairs of bodies that meet as solids.
#pragma once

#include "common/math/ordered_products.hpp"
#include "solver/narrow/feature/pair_view.hpp"
#include "solver/narrow/feature/separating_axis.hpp"

namespace ice {

/// How a pair's contacts are found.
enum class PairRule {
    spheres,  ///< by the contact spheres: pairs with the ship or with a floe that is not convex
    solids,   ///< two convex floes: the corners of the polygon in which they meet
    parts,    ///< pieces of level ice, which only the ship crushes: as solids, part by part
};

/// How b moves relative to a in a step, if nothing hinders the two; a's axes.
struct RelativeStep {
    Vec3 shift = Vec3::Zero();  ///< of the point of b that is in a's origin [m]
    Vec3 turn = Vec3::Zero();   ///< [rad]

    /// Of the point of b that is there [m].
    Vec3 at(const Vec3& point) const { return shift + turn.cross(point); }
};

/// Two convex solids and where they are.
struct SolidPair {
    const ConvexPiece &a, &b;
    RelativePose pose;
    RelativeStep step = {};
};
/// Of two bodies, without the ice that floes have crushed. @param dt  time step [s]
inline SolidPair solids_of(const PairView& view, double dt) {
    const Bodies& bodies = view.scene.bodies;
    const auto [a, b] = view.pair;
    const Mat3& axes = bodies.rotation[a];
    const Vec3 turn = dt * ordered_transposed(
                               axes, Vec3(bodies.angular_velocity[b] - bodies.angular_velocity[a]));
    const Vec3 shift =
        dt * ordered_transposed(axes, Vec3(bodies.velocity[b] - bodies.velocity[a])) -
        dt * ordered_transposed(axes, bodies.angular_velocity[b]).cross(view.translation_ab);
    return {view.scene.solid_of(a),
            view.scene.solid_of(b),
            {view.rotation_ab, view.translation_ab},
            {shift, turn}};
}

}  // namespace ice
