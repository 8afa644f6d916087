// SPDX-License-Identifier: GPL-3.0-or-later
/// State of all bodies. Body 0 is the ship; floe with id k is body k.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"
#include "solver/flow/water_flow.hpp"
#include "solver/scene/crushed_ice.hpp"
#include "solver/scene/crushed_solids.hpp"
#include "solver/shape/shape.hpp"

namespace ice {

using Quaternion = Eigen::Quaterniond;

/// Moments of inertia in body axes, about the centre of mass.
struct Inertia {
    double density;  ///< for which they hold [kg/m3]
    Mat3 body;       ///< [kg m2]
    Mat3 inverse;    ///< of `body` [1/(kg m2)]; 2D: about y only
    // of floes that move water along (set_added_mass), else unused; `body` has its part of it then
    Mat3 added = Mat3::Zero();           ///< A: added mass in translation [kg]
    Mat3 inverse_excess = Mat3::Zero();  ///< (m + A)^-1 - 1/m, at most 0 [1/kg]
};

/// The ship's response to impulses, in world axes, for the step; all zero for a prescribed course.
///
/// An impulse j [N s] at r [m] from `centre` changes its velocity by inverse_mass j and its angular
/// velocity by inverse_inertia (r x j). The motions that are not free take up the rest of j.
struct ShipResponse {
    bool free = false;                    ///< in any motion; then Bodies::velocity is of `centre`
    Mat3 inverse_mass = Mat3::Zero();     ///< of ship and water that moves along [1/kg]
    Mat3 inverse_inertia = Mat3::Zero();  ///< of the same, about `centre` [1/(kg m2)]
    double least_response = 0.0;          ///< 1 / mass, also of a ship that only turns [1/kg]
    Vec3 centre = Vec3::Zero();           ///< centre of gravity from the mesh's origin [m]; else 0
};

/// Structure of arrays of equal length, one entry by body; arrays of another length say so. In 2D
/// masses, momenta and inertias are per metre of breadth.
///
/// Momentum and angular momentum are the state (docs/method.md, section 1); velocities and world
/// inverse inertias are derived from them at known points of a step. A held floe and the ship have
/// inverse mass and inertia zero: no impulse moves them, but for a free ship (`ship`).
struct Bodies {
    // set by build_scene, constant
    std::vector<std::int32_t> shape;        ///< row of Scene::shapes
    std::vector<std::int32_t> group;        ///< row of Case::floes; -1 for the ship
    std::vector<double> mass;               ///< [kg], 2D per metre of breadth; 0 for the ship
    std::vector<std::int32_t> inertia_row;  ///< row of inertias
    std::vector<Inertia> inertias;          ///< by row; bodies of one shape and density share one
    std::vector<std::int32_t> inertia_of_shape;  ///< by shape: its newest row; -1 for none
    /// Downward load [N] (2D: [N/m]) that breaks a floe off that is held until it bends; inf for
    /// all others. Empty where there are no such floes.
    std::vector<double> breaking_load;

    /// Values of `held`, in checkpoints too: free; immovable until it is released; bent, which is
    /// immovable for the rest of the step, and free with the next one.
    static constexpr std::uint8_t kFree = 0, kHeld = 1, kBent = 2;

    // the state, advanced by integrate/
    std::vector<Vec3> position;           ///< centre of mass; ship: mesh origin [m]
    std::vector<Quaternion> orientation;  ///< body to world
    std::vector<Vec3> momentum;           ///< [kg m/s]
    std::vector<Vec3> angular_momentum;   ///< about the centre of mass, world axes [kg m2/s]
    std::vector<std::uint8_t> held;       ///< kFree, kHeld or kBent
    std::vector<std::int32_t> moving;     ///< floes that are not held, ascending
    /// Held ice moves at a constant velocity (ice.drift_velocity). Set by update_derived().
    bool held_drift = false;

    // derived by update_derived(), changed together by the contact solver
    std::vector<Mat3> rotation;               ///< of `orientation`
    std::vector<Vec3> velocity;               ///< [m/s]
    std::vector<Vec3> angular_velocity;       ///< world axes [rad/s]
    std::vector<double> inverse_mass;         ///< [1/kg]; 0 while held
    std::vector<Mat3> inverse_inertia_world;  ///< R I^-1 R^T [1/(kg m2)]; 0 while held
    /// R ((m + A)^-1 - 1/m) R^T, the change of inverse_mass by added mass [1/kg]; 0 while held.
    /// Empty where water has no inertia.
    std::vector<Mat3> inverse_mass_excess;

