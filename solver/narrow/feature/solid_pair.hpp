// SPDX-License-Identifier: GPL-3.0-or-later
/// Pairs of bodies that meet as solids.
#pragma once

#include "solver/narrow/feature/pair_view.hpp"
#include "solver/narrow/feature/separating_axis.hpp"

namespace ice {

/// How a pair's contacts are found.
enum class PairRule {
    spheres,  ///< by the contact spheres: pairs with the ship or with a floe that is not convex
    solids,   ///< two convex floes: the corners of the polygon in which they meet
    parts,    ///< pieces of level ice, which only the ship crushes: as solids, part by part
};

/// Two convex solids and where they are.
struct SolidPair {
    const ConvexPiece &a, &b;
    RelativePose pose;
};
/// Of two floes, without the ice that floes have crushed.
inline SolidPair solids_of(const PairView& view) {
    return {view.scene.solid_of(view.pair.a),
            view.scene.solid_of(view.pair.b),
            {view.rotation_ab, view.translation_ab}};
}

}  // namespace ice
