// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/scene/bodies.hpp"

namespace ice {

/// How far each body has gone, so that what was found out about two of them need not be found out
/// again before they can have come together.
///
/// A body's way grows by |dx| + theta (R + 0.5 m) from look to look: no point of it, nor of a body
/// that touches it, moves further in its axes, or it in theirs. Of two bodies the relative motion
/// of surfaces near each other is at most the sum of their ways. Taken from the poses themselves,
/// so that nothing that moves a body is overlooked; of held floes those that drift. How far the
/// last step crushed a body counts, too.
class Travel {
public:
    /// Looks at the present poses. @param dt  [s] for `soon`: the step that is to come
    void update(const Scene& scene, double dt);

    /// Way of a body since the first look [m].
    double way(std::int32_t body) const { return way_[static_cast<std::size_t>(body)]; }
    /// Its way at the end of the coming step, if it keeps its velocity [m].
    double soon(std::int32_t body) const { return soon_[static_cast<std::size_t>(body)]; }
    /// Angle through which it has turned since the first look [rad].
    double turn(std::int32_t body) const { return turn_[static_cast<std::size_t>(body)]; }
    /// How far it has been crushed since then, part of its way [m].
    double crushed(std::int32_t body) const { return crushed_[static_cast<std::size_t>(body)]; }
    std::size_t size() const { return way_.size(); }

    /// R + 0.5 m of a shape: what a turn by an angle of 1 counts as [m].
    static double arm(const Shape& shape) { return shape.bounding_radius + 0.5; }

private:
    std::vector<double> way_, soon_, turn_, crushed_;
    std::vector<Vec3> position_;  // at the last look
    std::vector<Quaternion> orientation_;
};

}  // namespace ice
