// SPDX-License-Identifier: GPL-3.0-or-later
/// A first case for a ship and an ice field: everything that follows from them, computed.
#pragma once

#include <filesystem>
#include <string>

namespace ice {

/// Numbers of a drafted case that its files do not contain: lengths and places [m], speed [m/s],
/// times [s]; shares as marked.
struct Draft {
    double draught = 0.0;
    bool draught_from_mesh = false;  ///< the mesh crosses z = 0, which is taken for its water line
    double x = 0.0, y = 0.0;         ///< of the mesh's origin
    double speed = 0.0, duration = 0.0, time_step = 0.0, average_from = 0.0;
    double length = 0.0;                         ///< of the waterline
    double lengths = 0.0;                        ///< travelled, in lengths of the waterline [-]
    double averaged_lengths = 0.0;               ///< of them averaged [-]
    double settled_lengths = 0.0;                ///< of them in ice before the averages [-]
    double clearance = 0.0;                      ///< between the bow and the first ice
    double thickness = 0.0;                      ///< of the first floe
    double ice_from = 0.0, ice_to = 0.0;         ///< along x, of a sheet in the field's place
    double ice_starboard = 0.0, ice_port = 0.0;  ///< along y
};

/// Length of a field that has room for a drafted case's travel, in ship's lengths [-].
inline constexpr double kFieldLengths = 2.5;

/// Computes a case from its sphere sets.
///
/// - Draught: down to the keel from z = 0 where the mesh crosses it, else 0.6 of its depth.
/// - Place: on the field's centre line, the bow two sphere spacings before the first ice.
/// - Speed: 4 kn at 100 m, by Froude's rule, to two digits.
/// - Travel: 2.2 lengths of the waterline in the ice, or the length of the field. Averages begin
///   after the first length in the ice; in a shorter field they are those of the last length, or of
///   the last two thirds.
/// - Time step: the ship moves by a fifth of the smallest sphere's radius in it, rounded down to 1,
///   2 or 5 of a decade.
/// @throws Error (exit code 2) for a field that is too short to be entered, and what building a
///         scene throws
Draft draft_case(const std::filesystem::path& hull, const std::filesystem::path& field);

/// The case file: commented TOML, guesses marked CHECK; as a comment level ice instead.
/// @param hull, field  as the case names them, relative to its folder
std::string draft_text(const Draft& draft, const std::string& hull, const std::string& field);

/// Specification of a field for a ship where the user has none: floes of a twelfth of its length in
/// a channel kFieldLengths times as long and three times as broad as it, 80 % cover, a hundredth
/// of the length thick.
/// @param length, breadth  of the ship [m]
std::string draft_field(double length, double breadth);

}  // namespace ice
