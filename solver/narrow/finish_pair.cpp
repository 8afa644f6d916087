// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/finish_pair.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

#include "solver/narrow/emit_centres.hpp"
#include "solver/narrow/emit_contacts.hpp"
#include "solver/narrow/one_per_face.hpp"

namespace ice {

namespace {

// Appends a pair's contacts in the order that the solver takes them in: its answer depends on it.
void order_contacts(const PairView& view, const std::vector<Contact>& found,
                    std::vector<Contact>& out) {
    struct Row {
        std::int32_t rank_a, rank_b;
        const Contact* contact;
    };
    thread_local std::vector<Row> rows;  // keeps its memory: contacts are large, these are moved
    rows.clear();
    for (const Contact& c : found)
        rows.push_back(
            {view.shape_a.mirror_rank[c.sphere_a], view.shape_b.mirror_rank[c.sphere_b], &c});
    std::sort(rows.begin(), rows.end(), [](const Row& l, const Row& r) {
        if (l.rank_a != r.rank_a) return l.rank_a < r.rank_a;
        if (l.rank_b != r.rank_b) return l.rank_b < r.rank_b;
        const auto rest = [](const Contact& c) {
            return std::tuple(c.gap, c.point.x(), c.point.z(), c.key);
        };
        return rest(*l.contact) < rest(*r.contact);
    });
    for (const Row& row : rows) out.push_back(*row.contact);
}

}  // namespace

void finish_pair(const PairView& view, NormalRule rule, double margin,
                 std::vector<Candidate>& candidates, std::vector<Contact>& out) {
    const auto touches = [&](const Candidate& c) { return c.gap.gap <= margin; };
    if (std::none_of(candidates.begin(), candidates.end(), touches)) return;
    if (rule == NormalRule::centres) {
        out.resize(out.size() + candidates.size());
        return emit_centres(view, candidates, &*(out.end() - std::ssize(candidates)));
    }
    keep_one_per_face(view, margin, candidates);
    thread_local std::vector<Contact> found;  // keeps its memory
    found.clear();
    emit_contacts(view, candidates, found);
    order_contacts(view, found, out);
}

}  // namespace ice
