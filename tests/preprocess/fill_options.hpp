// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "preprocess/fill/fill_spheres.hpp"

namespace ice::test {

/// FillOptions by position: in tests the radius is often all that matters.
inline FillOptions options(double radius, double spacing = 0.0,
                           Arrangement arrangement = Arrangement::conforming,
                           bool surface_only = false) {
    return {radius, spacing, arrangement, surface_only};
}

}  // namespace ice::test
