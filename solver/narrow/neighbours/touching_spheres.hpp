// SPDX-License-Identifier: GPL-3.0-or-later
/// Which of the listed spheres of two bodies touch at the present poses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/narrow/neighbours/near_spheres.hpp"

namespace ice {

/// Sixteen pairs of spheres beside each other. Each sphere is in its own body's axes, in whole
/// units of a length that belongs to the list.
///
/// Lists are read in every step; those of many bodies do not fit into the caches. With 16 bits a
/// number they take two thirds of the room of floats. Touching spheres are measured again in double
/// precision.
struct alignas(64) ListedSpheres {
    static constexpr std::size_t kPairs = 16;

    std::int32_t a[kPairs], b[kPairs];                ///< numbers of the spheres, 16 each
    std::int16_t ax[kPairs], ay[kPairs], az[kPairs];  ///< centre of a's, from an origin of the list
    std::int16_t bx[kPairs], by[kPairs], bz[kPairs];  ///< and of b's
    std::int16_t radii[kPairs];                       ///< sum of both radii; -kMost - 1 in the fill

    /// Largest number of units [-], that of 16 bits: the unit of a list is its largest coordinate
    /// over this. With fewer units, more spheres are measured in vain.
    static constexpr int kMost = 32767;
    /// Largest error of a gap, in units: 0.5 (2 sqrt(3) + 1) = 2.24 by rounding to units, 0.1 by
    /// floats. Larger lists more spheres, smaller would miss touching ones.
    static constexpr double kError = 2.5;
    /// Far beyond any gap, in units: the least gap of an empty list.
    static constexpr float kNowhere = 1e9f;
};

/// Results of find_touching; entries from `count` on mean nothing.
struct TouchingSpheres {
    std::vector<std::int32_t> a, b;         ///< numbers of the spheres, at least `count` each
    std::size_t count = 0;                  ///< pairs that touch
    float least = ListedSpheres::kNowhere;  ///< least gap of all that are listed, in units
};

/// Finds the listed pairs, in their order, whose gap is at most `most`,
///
///     |rotation c_b + translation - c_a| - (r_a + r_b) <= most,
///
/// all lengths in the list's unit.
/// @param pose  brings b's axes to a's, from the list's origin; finite
/// @param out   its old content is dropped; no listed spheres give none
void find_touching(std::span<const ListedSpheres> listed, const FloatPose& pose, float most,
                   TouchingSpheres& out);

namespace reference {
// The definition, one pair at a time: read this first. Same bits on every instruction set.
void find_touching(std::span<const ListedSpheres> listed, const FloatPose& pose, float most,
                   TouchingSpheres& out);
}  // namespace reference

}  // namespace ice
