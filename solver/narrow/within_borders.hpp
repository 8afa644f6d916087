// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/narrow/pair_view.hpp"

namespace ice {

/// Do spheres i of a and j of b meet on what there is of their faces and edges (FaceBorders)?
///
/// A face is asked about the probe's foremost point, where two edges cross each edge about the
/// point on it. What has not touched yet may be past a border by its gap: it may come from beside.
/// @param gap  rule "surface", valid
bool is_within_borders(const PairView& view, std::int32_t i, std::int32_t j, const Gap& gap);

}  // namespace ice
