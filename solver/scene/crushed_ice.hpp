// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// How far contact has crushed the ice: crushed ice does not come back, so its sphere lies deeper.
///
/// Mass, buoyancy and drag stay those of the whole floe: the crushed ice floats on.
class CrushedIce {
public:
    /// Place of surface sphere `k` of body `i` relative to its place in the whole floe, body axes
    /// [m]; zero while nothing is crushed.
    Vec3 recess(std::int32_t i, std::int32_t k) const {
        return is_whole(i) ? Vec3(Vec3::Zero()) : recess_[static_cast<std::size_t>(i)][k];
    }
    bool is_whole(std::int32_t i) const {
        return static_cast<std::size_t>(i) >= recess_.size() ||
               recess_[static_cast<std::size_t>(i)].empty();
    }
    /// Moves sphere `k` of a body with `count` surface spheres by `move` [m], body axes.
    void crush(std::int32_t i, std::int32_t k, std::size_t count, const Vec3& move) {
        if (static_cast<std::size_t>(i) >= recess_.size())
            recess_.resize(static_cast<std::size_t>(i) + 1);
        auto& body = recess_[static_cast<std::size_t>(i)];
        if (body.empty()) body.assign(count, Vec3::Zero());
        body[static_cast<std::size_t>(k)] += move;
    }
    /// Recesses by body and sphere; empty for bodies that are whole. For checkpoints.
    std::vector<std::vector<Vec3>>& all() { return recess_; }
    const std::vector<std::vector<Vec3>>& all() const { return recess_; }

private:
    std::vector<std::vector<Vec3>> recess_;
};

}  // namespace ice
