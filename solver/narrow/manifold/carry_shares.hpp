// SPDX-License-Identifier: GPL-3.0-or-later
/// Shares of the ice's surface as pressed areas of a convex hull that digs into it.
#pragma once

#include <span>
#include <vector>

#include "solver/narrow/feature/pair_view.hpp"
#include "solver/narrow/manifold/contact.hpp"

namespace ice {

/// Scales the patches of a convex hull's contacts with a convex floe so that their areas add up to
/// the section that the hull has cut, at faces, edges and corners alike. Only Patch::share changes
/// [m2].
///
/// The overlap is bounded by ice faces A_j and hull faces A_k, and sum A_j n_j = -sum A_k n_k
/// (divergence theorem). So the shares of the ice's spheres, carried over to the hull's faces along
/// the separating axis s of the two solids instead of the contact's normal n,
///
///     A_j (-n_j . s) / (n . s),
///
/// press with pressure x section along s, however the hull's faces lean: it is the patch's own A_j
/// (-n_j . n) where s is the hull's normal and the hull cuts off a piece of the ice, and up to
/// 1 / (n_j . n)^2 times as much where the hull's edge or corner enters a face of the ice.
///
/// A sphere on the hull's edge adds the part of the section that no ice sphere covers: all of it
/// before the first ice sphere is reached, none later.
///
/// @param contacts  of the pair's spheres, in their order; of other pairs than the ship's, or where
/// one is not convex, they stay as they are
/// @param carried   work memory: by contact, of its part of the section [m2]
void carry_shares(const PairView& view, std::vector<double>& carried, std::span<Contact> contacts);

}  // namespace ice
