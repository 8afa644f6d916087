// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/formats/sphere_set.hpp"

namespace ice {

/// Where a sphere set contradicts its own mesh, in words with both values, or nothing.
///
/// Its solid is compared with the integrals over the mesh (measure_mass), the sums of the spheres'
/// shares with the solid's volume and area; 32 centres at most, evenly chosen, must lie in the
/// mesh. Cost O(T + 32 log T). @pre the mesh is not empty, its indices are in range
std::string fault_of(const SphereSet& set);

}  // namespace ice
