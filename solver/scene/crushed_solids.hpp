// SPDX-License-Identifier: GPL-3.0-or-later
/// What convex floes have crushed off each other.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/shape/solid.hpp"

namespace ice {

class CheckpointFile;

/// The solids of convex floes, less the ice that other floes have crushed (docs/method.md, section
/// 5): each crushing cuts a solid by the plane of the other floe's face. Cut ice does not come
/// back. Mass, buoyancy and drag remain those of the whole floe, and so do its contacts with the
/// ship, which have their own crushed depths (CrushedIce).
class CrushedSolids {
public:
    /// The solid of a body that was cut; null for a whole body.
    const ConvexPiece* solid_of(std::int32_t body) const {
        const auto i = static_cast<std::size_t>(body);
        return i < solids_.size() && !solids_[i].empty() ? &solids_[i] : nullptr;
    }
    /// Cuts a body's solid (crush_solid); body axes. @param whole  its solid before any cut
    /// @return false where the solid could not be cut
    bool cut(std::int32_t body, const ConvexPiece& whole, const Vec3& outward, const Vec3& point);
    /// The body has another shape now, and it is whole.
    void forget(std::int32_t body);

    /// Writes or sets its state, by the file's direction.
    void carry(CheckpointFile& file);

private:
    std::vector<ConvexPiece> solids_;  ///< by body; empty while whole
};

}  // namespace ice
