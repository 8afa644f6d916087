// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/manifold/reduce_manifold.hpp"

#include <algorithm>
#include <tuple>

#include "solver/narrow/feature/gap_rule.hpp"

namespace ice {

namespace {

// Where a candidate's surface is and faces, a's axes.
struct Face {
    Vec3 point, outward;
};

Face face_of(const PairView& view, const Candidate& c) {
    const Vec3 outward = c.gap.reference_is_a ? c.gap.normal : Vec3(-c.gap.normal);
    return {c.gap.reference_is_a ? view.support_a(c.i, outward) : view.support_b(c.j, outward),
            outward};
}

// Do two faces of a body meet in an outward edge, each behind the other's plane?
bool meet_outwards(const Face& l, const Face& r) {
    const Vec3 between = r.point - l.point;
    return between.dot(l.outward) < 0.0 && between.dot(r.outward) > 0.0;
}

bool same_incident(const Candidate& l, const Candidate& r) {
    return l.gap.reference_is_a == r.gap.reference_is_a && l.incident() == r.incident();
}

void sort_by_incident(const PairView& view, const std::vector<Candidate>& candidates,
                      std::vector<ReductionWork::Row>& out) {
    using Row = ReductionWork::Row;
    out.clear();
    for (const Candidate& c : candidates)
        out.push_back({2 * std::int64_t{c.incident()} + (c.gap.reference_is_a ? 1 : 0),
                       c.gap.reference_offset_sq, &c});
    std::sort(out.begin(), out.end(), [&](const Row& l, const Row& r) {
        if (l.incident != r.incident) return l.incident < r.incident;
        if (l.reference_offset_sq != r.reference_offset_sq)
            return l.reference_offset_sq < r.reference_offset_sq;
        const auto tie = [&](const Candidate& c) {
            return std::tuple(view.shape_a.mirror_rank[c.i], view.shape_b.mirror_rank[c.j], c.i,
                              c.j);
        };
        return tie(*l.candidate) < tie(*r.candidate);
    });
}

}  // namespace

void reduce_manifold(const PairView& view, double margin, ReductionWork& work,
                     std::vector<Candidate>& candidates) {
    // Gaps beyond the margin serve only to rule out others: alone they leave no contact.
    if (std::none_of(candidates.begin(), candidates.end(),
                     [&](const Candidate& c) { return c.gap.gap <= margin; }))
        return candidates.clear();
    // Nearest first, so that a face keeps its nearest reference sphere without a second pass.
    sort_by_incident(view, candidates, work.rows);
    std::vector<Candidate>& kept = work.kept;
    kept.clear();
    std::size_t group = 0;  // [group, kept.size()) are the kept ones of the present incident sphere
    for (const ReductionWork::Row& row : work.rows) {
        const Candidate& now = *row.candidate;
        if (kept.size() > group && !same_incident(kept[group], now)) group = kept.size();
        const auto first = kept.begin() + static_cast<std::ptrdiff_t>(group), last = kept.end();
        // Rows come by distance: a face that is kept already has the nearer reference sphere.
        if (std::any_of(first, last, [&](const Candidate& other) {
                return other.gap.normal.dot(now.gap.normal) > kSameFace;
            }))
            continue;
        const Face face = first == last ? Face{} : face_of(view, now);
        // At a convex edge the point is outside where it is outside of either face: the larger
        // gap decides.
        const auto edge = std::find_if(first, last, [&](const Candidate& other) {
            return meet_outwards(face_of(view, other), face);
        });
        if (edge == last)
            kept.push_back(now);
        else if (now.gap.gap > edge->gap.gap)
            *edge = now;
    }
    candidates.clear();
    // now that they have ruled out others, the gaps beyond the margin go
    for (const Candidate& c : kept)
        if (c.gap.gap <= margin) candidates.push_back(c);
}

}  // namespace ice
