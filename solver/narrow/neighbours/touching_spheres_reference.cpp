// SPDX-License-Identifier: GPL-3.0-or-later
// Which listed spheres of the rule "centres" touch: the definition, one pair at a time.
// touching_spheres_simd.cpp finds the same in lanes.
#include <algorithm>
#include <cmath>

#include "solver/narrow/neighbours/touching_spheres.hpp"

namespace ice::reference {

void find_touching(std::span<const ListedSpheres> listed, const FloatPose& pose, float most,
                   TouchingSpheres& out) {
    out = {};
    for (const ListedSpheres& s : listed)
        for (std::size_t k = 0; k < ListedSpheres::kPairs; ++k) {
            const auto moved = [&](int axis) {
                const float* row = pose.rotation[axis];
                // in units of the list, summed in the order of the SIMD kernel's operations
                return (row[0] * s.bx[k] + row[1] * s.by[k]) +
                       (row[2] * s.bz[k] + pose.translation[axis]);
            };
            const float dx = moved(0) - s.ax[k], dy = moved(1) - s.ay[k], dz = moved(2) - s.az[k];
            const float gap = std::sqrt(dx * dx + dy * dy + dz * dz) - s.radii[k];
            out.least = std::min(out.least, gap);
            // a not-a-number does not touch
            if (!(gap <= most)) continue;
            out.a.push_back(s.a[k]);
            out.b.push_back(s.b[k]);
            ++out.count;
        }
}

}  // namespace ice::reference
