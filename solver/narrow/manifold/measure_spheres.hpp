// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures the spheres of two bodies that may touch.
#pragma once

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/narrow/feature/pair_view.hpp"
#include "solver/narrow/neighbours/pair_cache.hpp"

namespace ice {

/// The distance within which two spheres are compared: apex distances and margin along the normal,
/// the patch radius and the corners' offsets across it [m]. Of edges that run side by side and
/// cross, each sphere may be its patch radius from there: NormalCone::tangent_extent has half of it
/// for each, this adds the difference for the shape with the larger one.
struct SphereRange {
    double margin, patch_radius;  ///< along and across the normal [m]

    /// @param m  the margin [m]
    SphereRange(const PairView& view, double m) : margin(m), patch_radius(patch_radius_of(view)) {}

    /// Largest squared distance of centres [m2].
    double squared(const NormalCone& a, const NormalCone& b) const {
        const double along = a.apex_distance + b.apex_distance + margin,
                     across = patch_radius + a.tangent_extent + b.tangent_extent;
        return along * along + across * across;
    }
    /// Are the centres within it? Spheres beyond it cannot be candidates.
    bool contains(const Feature& a, const Feature& b) const {
        return (a.center - b.center).squaredNorm() <= squared(a.cone, b.cone);
    }

private:
    static double patch_radius_of(const PairView& view) {
        const double a = view.shape_a.patch_radius, b = view.shape_b.patch_radius;
        return std::max(a, b) + 0.5 * std::abs(a - b);
    }
};

/// Where a ship's face meets a floe's, the ship's gives the normal (measure_gap_surface).
inline bool prefers_reference_a(const PairView& view) {
    return view.pair.a == static_cast<std::int32_t>(kShip);
}

/// Is the gap within patch radii and side planes? Gaps above the margin count, too: a face with a
/// larger gap may show that the incident sphere is outside.
bool is_candidate(const PairView& view, std::int32_t i, std::int32_t j, const Gap& gap);

/// A pair of spheres as group_by_types sorts it: two integers, compared at once, sort faster than
/// pairs.
struct TypesRow {
    std::uint64_t types, spheres;  ///< b's before a's
    auto operator<=>(const TypesRow&) const = default;
};

/// Sorts pairs of spheres by their feature types, so that each FeaturePair is made once.
/// @param rows  work memory
void group_by_types(const PairView& view, std::vector<TypesRow>& rows,
                    std::span<SpherePair> spheres);

/// Keeps of the spheres from `first` on those that may be candidates while the pair moves within
/// `skin`, sorted by feature types; returns the least gap that they may have, less that
/// motion [m]: infinite where none is kept.
/// @param patch_radius  SphereRange's [m]
/// @param rows          work memory
/// @param spheres       those before `first` stay as they are
double bound_spheres(const PairView& view, double patch_radius, const Skin& skin, std::size_t first,
                     std::vector<TypesRow>& rows, std::vector<SpherePair>& spheres);

/// The candidates among these spheres, in their order: the ones of measure_gap_surface, as
/// FeaturePair gives them. A FeaturePair serves adjacent pairs of spheres with the same types.
/// @param out  its old content is dropped
void measure_spheres(const PairView& view, const SphereRange& range,
                     std::span<const SpherePair> spheres, std::vector<Candidate>& out);

}  // namespace ice
