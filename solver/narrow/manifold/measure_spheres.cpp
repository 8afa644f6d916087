// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/manifold/measure_spheres.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>

#include "solver/narrow/feature/feature_pair.hpp"
#include "solver/narrow/feature/feature_pair_bound.hpp"
#include "solver/narrow/feature/gap_rule.hpp"

namespace ice {

namespace {

// The spheres and feature types measured last: the next ones are mostly the same.
class LastMeasured {
public:
    LastMeasured(const PairView& view, const SphereRange& range) : view_(view), range_(range) {}

    /// Is it in range?
    bool meet(const SpherePair& s) {
        const std::int32_t type_a = view_.shape_a.feature_type[s.a],
                           type_b = view_.shape_b.feature_type[s.b];
        // Pairs come sorted by feature types: features are made when the types change.
        if (type_a != type_a_ || type_b != type_b_) {
            if (type_a != type_a_) feature_a_ = view_.sphere_a(s.a);
            if (type_b != type_b_) feature_b_ = view_.sphere_b(s.b);
            pair_.reset();
            near_sq_ = range_.squared(feature_a_.cone, feature_b_.cone);
            type_a_ = type_a;
            type_b_ = type_b;
        }
        if (s.a != sphere_a_) center_a_ = view_.center_a(sphere_a_ = s.a);
        if (s.b != sphere_b_) center_b_ = view_.center_b(sphere_b_ = s.b);
        return (center_a_ - center_b_).squaredNorm() <= near_sq_;
    }
    Gap gap() {
        if (!pair_) pair_.emplace(feature_a_, feature_b_, prefers_reference_a(view_));
        return pair_->measure(center_a_, center_b_);
    }

private:
    const PairView& view_;
    const SphereRange& range_;
    std::int32_t type_a_ = -1, type_b_ = -1, sphere_a_ = -1, sphere_b_ = -1;
    Feature feature_a_, feature_b_;    // of the types, whatever their centres
    std::optional<FeaturePair> pair_;  // refers to both
    double near_sq_ = 0.0;
    Vec3 center_a_, center_b_;
};

double slack_of_sphere(const Shape& shape, std::int32_t sphere, const Gap& gap) {
    return kBeyond * shape.radius[sphere] + std::max(gap.gap, 0.0);
}

// Is the point, in a's axes, inside the side planes of a's or b's sphere?
bool a_contains(const PairView& view, std::int32_t i, const Gap& gap, const Vec3& point) {
    return view.shape_a.side_planes.contain(i, point, slack_of_sphere(view.shape_a, i, gap));
}
bool b_contains(const PairView& view, std::int32_t j, const Gap& gap, const Vec3& point) {
    return view.shape_b.side_planes.contain(j, view.to_b(point),
                                            slack_of_sphere(view.shape_b, j, gap));
}

bool contain_crossing(const PairView& view, std::int32_t i, std::int32_t j, const Gap& gap) {
    const Vec3 point_a = view.support_a(i, gap.normal), point_b = view.support_b(j, -gap.normal);
    const Vec3 edge_a = view.shape_a.cone[i].edge(gap.edge_a);
    const Vec3 edge_b = view.rotation_ab * view.shape_b.cone[j].edge(gap.edge_b);
    const LineParameters at = closest_on_lines(point_a, edge_a, point_b, edge_b);
    // A sphere without side planes ends nowhere within its patch.
    return (!view.shape_a.side_planes.has(i) ||
            a_contains(view, i, gap, point_a + at.along_a * edge_a)) &&
           (!view.shape_b.side_planes.has(j) ||
            b_contains(view, j, gap, point_b + at.along_b * edge_b));
}

// Do spheres i of a and j of b meet within the side planes of their faces and edges?
//
// Tested is the incident support point on the face, and of two edges the crossing on each. A
// contact that has not touched yet may lie outside by its gap: it may come from beside.
bool is_within_side_planes(const PairView& view, std::int32_t i, std::int32_t j, const Gap& gap) {
    if (gap.crossing) {
        if (!view.shape_a.side_planes.has(i) && !view.shape_b.side_planes.has(j)) return true;
        return contain_crossing(view, i, j, gap);
    }
    // the incident support point where it is inside, else its projection on the face
    const Vec3 rise = std::max(gap.gap, 0.0) * gap.normal;
    if (gap.reference_is_a)
        return !view.shape_a.side_planes.has(i) ||
               a_contains(view, i, gap, view.support_b(j, -gap.normal) - rise);
    return !view.shape_b.side_planes.has(j) ||
           b_contains(view, j, gap, view.support_a(i, gap.normal) + rise);
}

}  // namespace

bool is_candidate(const PairView& view, std::int32_t i, std::int32_t j, const Gap& gap) {
    if (!gap.valid) return false;
    const double a = view.shape_a.patch_radius, b = view.shape_b.patch_radius;
    const double of_reference = gap.reference_is_a ? a : b,
                 of_incident = gap.reference_is_a ? b : a;
    // Beyond a patch radius the surface belongs to another sphere, which finds the contact
    // itself.
    return gap.reference_offset_sq <= of_reference * of_reference &&
           gap.incident_offset_sq <= of_incident * of_incident &&
           is_within_side_planes(view, i, j, gap);
}

void group_by_types(const PairView& view, std::vector<TypesRow>& rows,
                    std::span<SpherePair> spheres) {
    const auto join = [](std::int32_t high, std::int32_t low) {
        return static_cast<std::uint64_t>(high) << 32 | static_cast<std::uint64_t>(low);
    };
    // the types decide, the spheres break ties
    rows.clear();
    for (const SpherePair& s : spheres)
        rows.push_back(
            {join(view.shape_b.feature_type[s.b], view.shape_a.feature_type[s.a]), join(s.b, s.a)});
    std::sort(rows.begin(), rows.end());
    std::transform(rows.begin(), rows.end(), spheres.begin(), [](const TypesRow& row) {
        return SpherePair{static_cast<std::int32_t>(row.spheres & 0xffffffff),
                          static_cast<std::int32_t>(row.spheres >> 32)};
    });
}

double bound_spheres(const PairView& view, double patch_radius, const Skin& skin, std::size_t first,
                     std::vector<TypesRow>& rows, std::vector<SpherePair>& spheres) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    group_by_types(view, rows, std::span(spheres).subspan(first));
    std::optional<FeaturePairBound> bound;  // of the types met last; refers to both features
    Feature feature_a, feature_b;
    std::int32_t type_a = -1, type_b = -1;
    double least = kInfinity;
    std::size_t kept = first;
    for (std::size_t k = first; k < spheres.size(); ++k) {
        const auto [i, j] = spheres[k];
        // A sphere driven right through its body never comes back: it needs no bound.
        if (view.is_gone_a(i) || view.is_gone_b(j)) continue;
        if (view.shape_a.feature_type[i] != type_a || view.shape_b.feature_type[j] != type_b) {
            if (view.shape_a.feature_type[i] != type_a) feature_a = view.sphere_a(i);
            if (view.shape_b.feature_type[j] != type_b) feature_b = view.sphere_b(j);
            bound.emplace(feature_a, feature_b, prefers_reference_a(view), patch_radius, skin);
            type_a = view.shape_a.feature_type[i];
            type_b = view.shape_b.feature_type[j];
        }
        const double gap = bound->least(view.center_a(i), view.center_b(j));
        // no contact within the skin, wherever the bodies move: the pair of spheres is not
        // listed
        if (gap == kInfinity) continue;
        least = std::min(least, gap);
        spheres[kept++] = {i, j};
    }
    spheres.resize(kept);
    return least;
}

void measure_spheres(const PairView& view, const SphereRange& range,
                     std::span<const SpherePair> spheres, std::vector<Candidate>& out) {
    out.clear();
    const bool whole =
        view.scene.crushed.is_whole(view.pair.a) && view.scene.crushed.is_whole(view.pair.b);
    LastMeasured last(view, range);
    for (const SpherePair& s : spheres) {
        // most pairs fail the distance: it costs less than the gap
        if (!last.meet(s)) continue;
        if (!whole && (view.is_gone_a(s.a) || view.is_gone_b(s.b))) continue;
        const Gap gap = last.gap();
        if (is_candidate(view, s.a, s.b, gap)) out.push_back({s.a, s.b, gap});
    }
}

}  // namespace ice
