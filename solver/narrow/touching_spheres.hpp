// SPDX-License-Identifier: GPL-3.0-or-later
/// Which of the listed spheres of two bodies touch, now that the bodies have gone on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/narrow/near_spheres.hpp"

namespace ice {

/// Sixteen pairs of spheres beside each other, each sphere in its own body's axes.
///
/// Floats, as in SphereBlocks: what touches is measured in double precision.
struct alignas(64) ListedSpheres {
    static constexpr std::size_t kPairs = 16;

    float ax[kPairs], ay[kPairs], az[kPairs];  ///< centre of a's [m]
    float bx[kPairs], by[kPairs], bz[kPairs];  ///< and of b's [m]
    float radii[kPairs];                       ///< sum of both radii [m]; -kNowhere in the fill
    std::int32_t a[kPairs], b[kPairs];         ///< numbers of the spheres

    static constexpr float kNowhere = 1e9f;  ///< a gap that is wider than any [m]
};

/// What find_touching found; entries from `count` on mean nothing.
struct TouchingSpheres {
    std::vector<std::int32_t> a, b;
    std::size_t count = 0;
    float least = ListedSpheres::kNowhere;  ///< gap of all that are listed [m]
};

/// Finds the listed pairs, in their order, whose gap is at most `most` [m],
///
///     |turn c_b + shift - c_a| - (r_a + r_b) <= most.
///
/// @param pose  brings b's axes to a's; finite
void find_touching(std::span<const ListedSpheres> listed, const FloatPose& pose, float most,
                   TouchingSpheres& out);

namespace reference {
// The definition, one pair at a time: read this first. Same bits on every instruction set.
void find_touching(std::span<const ListedSpheres> listed, const FloatPose& pose, float most,
                   TouchingSpheres& out);
}  // namespace reference

}  // namespace ice
