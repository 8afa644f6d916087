// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/scene/bodies.hpp"

namespace ice {

/// Moments of inertia of a form of that density [kg/m3] about its centre of mass.
Inertia inertia_of(const Shape& shape, double density);

}  // namespace ice
