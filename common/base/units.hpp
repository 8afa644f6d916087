// SPDX-License-Identifier: GPL-3.0-or-later
/// Units people write, turned into SI: "2 kn", "80 mm", "1.5 MPa".
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>

namespace ice {

inline constexpr double kKnot = 1852.0 / 3600.0;                       ///< [m/s]
inline constexpr double kDegree = std::numbers::pi / 180.0;            ///< [rad]
inline constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;  ///< [deg/rad], by itself

/// Dimension of a number. `none` is dimensionless and takes no unit, `share` is a part of a whole
/// and may be given in per cent.
enum class Dimension {
    none,
    share,
    length,
    time,
    speed,
    angular_speed,
    acceleration,
    pressure,
    density,
    angle,
    mass,
    force,
    power
};

/// A number with its unit taken into account.
struct Quantity {
    double value;   ///< in SI
    bool has_unit;  ///< false when the text was a bare number, taken as SI
};

/// Reads a number with an optional unit of that dimension, e.g. parse_quantity("80 mm", length).
///
/// "inf" and "nan" are read as such; the caller decides whether they are allowed.
/// @return the value in SI; nothing when the text is no number, has text after the unit, or a unit
///         of another dimension
std::optional<Quantity> parse_quantity(std::string_view text, Dimension dimension);

/// Units accepted for a dimension, for messages: "m, km, cm, mm, ft, in"; "" for none.
std::string unit_names(Dimension dimension);

/// True where the SI unit has a name: not for `none` and `share`.
bool has_unit(Dimension dimension);

/// The SI unit itself: "m", "kg/m3", or "1" for none and share.
std::string_view si_unit(Dimension dimension);

}  // namespace ice
