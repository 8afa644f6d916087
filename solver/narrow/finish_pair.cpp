// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/finish_pair.hpp"

#include <algorithm>

#include "solver/narrow/emit_centres.hpp"
#include "solver/narrow/emit_contacts.hpp"
#include "solver/narrow/one_per_face.hpp"

namespace ice {

void choose_contacts(const PairView& view, NormalRule rule, double margin,
                     std::vector<Candidate>& candidates) {
    const auto touches = [&](const Candidate& c) { return c.gap.gap <= margin; };
    if (std::none_of(candidates.begin(), candidates.end(), touches))
        candidates.clear();
    else if (rule == NormalRule::surface)
        keep_one_per_face(view, margin, candidates);
}

void emit_pair(const PairView& view, NormalRule rule, std::span<const Candidate> candidates,
               Contact* out) {
    rule == NormalRule::centres ? emit_centres(view, candidates, out)
                                : emit_contacts(view, candidates, out);
}

}  // namespace ice
