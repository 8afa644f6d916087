// SPDX-License-Identifier: GPL-3.0-or-later
/// Keys of a free ship: [ship], [propulsion], [tow], [mooring].
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <utility>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Degrees of freedom in the order of every list of six: along and about x, y, z.
enum Freedom { surge, sway, heave, roll, pitch, yaw, kFreedoms };

/// Rows (U [m/s], value), U rising: linear between rows, constant outside.
using SpeedCurve = std::vector<std::pair<double, double>>;

/// [ship]. NaN: not given, measured from the hull (solver/ship/ship_body.hpp).
struct ShipKeys {
    std::array<bool, kFreedoms> free{};  ///< the others keep the prescribed course
    double mass = std::numeric_limits<double>::quiet_NaN();  ///< [kg], 2D per metre of breadth
    Vec3 centre_of_gravity = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< [m]
    Vec3 gyration = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());           ///< [m]
    std::array<double, kFreedoms> added_mass{};  ///< share of mass and of moments of inertia [-]
    bool computes_added_mass = false;            ///< from the hull, in place of those shares
    std::filesystem::path matrix;  ///< added mass and damping of another program; empty: none
    /// Share of critical damping [-] where something restores, else [N s/m], [N m s].
    std::array<double, kFreedoms> damping{};

    bool any_free() const {
        return std::any_of(free.begin(), free.end(), [](bool f) { return f; });
    }
    bool turns() const { return free[roll] || free[pitch] || free[yaw]; }
};

/// [propulsion]: one of thrust, table, net thrust, speed hold; NaN and empty: not given.
struct Propulsion {
    double thrust = std::numeric_limits<double>::quiet_NaN();              ///< [N]
    SpeedCurve thrust_table;                                               ///< at speed U [N]
    double bollard_pull = std::numeric_limits<double>::quiet_NaN();        ///< [N]
    double power = std::numeric_limits<double>::quiet_NaN();               ///< delivered [W]
    double propeller_diameter = std::numeric_limits<double>::quiet_NaN();  ///< [m]
    int screws = 1;                                                        ///< 1 to 3
    double open_water_speed = std::numeric_limits<double>::quiet_NaN();    ///< [m/s]
    double hold_speed = std::numeric_limits<double>::quiet_NaN();          ///< [m/s]
    bool hold_heading = false;
    SpeedCurve resistance_table;  ///< in open water [N], where the thrust is not net
};

/// [tow]: a spring and a damper from the ship to a carriage with the speed hull.speed.
struct Tow {
    Vec3 point = Vec3::Zero();  ///< ship frame [m]
    double stiffness = 0.0;     ///< [N/m]; 0: no tow
    double damping = 0.0;       ///< [N s/m]
};

/// [mooring]: linear about the pose at the start, along and about world axes.
struct Mooring {
    std::array<double, kFreedoms> stiffness{};   ///< [N/m], [N m/rad]
    std::array<double, kFreedoms> pretension{};  ///< force there [N], [N m]
};

}  // namespace ice
