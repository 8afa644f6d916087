// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "solver/narrow/find_contacts.hpp"
#include "solver/narrow/pair_view.hpp"

namespace ice {

/// Makes contacts of a pair's candidates under the rule "surface", in the order that ContactFinder
/// gives them: points, patches, keys and hull regions. @param out  room for as many
/// @pre the candidates of a probe stand together
void emit_contacts(const PairView& view, std::span<const Candidate> candidates, Contact* out);

}  // namespace ice
