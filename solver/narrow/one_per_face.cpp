// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/one_per_face.hpp"

#include <algorithm>
#include <tuple>

namespace ice {

namespace {

// Normals closer than 30 degrees belong to the same face of a probe's neighbourhood.
constexpr double kSameFaceCos = 0.866;

// Where a candidate's surface is and faces, a's axes.
struct Face {
    Vec3 point, outward;
};

Face face_of(const PairView& view, const Candidate& c) {
    const Vec3 outward = c.gap.a_is_surface ? c.gap.normal : Vec3(-c.gap.normal);
    return {support_point(c.gap.a_is_surface ? view.sphere_a(c.i) : view.sphere_b(c.j), outward),
            outward};
}

// Do two faces of a body meet in an outward edge, each behind the other's plane?
bool meet_outwards(const Face& l, const Face& r) {
    const Vec3 between = r.point - l.point;
    return between.dot(l.outward) < 0.0 && between.dot(r.outward) > 0.0;
}

bool same_probe(const Candidate& l, const Candidate& r) {
    return l.gap.a_is_surface == r.gap.a_is_surface && l.probe() == r.probe();
}

// Ascending by probe; of a probe by distance, ties by what mirror images have in common.
void sort_by_probe(const PairView& view, std::vector<Candidate>& candidates) {
    std::sort(candidates.begin(), candidates.end(), [&](const Candidate& l, const Candidate& r) {
        const auto first = [](const Candidate& c) {
            return std::tuple(c.gap.a_is_surface, c.probe(), c.gap.lateral_sq);
        };
        if (first(l) != first(r)) return first(l) < first(r);
        const auto tie = [&](const Candidate& c) {
            return std::tuple(mirrored_place(view.shape_a, c.i), mirrored_place(view.shape_b, c.j),
                              c.i, c.j);
        };
        return tie(l) < tie(r);
    });
}

}  // namespace

void keep_one_per_face(const PairView& view, double margin, std::vector<Candidate>& candidates) {
    sort_by_probe(view, candidates);
    std::size_t kept = 0, group = 0;  // [group, kept) are the kept ones of the present probe
    for (const Candidate& now : candidates) {
        if (kept > group && !same_probe(candidates[group], now)) group = kept;
        const auto first = candidates.begin() + static_cast<std::ptrdiff_t>(group);
        const auto last = candidates.begin() + static_cast<std::ptrdiff_t>(kept);
        if (std::any_of(first, last, [&](const Candidate& other) {
                return other.gap.normal.dot(now.gap.normal) > kSameFaceCos;
            }))
            continue;
        const auto edge = std::find_if(first, last, [&](const Candidate& other) {
            return meet_outwards(face_of(view, other), face_of(view, now));
        });
        if (edge == last)
            candidates[kept++] = now;
        else if (now.gap.gap > edge->gap.gap)
            *edge = now;
    }
    candidates.resize(kept);
    std::erase_if(candidates, [&](const Candidate& c) { return c.gap.gap > margin; });
}

}  // namespace ice
