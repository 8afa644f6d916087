// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/measure_spheres.hpp"

#include <optional>
#include <tuple>

#include "solver/narrow/kind_pair.hpp"
#include "solver/narrow/within_borders.hpp"

namespace ice {

namespace {

// What is compared before its root is taken is not lost to rounding.
constexpr double kRoundedUp = 1.0 + 1e-12;

void measure_centres(const PairView& view, const SphereRange& range,
                     std::span<const SpherePair> spheres, std::vector<Candidate>& out) {
    for (const SpherePair& s : spheres) {
        const Vec3 center_a = view.center_a(s.a), center_b = view.center_b(s.b);
        const double radius_a = view.shape_a.radius[s.a], radius_b = view.shape_b.radius[s.b];
        const double most = (radius_a + radius_b + range.margin) * kRoundedUp;
        if ((center_b - center_a).squaredNorm() > most * most) continue;
        if (view.is_gone_a(s.a) || view.is_gone_b(s.b)) continue;
        const Gap gap = measure_gap_centres(center_a, radius_a, center_b, radius_b);
        if (is_candidate(view, NormalRule::centres, range, s.a, s.b, gap))
            out.push_back({s.a, s.b, gap});
    }
}

// The spheres and kinds measured last: the next ones are mostly the same.
class LastMeasured {
public:
    LastMeasured(const PairView& view, const SphereRange& range) : view_(view), range_(range) {}

    /// Is it in range?
    bool meet(const SpherePair& s) {
        const std::int32_t kind_a = view_.shape_a.kind[s.a], kind_b = view_.shape_b.kind[s.b];
        if (kind_a != kind_a_ || kind_b != kind_b_) {
            if (kind_a != kind_a_) surface_a_ = view_.sphere_a(s.a);
            if (kind_b != kind_b_) surface_b_ = view_.sphere_b(s.b);
            kinds_.reset();
            near_sq_ = range_.squared(surface_a_.faces, surface_b_.faces);
            kind_a_ = kind_a;
            kind_b_ = kind_b;
        }
        if (s.a != sphere_a_) center_a_ = view_.center_a(sphere_a_ = s.a);
        if (s.b != sphere_b_) center_b_ = view_.center_b(sphere_b_ = s.b);
        return (center_a_ - center_b_).squaredNorm() <= near_sq_;
    }
    Gap gap(PossibleNormals possible) {
        if (!kinds_) kinds_.emplace(surface_a_, surface_b_, prefers_a(view_), possible);
        return kinds_->measure(center_a_, center_b_);
    }

private:
    const PairView& view_;
    const SphereRange& range_;
    std::int32_t kind_a_ = -1, kind_b_ = -1, sphere_a_ = -1, sphere_b_ = -1;
    SphereSurface surface_a_, surface_b_;  // of the kinds, wherever their centres are
    std::optional<KindPair> kinds_;        // refers to both
    double near_sq_ = 0.0;
    Vec3 center_a_, center_b_;
};

}  // namespace

bool is_candidate(const PairView& view, NormalRule rule, const SphereRange& range, std::int32_t i,
                  std::int32_t j, const Gap& gap) {
    if (!gap.valid) return false;
    if (rule == NormalRule::centres) return gap.gap <= range.margin;
    const double a = view.shape_a.reach, b = view.shape_b.reach;
    const double reach = gap.a_is_surface ? a : b, of_probe = gap.a_is_surface ? b : a;
    return gap.lateral_sq <= reach * reach && gap.probe_sq <= of_probe * of_probe &&
           is_within_borders(view, i, j, gap);
}

void group_by_kinds(const PairView& view, std::span<SpherePair> spheres) {
    const auto key = [&](const SpherePair& s) {
        return std::tuple(view.shape_b.kind[s.b], view.shape_a.kind[s.a], s.b, s.a);
    };
    std::sort(spheres.begin(), spheres.end(),
              [&](const SpherePair& l, const SpherePair& r) { return key(l) < key(r); });
}

void measure_spheres(const PairView& view, NormalRule rule, const SphereRange& range,
                     std::span<const SpherePair> spheres, std::vector<Candidate>& out) {
    out.clear();
    if (rule == NormalRule::centres) return measure_centres(view, range, spheres, out);
    const bool whole =
        view.scene.crushed.is_whole(view.pair.a) && view.scene.crushed.is_whole(view.pair.b);
    LastMeasured last(view, range);
    for (const SpherePair& s : spheres) {
        if (!last.meet(s)) continue;
        if (!whole && (view.is_gone_a(s.a) || view.is_gone_b(s.b))) continue;
        const Gap gap = last.gap(s.possible);
        if (is_candidate(view, rule, range, s.a, s.b, gap)) out.push_back({s.a, s.b, gap});
    }
}

}  // namespace ice
