// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/narrow/pair_view.hpp"

namespace ice {

/// Of a probe's candidates keeps the laterally nearest for each face that it is on; of two faces
/// that meet in an outward edge the one less deep: behind the other plane alone is not yet inside
/// the body. Of these it keeps what is within `margin` [m]. A probe's candidates stand together
/// afterwards, in an order that mirror images have in common.
void keep_one_per_face(const PairView& view, double margin, std::vector<Candidate>& candidates);

}  // namespace ice
