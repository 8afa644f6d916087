// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/scene/crushed_solids.hpp"

#include "solver/shape/cut_solid.hpp"

namespace ice {

void CrushedSolids::cut(std::int32_t body, const ConvexPiece& whole, const Vec3& outward,
                        const Vec3& point) {
    const auto i = static_cast<std::size_t>(body);
    if (i >= solids_.size()) solids_.resize(i + 1);
    if (solids_[i].empty()) solids_[i] = whole;
    // where nothing would be left, the solid stays, and the overlap opens like any other
    crush_solid(solids_[i], outward, point);
}

void CrushedSolids::forget(std::int32_t body) {
    if (solid_of(body)) solids_[static_cast<std::size_t>(body)] = {};
}

}  // namespace ice
