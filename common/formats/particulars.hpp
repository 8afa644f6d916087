// SPDX-License-Identifier: GPL-3.0-or-later
/// Ship, ice and travel of a run in a few numbers.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ice {

/// In all of them: NaN where a quantity cannot be measured, which is null in JSON.
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// The ship at calm water, measured from the mesh (solver/record/measure_particulars.hpp).
struct ShipParticulars {
    double length = kUnknown, breadth = kUnknown;  ///< of the waterline [m]; 2D: length only
    double draught = kUnknown;                     ///< [m]
    double displacement = kUnknown;                ///< [kg]; unknown in 2D
    double stem_angle_deg = kUnknown;      ///< of the stem from the horizontal [deg]; unknown in 2D
    double entrance_angle_deg = kUnknown;  ///< half, of the waterline at the bow [deg]; 3D
    double speed_mean = kUnknown;          ///< over the averaged time [m/s]
    double parallel_length = kUnknown;     ///< of the waterline's full breadth [m]; 3D
    double bow_length = kUnknown;          ///< of the waterline before it [m]; 3D
    /// Motions and drive of a free ship, by their keys in summary.json; else empty.
    std::vector<std::pair<std::string, double>> motion;
    std::optional<bool> stuck;  ///< below 0.1 m/s for 10 s on end, of a free ship
};

/// Sizes of the floes that may move, and the case's values for all ice.
struct IceParticulars {
    double thickness = kUnknown;  ///< of the first floe as it lies [m]
    std::int64_t floes = 0;       ///< count, without unbroken ice, which never moves
    /// Diameters of the circles with the floes' plan areas [m]; 2D: lengths along x.
    double floe_size_min = kUnknown, floe_size_mean = kUnknown, floe_size_max = kUnknown;
    double concentration = kUnknown;  ///< of the field file of all floes [-], else unknown
    double density = kUnknown;        ///< [kg/m3]
    double friction_ship_ice = kUnknown, friction_ice_ice = kUnknown;  ///< coefficients [-]
    /// [Pa]; infinite for rigid ice, which is null in JSON as well
    double crushing_pressure = std::numeric_limits<double>::infinity();
    std::vector<std::string> hold;  ///< release rules in use, as a case file names them
    double water_density = kUnknown, gravity = kUnknown;  ///< [kg/m3], [m/s2]
    /// [Pa], [Pa], [-]: of level ice that breaks; unknown in other cases
    double flexural_strength = kUnknown, elastic_modulus = kUnknown, poisson_ratio = kUnknown;
    std::string bending_model = {};    ///< likewise, "wedge" or "kashtelyan"; "" unknown
    double bending_factor = kUnknown;  ///< likewise, on the breaking load [-]
};

/// Cracks and channel of a sheet of level ice in 3D: means over all pieces of the run.
struct CrackParticulars {
    double pieces = 0.0;                      ///< that broke off, count; of several runs their mean
    double radius = kUnknown;                 ///< distance of the crack from the load [m]
    double characteristic_length = kUnknown;  ///< of the ice plate [m]
    double thickness = kUnknown;              ///< of the sheet [m]
    double opening_deg = kUnknown;            ///< angle of a piece [deg]
    double load = kUnknown;                   ///< that breaks a piece off [N]
    double channel_breadth = kUnknown;        ///< mean over its length [m]

    double per_length() const { return radius / characteristic_length; }
    double per_thickness() const { return radius / thickness; }
};

/// Means over runs; none without runs.
std::optional<CrackParticulars> mean_cracks(const std::vector<CrackParticulars>& runs);

/// Published ranges of both ratios, of ships [-]: as later papers print them, not read in their
/// sources.
inline constexpr const char* kCracksPerLength = "0.1 to 0.4";
inline constexpr const char* kCracksPerThickness = "3 to 10";

/// The release rules in use, "until-hull-contact, never": until when floes are held, which decides
/// up to half of the resistance. "" where they are not known.
std::string release_rule(const IceParticulars& ice);

/// The same with what "never" and "always" make of the ice, for a reader who does not know the
/// case's keys: "until-hull-contact, never (loose)".
std::string release_rule_in_words(const IceParticulars& ice);

/// The ship's travel.
struct TravelParticulars {
    double distance = kUnknown;          ///< [m]
    double lengths = kUnknown;           ///< distance in lengths of the waterline [-]
    double averaged_lengths = kUnknown;  ///< part of it while forces are averaged [-]
};

/// Whether averages are of less than the length that floes need to pass along the hull; false where
/// the length is unknown.
bool is_short(double averaged_lengths);

/// "1.20 ship lengths", with ", less than one" where that is short.
std::string averaged_text(double averaged_lengths);

/// Value of an empirical formula for the same ship and ice.
struct FormulaValue {
    std::string name;       ///< author and year
    std::string part;       ///< of the resistance: "submersion", ..., "total"
    double value = 0.0;     ///< [N]
    bool verified = false;  ///< it gives published values again, or has the user's coefficients
};

}  // namespace ice
