// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/scene/crushed_solids.hpp"

#include <utility>

#include "solver/shape/cut_solid.hpp"

namespace ice {

bool CrushedSolids::cut(std::int32_t body, const ConvexPiece& whole, const Vec3& outward,
                        const Vec3& point) {
    const ConvexPiece* const solid = solid_of(body);
    ConvexPiece left = solid ? *solid : whole;
    if (!crush_solid(left, outward, point)) return false;
    const auto i = static_cast<std::size_t>(body);
    if (i >= solids_.size()) solids_.resize(i + 1);
    solids_[i] = std::move(left);
    return true;
}

void CrushedSolids::forget(std::int32_t body) {
    if (solid_of(body)) solids_[static_cast<std::size_t>(body)] = {};
}

}  // namespace ice
