// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/scene/bodies.hpp"

namespace ice {

/// Moments of inertia [kg m2] of a shape of that density [kg/m3], > 0, about its centre of mass:
/// the exact integrals over its mesh. 2D: [kg m], and an inverse about y alone.
Inertia inertia_of(const Shape& shape, double density);

}  // namespace ice
