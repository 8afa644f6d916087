// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/case/case.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Moves every floe by a random offset within +-jitter along x and y and turns it about the
/// vertical by an angle within +-jitter / (half its longest side): another member of an ensemble.
///
/// The offsets depend on seed and floe number only (counter-based generator of Steele, Lea, Flood,
/// OOPSLA 2014), so that a field with one more floe keeps the others' offsets. 2D floes move along
/// x only; floes held "always" stay. Nothing happens with jitter 0.
void apply_jitter(Scene& scene, const Case& parameters);

}  // namespace ice
