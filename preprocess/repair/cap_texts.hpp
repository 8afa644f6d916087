// SPDX-License-Identifier: GPL-3.0-or-later
/// The report's texts on openings.
#pragma once

#include <string>
#include <vector>

#include "preprocess/repair/close_surface.hpp"

namespace ice {

/// "(x, y, z)" [m], four digits each.
std::string place(const Vec3& at);

/// Warnings on decks, on the largest openings that were closed, and on the volume they leave in
/// doubt where that is over 0.5 %.
std::vector<std::string> cap_warnings(const ClosedSurface& closed);

/// Why a cap that is a guess is refused: the volume that all openings leave in doubt together, or
/// its size.
std::string fault_of(const CapVerdict& cap, const ClosedSurface& closed);

/// Says that many openings are cracks between patches, left by stitch_open_edges(); "" if not.
std::string fault_of_cracks(const TriangleMesh& open);

}  // namespace ice
