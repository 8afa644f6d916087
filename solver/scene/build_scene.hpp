// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

#include "solver/case/case.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Reads the sphere sets of a case and places hull and floes.
///
/// Floes are numbered in the order of the case's groups, x fastest. Their height is floating
/// equilibrium unless a single floe states z. "brick" shifts every other column (along x) by half a
/// floe and its gap along y. "file" takes shapes and places from a field; its unbroken ice comes
/// last.
///
/// @throws Error (exit code 2) naming file or key: set of the wrong dimension, tracked floe that
///         does not exist, floe denser than water without a stated z, more than 10 million floes.
Scene build_scene(const Case& parameters);

/// How a floe begins.
struct FloeStart {
    /// Position of its centre of mass [m]; z is floating equilibrium unless given.
    Vec3 position{0.0, 0.0, std::numeric_limits<double>::quiet_NaN()};
    Quaternion orientation = Quaternion::Identity();  ///< body to world, unit
    Vec3 velocity = Vec3::Zero();                     ///< [m/s]
    Vec3 angular_velocity = Vec3::Zero();             ///< world axes [rad/s]
    Hold hold = Hold::never;  ///< held floes keep their velocity, whatever pushes
};

/// Adds one floe of a shape.
/// @param shape    row of Scene::shapes
/// @param density  [kg/m3]
/// @param group    row of Case::floes
/// @pre start.position.z() is given
/// @return its body index
std::size_t add_floe(Scene& scene, std::int32_t shape, double density, const FloeStart& start,
                     std::int32_t group);

/// An empty scene with the ship in it, upright.
/// @param position  of the mesh's origin [m] @param velocity  [m/s]
Scene make_scene(Shape hull, const Vec3& position, const Vec3& velocity);

}  // namespace ice
