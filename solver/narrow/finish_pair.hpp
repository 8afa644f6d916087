// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "solver/narrow/find_contacts.hpp"
#include "solver/narrow/pair_view.hpp"

namespace ice {

/// Leaves of a pair's candidates those that are contacts: none where no gap is within the margin
/// [m], under the rule "surface" one per probe and face. @pre rule "centres": all are within it
void choose_contacts(const PairView& view, NormalRule rule, double margin,
                     std::vector<Candidate>& candidates);

/// Makes contacts of chosen candidates, in the order that ContactFinder gives them.
/// @param out  room for as many
void emit_pair(const PairView& view, NormalRule rule, std::span<const Candidate> candidates,
               Contact* out);

}  // namespace ice
