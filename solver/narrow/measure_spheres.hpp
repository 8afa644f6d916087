// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures those spheres of two bodies that may touch.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "solver/narrow/dormant_pairs.hpp"
#include "solver/narrow/pair_view.hpp"

namespace ice {

/// Within what distance two spheres are compared: their supports and the margin along the normal,
/// the reach and the corners' offsets across it [m]. Of edges that run side by side and cross, each
/// sphere may be its shape's reach from there: Faces::aside has half of it for each, and this what
/// the larger one needs beyond.
struct SphereRange {
    double margin, reach;

    SphereRange(const PairView& view, double m) : margin(m), reach(reach_of(view)) {}

    /// Largest squared distance of centres [m2].
    double squared(const Faces& a, const Faces& b) const {
        const double along = a.corner + b.corner + margin, across = reach + a.aside + b.aside;
        return along * along + across * across;
    }
    bool holds(const SphereSurface& a, const SphereSurface& b) const {
        return (a.center - b.center).squaredNorm() <= squared(a.faces, b.faces);
    }

private:
    static double reach_of(const PairView& view) {
        const double a = view.shape_a.reach, b = view.shape_b.reach;
        return std::max(a, b) + 0.5 * std::abs(a - b);
    }
};

/// Does the ship's face give the normal, where two faces meet (measure_gap_surface)?
inline bool prefers_a(const PairView& view) {
    return view.pair.a == static_cast<std::int32_t>(kShip);
}

/// Is it near enough to matter? A face farther than the margin matters, too: it may show that the
/// probe is outside.
bool is_candidate(const PairView& view, std::int32_t i, std::int32_t j, const Gap& gap);

/// Brings spheres of the same kinds together.
void group_by_kinds(const PairView& view, std::span<SpherePair> spheres);

/// Leaves of the spheres from `first` on those that may be candidates while the pair moves within
/// `leeway`, those of the same kinds together; returns the least gap that they may have, less that
/// motion [m]. @param reach  SphereRange's [m]
double bound_spheres(const PairView& view, double reach, const Leeway& leeway, std::size_t first,
                     std::vector<SpherePair>& spheres);

/// The candidates among these spheres, in their order: those that measure_gap_surface gives, as
/// KindPair has them. What two kinds decide is found once for those that stand together.
/// @param out  what it held is forgotten
void measure_spheres(const PairView& view, const SphereRange& range,
                     std::span<const SpherePair> spheres, std::vector<Candidate>& out);

}  // namespace ice
