// SPDX-License-Identifier: GPL-3.0-or-later
/// Faults of a sheet of level ice before the first step.
#pragma once

#include <optional>
#include <vector>

#include "common/formats/warning.hpp"
#include "solver/step/step.hpp"

namespace ice {

/// Looks at the sheet of a world that was just built; nothing without one.
/// @return warnings: contact spheres too far apart; a sheet deeper than the hull; one that is so
///         narrow that cracks reach its sides; a hull in the sheet, where allowed
/// @throws Error (exit code 2) where the hull lies in the sheet, with the area and the place of the
///         hull that is clear of it, unless `allow_overlap`
std::vector<Warning> check_sheet(const World& world, bool allow_overlap);

/// Warns, at the end of a run, of a ship that is farther in the sheet than a crack at rest is from
/// its load, and of which no piece has broken off.
std::optional<Warning> warn_of_whole_ice(const World& world);

}  // namespace ice
