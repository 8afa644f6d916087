// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/narrow/feature/pair_view.hpp"
#include "solver/narrow/manifold/contact.hpp"
#include "solver/narrow/manifold/contact_order.hpp"

namespace ice {

/// Work memory of make_centre_contacts, which keeps its capacity between pairs.
struct CentreContactsWork {
    std::vector<std::int32_t> shared_a, shared_b;  ///< contacts per sphere of a and of b
    std::vector<ContactPlace> places;
};

/// Makes contacts of a pair's candidates under the rule "centres", in the order that ContactFinder
/// gives them; the candidates' own order does not matter. A patch is the ice sphere's share [m2]
/// over the number of its contacts with that body, at least 5 % of it facing the contact.
/// @param out  room for as many
void make_centre_contacts(const PairView& view, std::span<const Candidate> candidates,
                          CentreContactsWork& work, Contact* out);

}  // namespace ice
