// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/narrow/find_contacts.hpp"
#include "solver/narrow/pair_view.hpp"

namespace ice {

/// Appends a pair's contacts under the rule "surface": points, patches, keys and hull regions of
/// its candidates. @pre the candidates of a probe stand together
void emit_contacts(const PairView& view, const std::vector<Candidate>& candidates,
                   std::vector<Contact>& out);

}  // namespace ice
