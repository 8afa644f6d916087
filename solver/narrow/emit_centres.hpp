// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/narrow/find_contacts.hpp"
#include "solver/narrow/pair_view.hpp"

namespace ice {

/// Makes contacts of a pair's candidates under the rule "centres" and appends them, in the order
/// that ContactFinder gives them; the candidates' own order does not matter.
void emit_centres(const PairView& view, const std::vector<Candidate>& candidates,
                  std::vector<Contact>& out);

}  // namespace ice
