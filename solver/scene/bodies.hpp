// SPDX-License-Identifier: GPL-3.0-or-later
/// State of all bodies. Body 0 is the ship; floe with id k is body k.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"
#include "solver/scene/crushed_ice.hpp"
#include "solver/shape/shape.hpp"

namespace ice {

using Quaternion = Eigen::Quaterniond;

/// Structure of arrays, one entry per body.
///
/// Momentum and angular momentum are the state (CONTRACT.md, section 6); velocities and world
/// inverse inertias are derived from them at known points of a step. A held floe and the ship have
/// inverse mass and inertia zero: no impulse moves them.
struct Bodies {
    // set by build_scene, constant
    std::vector<std::int32_t> shape;    ///< row of Scene::shapes
    std::vector<std::int32_t> group;    ///< row of Case::floes; -1 for the ship
    std::vector<double> mass;           ///< [kg], 2D per metre of breadth; 0 for the ship
    std::vector<Mat3> inertia;          ///< body axes, about the centre of mass [kg m2]
    std::vector<Mat3> inverse_inertia;  ///< of `inertia`; 2D: about y only

    // the state, advanced by integrate/
    std::vector<Vec3> position;           ///< centre of mass; ship: mesh origin [m]
    std::vector<Quaternion> orientation;  ///< body to world
    std::vector<Vec3> momentum;           ///< [kg m/s]
    std::vector<Vec3> angular_momentum;   ///< about the centre of mass, world axes [kg m2/s]
    std::vector<std::uint8_t> held;       ///< 1: immovable until released
    std::vector<std::int32_t> moving;     ///< floes that are not held, ascending

    // derived by update_derived(), changed together by the contact solver
    std::vector<Mat3> rotation;               ///< of `orientation`
    std::vector<Vec3> velocity;               ///< [m/s]
    std::vector<Vec3> angular_velocity;       ///< world axes [rad/s]
    std::vector<double> inverse_mass;         ///< [1/kg]; 0 while held
    std::vector<Mat3> inverse_inertia_world;  ///< R I^-1 R^T; 0 while held

    std::size_t size() const { return shape.size(); }
};

/// Everything a step needs of the bodies.
struct Scene {
    int dimension = 3;
    std::vector<Shape> shapes;  ///< row 0: hull
    Bodies bodies;
    CrushedIce crushed;
    Vec3 ship_velocity = Vec3::Zero();
};

constexpr std::size_t kShip = 0;

/// Rotation, velocities and inverse inertia of body `i` from its momenta: v = P / m,
/// w = R I^-1 R^T L. Held bodies get zeros; the ship keeps its prescribed velocity.
void update_derived(Bodies& bodies, std::size_t i);

/// Lets a held floe move from now on.
void release(Bodies& bodies, std::size_t i);

/// Makes `moving` anew from `held`.
void list_moving(Bodies& bodies);

}  // namespace ice
