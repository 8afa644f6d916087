// SPDX-License-Identifier: GPL-3.0-or-later
/// The inside of LiveEdge: shapes of tiles and pieces, and the places of slots without ice.
#pragma once

#include <cstdint>
#include <optional>

#include "preprocess/field/fill_prism.hpp"
#include "solver/case/case.hpp"
#include "solver/level_ice/ice_sheet.hpp"
#include "solver/shape/shape.hpp"

namespace ice {

/// How the ice of a case is filled with spheres.
PrismSpec prism_spec(const Case& p);

/// A tile or piece of a sheet, or either of a strip in 2D.
enum class EdgeBody : std::uint8_t { tile, piece, strip };

/// About its centroid; none where no sphere fits, or a corner gets none. An Error there is no fault
/// of the case: such ice is brash.
/// @param outline  [m]
std::optional<Shape> shape_of(const Loop& outline, const PrismSpec& prism, EdgeBody as);

/// Is there room for a sphere in ice of that outline [m]? @param thickness  [m]
bool can_be_filled(const Loop& outline, double thickness);

/// Where a slot without ice is: one beside the other, beyond the sheet [m].
Vec2 parked_at(const Eigen::AlignedBox2d& sheet, double thickness, std::size_t slot);

}  // namespace ice
