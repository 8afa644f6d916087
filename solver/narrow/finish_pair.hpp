// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/narrow/find_contacts.hpp"
#include "solver/narrow/pair_view.hpp"

namespace ice {

/// Makes contacts of a pair's candidates and appends them, in the order that ContactFinder gives
/// them; the candidates' own order does not matter. None where no gap is within the margin [m].
/// @param candidates  changed: under the rule "surface" one per probe and face is left
void finish_pair(const PairView& view, NormalRule rule, double margin,
                 std::vector<Candidate>& candidates, std::vector<Contact>& out);

}  // namespace ice
