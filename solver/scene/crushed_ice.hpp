// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Depths to which contact has crushed the ice. Crushed ice does not recover, so its sphere lies
/// deeper in the floe. Mass, buoyancy and drag remain those of the whole floe.
struct CrushedIce {
    /// By body, up to the last one that was ever crushed: its first row of displacement, -1 while
    /// whole.
    std::vector<std::int64_t> first;
    std::vector<Vec3> displacement;  ///< by surface sphere of crushed bodies, body axes [m]
    std::vector<double> deepest;     ///< by body, as long as `first`: its longest displacement [m]

    /// Spheres that have moved since Recess::move_spheres() began the list anew: their bodies and
    /// the lengths of their moves. MotionBounds reads it, as the motion of surfaces.
    struct CrushEvent {
        std::int32_t body;
        double depth;  ///< [m]
    };
    std::vector<CrushEvent> recent;

    bool is_whole(std::int32_t body) const {
        return static_cast<std::size_t>(body) >= first.size() ||
               first[static_cast<std::size_t>(body)] < 0;
    }
    /// Place of a surface sphere relative to its place in the whole floe, body axes [m].
    Vec3 displacement_of(std::int32_t body, std::int32_t sphere) const {
        if (is_whole(body)) return Vec3::Zero();
        return displacement[static_cast<std::size_t>(first[static_cast<std::size_t>(body)] +
                                                     sphere)];
    }
    /// How deep contact has crushed a surface sphere against `outward` [m]: a unit vector in body
    /// axes, out of the ice.
    double depth_of(std::int32_t body, std::int32_t sphere, const Vec3& outward) const {
        return std::max(0.0, -displacement_of(body, sphere).dot(outward));
    }
    /// Its longest displacement [m]; 0 for a whole body.
    double deepest_of(std::int32_t body) const {
        return is_whole(body) ? 0.0 : deepest[static_cast<std::size_t>(body)];
    }
    /// Moves a sphere of a body with `spheres` surface spheres by `move` [m], body axes.
    void crush(std::int32_t body, std::int32_t sphere, std::size_t spheres, const Vec3& move) {
        recent.push_back({body, move.norm()});
        carry_notch(body, sphere, spheres, move);
    }
    /// Moves a sphere of a body that is new in the scene: no surface moved, so no event.
    void carry_notch(std::int32_t body, std::int32_t sphere, std::size_t spheres,
                     const Vec3& move) {
        if (static_cast<std::size_t>(body) >= first.size()) {
            first.resize(static_cast<std::size_t>(body) + 1, -1);
            deepest.resize(first.size(), 0.0);
        }
        auto& row = first[static_cast<std::size_t>(body)];
        if (row < 0) {
            row = static_cast<std::int64_t>(displacement.size());
            displacement.resize(displacement.size() + spheres, Vec3::Zero());
        }
        Vec3& total = displacement[static_cast<std::size_t>(row + sphere)];
        total += move;
        double& most = deepest[static_cast<std::size_t>(body)];
        most = std::max(most, total.norm());
    }
};

}  // namespace ice
