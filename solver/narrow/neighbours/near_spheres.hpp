// SPDX-License-Identifier: GPL-3.0-or-later
/// Search for the spheres of two bodies that are near enough to be measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/shape/sphere_blocks.hpp"

namespace ice {

/// p' = rotation p + translation, from one body's axes to another's.
struct FloatPose {
    float rotation[3][3];  ///< rotation matrix, row by row
    float translation[3];  ///< [m]
};

/// How far apart two spheres may be and still matter: see in_range.
struct SearchRange {
    float normal_extent, tangent_extent;  ///< added to the two spheres' own extents [m]
};

/// Larger than any coordinate [m]: an empty box has it as its low and minus it as its high corner.
/// Its square is still a finite float, so that sums of squares do not overflow.
constexpr float kBeyondAll = 1e18f;

/// Spheres picked from a body, in the axes of the search; entries from `count` on mean nothing.
struct NearSpheres {
    /// Centre, extents along and across a contact normal, hypot of these [m]; of equal length, at
    /// least `count`.
    std::vector<float> x, y, z, normal_extent, tangent_extent, own;
    std::vector<std::int32_t> id;  ///< the shape's number of the sphere
    std::size_t count = 0;         ///< spheres picked
    FloatBox box;  ///< of their centres as they were picked; empty (low > high) for none
};

/// Pairs found by find_near_pairs. The partners of its k-th row are [end[k - 1], end[k]).
struct NearPairs {
    std::vector<std::int32_t> partner;  ///< ids of the many; beyond end.back() without meaning
    std::vector<std::int32_t> end;      ///< one per row
    std::vector<std::uint8_t> masks;    ///< room for the search
};

/// Groups of 16 spheres whose box meets `box` grown by `grow` [m] on all sides, ascending; body
/// axes. None for an empty box. @param out  its old content is dropped
void find_groups(const SphereBlocks& spheres, const FloatBox& box, float grow,
                 std::vector<std::int32_t>& out);

/// Picks, of these groups, the spheres whose centres, moved by `pose`, lie in `box` grown by
/// `grow` [m] + the sphere's own hypot(normal_extent, tangent_extent) on all sides; order of the
/// groups is kept. None for no groups.
void pick_spheres(const SphereBlocks& spheres, const std::vector<std::int32_t>& groups,
                  const FloatPose& pose, const FloatBox& box, float grow, NearSpheres& out);

/// Picks from spheres that have been picked already.
void pick_spheres(const NearSpheres& from, const FloatBox& box, float grow, NearSpheres& out);

/// For rows f = first .. last - 1 of `few` finds all spheres of `many` with
///
///     |c_f - c_m|^2 <= (n_f + n_m + range.normal_extent)^2 + (t_f + t_m + range.tangent_extent)^2,
///
/// n and t being the normal and tangent extents [m], in the order of `many`. Rows without a partner
/// have an empty range.
void find_near_pairs(const NearSpheres& few, std::size_t first, std::size_t last,
                     const NearSpheres& many, const SearchRange& range, NearPairs& out);

namespace reference {
// The definitions, one sphere at a time: read these first. Same bits on every instruction set.
void find_groups(const SphereBlocks& spheres, const FloatBox& box, float grow,
                 std::vector<std::int32_t>& out);
void pick_spheres(const SphereBlocks& spheres, const std::vector<std::int32_t>& groups,
                  const FloatPose& pose, const FloatBox& box, float grow, NearSpheres& out);
void pick_spheres(const NearSpheres& from, const FloatBox& box, float grow, NearSpheres& out);
void find_near_pairs(const NearSpheres& few, std::size_t first, std::size_t last,
                     const NearSpheres& many, const SearchRange& range, NearPairs& out);
}  // namespace reference

}  // namespace ice
