// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/formats/sphere_set.hpp"

namespace ice {

/// For each surface sphere of a set that is its own mirror image across y = 0 the sphere that is
/// its image, bit for bit; itself in the centre plane or where there is none.
std::vector<std::int32_t> find_twins(const SphereSet& set);

}  // namespace ice
