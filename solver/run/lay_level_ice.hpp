// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/case/case.hpp"

namespace ice {

/// The case with the ice of [level_ice] laid: two more groups, of pieces held until they bend and
/// of the ice around them that never moves. Unchanged where the case has no level ice.
///
/// The sheet is broken by geometry along the ship's course (break_sheet()), with the hull's outline
/// at the height of the ice's upper face; where the ship is free in surge, to the sheet's end.
/// icefield fills the pieces with spheres. The field is kept beside the hull's sphere set under a
/// name made from all that it depends on, and read again by later runs.
/// @throws Error (exit code 2) naming level_ice where the ship meets no ice; (1) where
/// icefield fails
Case with_level_ice(const Case& parameters);

}  // namespace ice
