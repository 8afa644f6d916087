// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "solver/narrow/feature/pair_view.hpp"
#include "solver/narrow/neighbours/near_spheres.hpp"

namespace ice {

/// p' = rotation p + translation [m], rounded to floats.
FloatPose to_floats(const Mat3& rotation, const Vec3& translation);

/// Finds the spheres of two bodies that are near each other; keeps its memory between pairs.
///
/// Picks the groups, then the spheres of the body with more spheres that are near the other body's
/// box; of the other body the spheres near the picked ones; and compares these all with all.
/// Crushed spheres are picked by their original places, in a wider range, and compared at their
/// present places. NearSpheres::box refers to the original ones.
class PairSearch {
public:
    /// Calls visit(i, j) for all spheres i of a and j of b with
    ///
    ///     |c_i - c_j|^2 <= (apex_i + apex_j + n)^2 + (tangent_i + tangent_j + t)^2,
    ///
    /// with apex_distance and tangent_extent of NormalCone [m], n and t the last two, and for some
    /// that are farther by rounding to floats. A sphere of the body with fewer spheres comes with
    /// all its partners at once. No call where no sphere is near.
    /// @param normal_extent, tangent_extent  n and t, added to the spheres' own [m], >= 0
    /// @param blocks  the shapes' spheres; in `balls` apex_distance is the radius, tangent_extent 0
    template <class Visit>
    void for_each_near(const PairView& view, double normal_extent, double tangent_extent,
                       const Visit& visit, SphereBlocks Shape::*blocks = &Shape::blocks) {
        pick(view, normal_extent, tangent_extent, blocks);
        const bool few_a = a_has_fewer(view);
        for (std::size_t first = 0; first < few_.count; first += kRows) {
            const std::size_t last = std::min(first + kRows, few_.count);
            find_near_pairs(few_, first, last, partners_of(first, last), range_, pairs_);
            std::int32_t k = 0;
            for (std::size_t f = first; f < last; ++f)
                for (; k < pairs_.end[f - first]; ++k) {
                    const std::int32_t one = few_.id[f], other = pairs_.partner[k];
                    few_a ? visit(one, other) : visit(other, one);
                }
        }
    }

private:
    static bool a_has_fewer(const PairView& view) {
        return view.shape_a.center.size() < view.shape_b.center.size();
    }
    // Rows that share one list of partners [-]: spheres of one group are neighbours.
    static constexpr std::size_t kRows = SphereBlocks::kGroup;

    // Sets few_, many_ (in the axes of the body with fewer spheres) and range_.
    void pick(const PairView& view, double normal_extent, double tangent_extent,
              SphereBlocks Shape::*blocks);

    // The spheres of many_ that rows [first, last) may be near to.
    const NearSpheres& partners_of(std::size_t first, std::size_t last);

    SearchRange range_{};
    float grow_ = 0.0f;  // of the few, less a sphere's own hypot(normal_extent, tangent_extent) [m]
    std::vector<std::int32_t> groups_;
    NearSpheres few_, many_, partners_;
    NearPairs pairs_;
};

}  // namespace ice
