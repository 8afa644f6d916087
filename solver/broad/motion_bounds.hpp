// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/scene/bodies.hpp"

namespace ice {

/// Paths: upper bounds of the distance that any point of a body has covered. A neighbour list of
/// two bodies stays valid until their paths add up to its skin (Verlet, Physical Review 159, 1967;
/// docs/method.md, section 9).
///
/// From step to step a path grows by |dx| + theta (R + kSurround): no point within kSurround of the
/// body moves farther. So two surfaces near each other have moved relative to each other by at most
/// the sum of both paths. Paths are computed from the poses, so they include every cause of motion,
/// and of held floes that drift, too. The depth by which the last step crushed a body is added.
class MotionBounds {
public:
    /// Adds the motion since the last call; bodies that are new begin with a path of 0.
    /// @param dt  [s] the coming step, for path_after_step
    void update(const Scene& scene, double dt);

    /// Bodies that have another shape and place now begin anew with a path of 0: their jump is no
    /// path.
    /// @pre all that was kept of their paths is dropped, too
    void forget(const Scene& scene, const std::vector<std::int32_t>& bodies);

    /// Path of a body since the first call, or since forget() [m]; never falls.
    double path(std::int32_t body) const { return path_[static_cast<std::size_t>(body)]; }
    /// Its path at the end of the coming step, if it keeps its velocity [m].
    double path_after_step(std::int32_t body) const {
        return path_after_step_[static_cast<std::size_t>(body)];
    }
    /// Angle through which it has turned since the first call [rad].
    double rotation(std::int32_t body) const { return rotation_[static_cast<std::size_t>(body)]; }
    /// Depth by which it has been crushed since then, part of its path [m].
    double crushed(std::int32_t body) const { return crushed_[static_cast<std::size_t>(body)]; }
    /// Bodies that are known.
    std::size_t size() const { return path_.size(); }

    /// Distance from a body up to which its path bounds the motion of points [m]. For surfaces that
    /// are farther apart the sum of two paths is no bound; larger makes the paths of bodies that
    /// turn longer, so that their neighbour lists are renewed sooner.
    static constexpr double kSurround = 0.5;

    /// R + kSurround of a shape: path per angle of rotation [m].
    static double lever(const Shape& shape) { return shape.bounding_radius + kSurround; }

private:
    std::vector<double> path_, path_after_step_, rotation_, crushed_;
    std::vector<Vec3> position_;  // at the last call
    std::vector<Quaternion> orientation_;
};

}  // namespace ice
