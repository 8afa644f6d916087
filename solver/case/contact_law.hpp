// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>

namespace ice {

/// Default of contact.crushing_pressure in 3D [Pa].
///
/// Rigid contacts jam: one step's impulses then decide a mean. Ice crushes at about 1 MPa over
/// contact areas of a square metre and at a few MPa over smaller ones; between 0.5 and 2 MPa the
/// mean resistance of a pre-sawn channel changes by 5 %. In 2D the paper's rigid ice stays the
/// default: a slice has no contact area that a pressure could be measured on.
constexpr double kCrushingPressure = 1e6;

/// [contact]: bounds of a contact's impulse, and the accuracy of the contact solution.
struct ContactLaw {
    double restitution = 0.3;
    double friction_ship_ice = 0.1, friction_ice_ice = 0.3;
    /// [Pa]; rigid for worlds made in code, while a case file of dimension 3 has
    /// kCrushingPressure unless it says otherwise.
    double crushing_pressure = std::numeric_limits<double>::infinity();
    int iterations = 30;      ///< upper bound per solution; a stage takes up to 5 solutions
    double tolerance = 1e-4;  ///< [m/s]

    /// Does no contact crush, whatever it carries?
    bool is_rigid() const { return std::isinf(crushing_pressure); }
};

}  // namespace ice
