// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/measure_spheres.hpp"

#include <algorithm>
#include <compare>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>

#include "solver/narrow/gap_rule.hpp"
#include "solver/narrow/kind_bound.hpp"
#include "solver/narrow/kind_pair.hpp"

namespace ice {

namespace {

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
    Gap gap() {
        if (!kinds_) kinds_.emplace(surface_a_, surface_b_, prefers_a(view_));
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

double slack_of_sphere(const Shape& shape, std::int32_t sphere, const Gap& gap) {
    return kBeyond * shape.radius[sphere] + std::max(gap.gap, 0.0);
}

// Is the point, in a's axes, on what a's or b's sphere stands for?
bool a_holds(const PairView& view, std::int32_t i, const Gap& gap, const Vec3& point) {
    return view.shape_a.borders.hold(i, point, slack_of_sphere(view.shape_a, i, gap));
}
bool b_holds(const PairView& view, std::int32_t j, const Gap& gap, const Vec3& point) {
    return view.shape_b.borders.hold(j, view.to_b(point), slack_of_sphere(view.shape_b, j, gap));
}

bool edges_hold(const PairView& view, std::int32_t i, std::int32_t j, const Gap& gap) {
    const Vec3 point_a = view.support_a(i, gap.normal), point_b = view.support_b(j, -gap.normal);
    const Vec3 edge_a = view.shape_a.faces[i].edge(gap.edge_a);
    const Vec3 edge_b = view.turn * view.shape_b.faces[j].edge(gap.edge_b);
    const Crossing at = find_crossing(point_a, edge_a, point_b, edge_b);
    return (!view.shape_a.borders.has(i) || a_holds(view, i, gap, point_a + at.along_a * edge_a)) &&
           (!view.shape_b.borders.has(j) || b_holds(view, j, gap, point_b + at.along_b * edge_b));
}

// Do spheres i of a and j of b meet on what there is of their faces and edges (FaceBorders)?
//
// A face is asked about the probe's foremost point, where two edges cross each edge about the
// point on it. What has not touched yet may be past a border by its gap: it may come from beside.
bool is_within_borders(const PairView& view, std::int32_t i, std::int32_t j, const Gap& gap) {
    if (gap.crossing) {
        if (!view.shape_a.borders.has(i) && !view.shape_b.borders.has(j)) return true;
        return edges_hold(view, i, j, gap);
    }
    // the probe's point itself where it is inside, else below it on the face
    const Vec3 rise = std::max(gap.gap, 0.0) * gap.normal;
    if (gap.a_is_surface)
        return !view.shape_a.borders.has(i) ||
               a_holds(view, i, gap, view.support_b(j, -gap.normal) - rise);
    return !view.shape_b.borders.has(j) ||
           b_holds(view, j, gap, view.support_a(i, gap.normal) + rise);
}

}  // namespace

bool is_candidate(const PairView& view, std::int32_t i, std::int32_t j, const Gap& gap) {
    if (!gap.valid) return false;
    const double a = view.shape_a.reach, b = view.shape_b.reach;
    const double reach = gap.a_is_surface ? a : b, of_probe = gap.a_is_surface ? b : a;
    return gap.lateral_sq <= reach * reach && gap.probe_sq <= of_probe * of_probe &&
           is_within_borders(view, i, j, gap);
}

void group_by_kinds(const PairView& view, std::span<SpherePair> spheres) {
    struct Row {
        std::uint64_t kinds, spheres;  // b's before a's
        auto operator<=>(const Row&) const = default;
    };
    thread_local std::vector<Row> rows;  // keeps its memory; sorted alone, with the kinds at hand
    const auto join = [](std::int32_t high, std::int32_t low) {
        return static_cast<std::uint64_t>(high) << 32 | static_cast<std::uint64_t>(low);
    };
    rows.clear();
    for (const SpherePair& s : spheres)
        rows.push_back({join(view.shape_b.kind[s.b], view.shape_a.kind[s.a]), join(s.b, s.a)});
    std::sort(rows.begin(), rows.end());
    std::transform(rows.begin(), rows.end(), spheres.begin(), [](const Row& row) {
        return SpherePair{static_cast<std::int32_t>(row.spheres & 0xffffffff),
                          static_cast<std::int32_t>(row.spheres >> 32)};
    });
}

double bound_spheres(const PairView& view, double reach, const Leeway& leeway, std::size_t first,
                     std::vector<SpherePair>& spheres) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    group_by_kinds(view, std::span(spheres).subspan(first));
    std::optional<KindBound> bound;  // of the kinds met last; refers to both surfaces
    SphereSurface surface_a, surface_b;
    std::int32_t kind_a = -1, kind_b = -1;
    double least = kInfinity;
    std::size_t kept = first;
    for (std::size_t k = first; k < spheres.size(); ++k) {
        const auto [i, j] = spheres[k];
        if (view.is_gone_a(i) || view.is_gone_b(j)) continue;
        if (view.shape_a.kind[i] != kind_a || view.shape_b.kind[j] != kind_b) {
            if (view.shape_a.kind[i] != kind_a) surface_a = view.sphere_a(i);
            if (view.shape_b.kind[j] != kind_b) surface_b = view.sphere_b(j);
            bound.emplace(surface_a, surface_b, prefers_a(view), reach, leeway);
            kind_a = view.shape_a.kind[i];
            kind_b = view.shape_b.kind[j];
        }
        const double gap = bound->least(view.center_a(i), view.center_b(j));
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
        if (!last.meet(s)) continue;
        if (!whole && (view.is_gone_a(s.a) || view.is_gone_b(s.b))) continue;
        const Gap gap = last.gap();
        if (is_candidate(view, s.a, s.b, gap)) out.push_back({s.a, s.b, gap});
    }
}

}  // namespace ice
