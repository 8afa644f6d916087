// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/find_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/base/parallel.hpp"
#include "solver/narrow/emit_contacts.hpp"

namespace ice {

namespace {

// Normals closer than 30 degrees belong to the same face of a probe's neighbourhood.
constexpr double kSameFaceCos = 0.866;

// A pair takes about a microsecond: below this many, waking threads costs more than they save, and
// much more on a busy machine.
constexpr std::size_t kSerialPairs = 256;

// Measures spheres i and j and keeps them when they are near enough to matter.
void consider(const PairView& view, NormalRule rule, double margin, std::int32_t i,
              const SphereSurface& b, std::int32_t j, std::vector<Candidate>& out) {
    const SphereSurface a = view.sphere_a(i);
    if (rule == NormalRule::centres) {
        const Gap gap = measure_gap_centres(a, b);
        if (gap.valid && gap.gap <= margin) out.push_back({i, j, gap});
        return;
    }
    const Gap gap = measure_gap_surface(a, b, view.pair.a == static_cast<std::int32_t>(kShip));
    const double reach = gap.a_is_surface ? view.shape_a.reach : view.shape_b.reach;
    if (gap.valid && gap.gap <= margin && gap.lateral_sq <= reach * reach)
        out.push_back({i, j, gap});
}

// Of a probe's candidates, the laterally nearest for each face; see the header.
void keep_one_per_face(const PairView& view, std::vector<Candidate>& candidates) {
    const auto order = [&](const Candidate& l, const Candidate& r) {
        const auto first = [](const Candidate& c) {
            return std::tuple(c.gap.a_is_surface, c.probe(), c.gap.lateral_sq);
        };
        if (first(l) != first(r)) return first(l) < first(r);
        const auto tie = [&](const Candidate& c) {
            return std::tuple(mirrored_place(view.shape_a, c.i), mirrored_place(view.shape_b, c.j),
                              c.i, c.j);
        };
        return tie(l) < tie(r);
    };
    std::sort(candidates.begin(), candidates.end(), order);
    std::size_t kept = 0, group = 0;  // [group, kept) are the kept ones of the present probe
    for (const Candidate& now : candidates) {
        if (kept > group && (candidates[group].gap.a_is_surface != now.gap.a_is_surface ||
                             candidates[group].probe() != now.probe()))
            group = kept;
        const bool seen = std::any_of(
            candidates.begin() + static_cast<std::ptrdiff_t>(group),
            candidates.begin() + static_cast<std::ptrdiff_t>(kept), [&](const Candidate& other) {
                return other.gap.normal.dot(now.gap.normal) > kSameFaceCos;
            });
        if (!seen) candidates[kept++] = now;
    }
    candidates.resize(kept);
}

void finish_pair(const PairView& view, NormalRule rule, std::vector<Candidate>& candidates,
                 std::vector<Contact>& out) {
    const auto before = static_cast<std::ptrdiff_t>(out.size());
    if (rule == NormalRule::surface) keep_one_per_face(view, candidates);
    emit_contacts(view, rule, candidates, out);
    // the solver takes contacts in this order, and its answer depends on it
    const auto order = [&](const Contact& c) {
        return std::tuple(mirrored_place(view.shape_a, c.sphere_a),
                          mirrored_place(view.shape_b, c.sphere_b), c.gap, c.key);
    };
    std::sort(out.begin() + before, out.end(),
              [&](const Contact& l, const Contact& r) { return order(l) < order(r); });
}

void find_pair_contacts(const Scene& scene, BodyPair pair, NormalRule rule, double margin,
                        std::vector<Candidate>& candidates, std::vector<Contact>& out) {
    const PairView view(scene, pair);
    candidates.clear();
    // only b's spheres in a's box, widened by what a contact can span, can touch
    const double reach =
        rule == NormalRule::surface ? std::max(view.shape_a.reach, view.shape_b.reach) : 0.0;
    const double span = view.shape_b.largest_support + margin;
    const Eigen::AlignedBox3d box(view.shape_a.box.min() - Vec3::Constant(span + reach),
                                  view.shape_a.box.max() + Vec3::Constant(span + reach));
    for (std::int32_t j = 0; j < static_cast<std::int32_t>(view.shape_b.center.size()); ++j) {
        const Vec3 at = view.center_b(j);
        if (!box.contains(at)) continue;
        const SphereSurface b = view.sphere_b(j);
        const double along = view.shape_a.largest_support + view.shape_b.largest_support + margin;
        const double range_sq = along * along + reach * reach;
        view.shape_a.grid.for_each_near(at, std::sqrt(range_sq), [&](std::int32_t i) {
            if ((view.shape_a.center[i] - at).squaredNorm() <= range_sq)
                consider(view, rule, margin, i, b, j, candidates);
        });
    }
    // grid order differs between poses: ascending spheres make the answer a function of the pair
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& l, const Candidate& r) {
        return std::pair(l.i, l.j) < std::pair(r.i, r.j);
    });
    finish_pair(view, rule, candidates, out);
}

// Upper bound of the speed at which surface points of the two bodies approach [m/s].
double closing_speed(const Scene& scene, BodyPair pair) {
    const Bodies& b = scene.bodies;
    const auto turning = [&](std::int32_t i) {
        return b.angular_velocity[i].norm() *
               scene.shapes[static_cast<std::size_t>(b.shape[i])].bounding_radius;
    };
    return (b.velocity[pair.b] - b.velocity[pair.a]).norm() + turning(pair.a) + turning(pair.b);
}

}  // namespace

void ContactFinder::find(const Scene& scene, const std::vector<BodyPair>& pairs, NormalRule rule,
                         double dt, double margin, std::vector<Contact>& out) {
    if (per_pair_.size() < pairs.size()) per_pair_.resize(pairs.size());
    parallel_for(pairs.size(), kSerialPairs, [&](std::size_t k) {
        thread_local std::vector<Candidate> candidates;
        per_pair_[k].clear();
        find_pair_contacts(scene, pairs[k], rule, dt * closing_speed(scene, pairs[k]) + margin,
                           candidates, per_pair_[k]);
    });
    out.clear();
    for (std::size_t k = 0; k < pairs.size(); ++k)
        out.insert(out.end(), per_pair_[k].begin(), per_pair_[k].end());
}

namespace reference {

void find_contacts(const Scene& scene, BodyPair pair, NormalRule rule, double margin,
                   std::vector<Contact>& out) {
    const PairView view(scene, pair);
    std::vector<Candidate> candidates;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(view.shape_a.center.size()); ++i)
        for (std::int32_t j = 0; j < static_cast<std::int32_t>(view.shape_b.center.size()); ++j)
            consider(view, rule, margin, i, view.sphere_b(j), j, candidates);
    finish_pair(view, rule, candidates, out);
}

}  // namespace reference

}  // namespace ice