    ShipResponse ship;  ///< set by solver/ship at the start of a step

    std::size_t size() const { return shape.size(); }
    /// [N], 2D [N/m]; infinite for floes that do not bend.
    double breaking_load_of(std::size_t i) const {
        return breaking_load.empty() ? std::numeric_limits<double>::infinity() : breaking_load[i];
    }
    /// Is it held until it bends?
    bool is_unbent(std::size_t i) const {
        return !std::isinf(breaking_load_of(i)) && held[i] == kHeld;
    }
    /// Lever arm [m] of a point in world axes, from the point whose velocity velocity[i] is.
    Vec3 arm(std::int32_t i, const Vec3& point) const {
        const Vec3 from_position = point - position[static_cast<std::size_t>(i)];
        return i == 0 && ship.free ? Vec3(from_position - ship.centre) : from_position;
    }
    bool have_added_mass() const { return !inverse_mass_excess.empty(); }
    /// Change of the velocity of floe i by an impulse j [N s] on its centre of mass [m/s].
    Vec3 response(std::size_t i, const Vec3& j) const {
        const Vec3 own = inverse_mass[i] * j;
        return have_added_mass() ? Vec3(own + inverse_mass_excess[i] * j) : own;
    }
    const Inertia& inertia_row_of(std::size_t i) const {
        return inertias[static_cast<std::size_t>(inertia_row[i])];
    }
    const Mat3& inertia(std::size_t i) const {
        return inertias[static_cast<std::size_t>(inertia_row[i])].body;
    }
    const Mat3& inverse_inertia(std::size_t i) const {
        return inertias[static_cast<std::size_t>(inertia_row[i])].inverse;
    }
};

/// Where the ice of a case lay before the first step, seen from above.
struct IceAtStart {
    Eigen::AlignedBox2d loose;  ///< around the floes that may move; empty where there are none
    bool walls = false;         ///< unbroken ice on both sides of them: a channel
    bool closed = false;        ///< unbroken ice across their far end (largest x)
};

/// Everything a step needs of the bodies.
struct Scene {
    int dimension = 3;          ///< 2: motion along x and z and about y alone
    std::vector<Shape> shapes;  ///< by row; row 0: hull
    Bodies bodies;
    CrushedIce crushed;                 ///< at contacts of spheres
    CrushedSolids crushed_solids;       ///< at contacts of two convex floes
    WaterFlow water;                    ///< at rest unless the case says otherwise
    Vec3 ship_velocity = Vec3::Zero();  ///< [m/s]
    IceAtStart start;                   ///< set by build_scene()
    /// Area of the floes over the field's [-]; NaN unless all come from one field file.
    double concentration = std::numeric_limits<double>::quiet_NaN();

    const Shape& shape_of(std::int32_t body) const {
        return shapes[static_cast<std::size_t>(bodies.shape[static_cast<std::size_t>(body)])];
    }
    /// The solid of a convex body without the ice that other floes have crushed, body axes; empty
    /// where the body is not convex.
    const ConvexPiece& solid_of(std::int32_t body) const {
        const ConvexPiece* crushed_solid = crushed_solids.solid_of(body);
        return crushed_solid ? *crushed_solid : shape_of(body).convex;
    }
};

/// Number of the ship among the bodies. Contacts have a < b, so the ship is always their a; loops
/// over floes begin behind it.
constexpr std::size_t kShip = 0;

/// Rotation, velocities and inverse inertia of body `i` from its momenta, equation (2): v = P / m,
/// with added mass R (m + A)^-1 R^T P, and w = R I^-1 R^T L. A held body has inverse mass, inverse
/// inertia and angular velocity zero; its velocity is P / m, which is zero but for ice that drifts.
/// For the ship only the rotation is set: its velocity is prescribed or that of FreeShip.
void update_derived(Bodies& bodies, std::size_t i);

/// Lets a held floe move from now on, with the momentum that it has.
void release(Bodies& bodies, std::size_t i);

/// Makes `moving` anew from `held`.
void list_moving(Bodies& bodies);

/// Kinetic energy of the free floes [J], 2D [J/m]: sum of P.v/2 + L.w/2; held ones count nothing.
double kinetic_energy(const Bodies& bodies);

}  // namespace ice
