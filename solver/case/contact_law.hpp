// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>

namespace ice {

/// Default of contact.crushing_pressure in 3D [Pa].
///
/// Rigid contacts jam: one step's impulses then decide a mean. Ice crushes at about 1 MPa over
/// contact areas of a square metre and at a few MPa over smaller ones. More makes jams stiffer and
/// notches shallower, less crushes more ice; between 0.5 and 2 MPa the mean resistance of a
/// pre-sawn channel changes by 5 %. In 2D the default is the paper's rigid ice; a pressure may be
/// given there, too: a section is then a length, its area per metre of breadth.
constexpr double kCrushingPressure = 1e6;

/// [contact]: bounds of a contact's impulse, and the accuracy of the contact solution.
struct ContactLaw {
    double restitution = 0.3;  ///< Newton's coefficient e [-], 0 to 1; 0 where ice crushes
    double friction_ship_ice = 0.1, friction_ice_ice = 0.3;  ///< Coulomb's coefficients [-], >= 0
    /// [Pa], inf: rigid; the default for worlds made in code, while a case file of dimension 3 has
    /// kCrushingPressure unless it gives another value.
    double crushing_pressure = std::numeric_limits<double>::infinity();
    /// Upper bound of the sweeps per solution [-]; a stage takes up to 5 solutions. Whichever of it
    /// and `tolerance` is reached first ends a solution.
    int iterations = 30;
    double tolerance = 1e-4;  ///< largest change of a contact's velocity in the last sweep [m/s]

    /// Does no contact crush, whatever it carries?
    bool is_rigid() const { return std::isinf(crushing_pressure); }
};

}  // namespace ice
