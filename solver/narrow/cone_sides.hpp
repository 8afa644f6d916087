// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "solver/shape/normal_cone.hpp"

namespace ice {

/// A quick test before NormalCone::contains_either_sign, which needs a unit vector.
///
/// Of two edges most have no common axis: neither sign of their cross product lies in both cones.
/// That shows without the product's length, which costs a root and a division.
class ConeSides {
public:
    /// @pre cone.count is 2 or 3
    explicit ConeSides(const NormalCone& cone) {
        const Vec3 &f = cone.normal[0], &g = cone.normal[1], &h = cone.normal[2];
        if (cone.count == 2) {
            const double c = f.dot(g);
            side_ = {f - c * g, g - c * f, f - c * g};
            size_ = 1.0 - c * c;
        } else {
            side_ = {g.cross(h), h.cross(f), f.cross(g)};
            const double volume = f.dot(side_[0]);
            size_ = std::abs(volume);
            if (volume < 0.0)
                for (Vec3& side : side_) side = -side;
        }
    }

    /// Is neither the unit vector along n nor its reverse in the cone, for any slack up to `slack`
    /// divided by the length of n [rad]? @pre n is at most 1 long
    bool exclude(const Vec3& n, double slack) const {
        const double most = kOutside * size_ + slack;
        const double a = n.dot(side_[0]), b = n.dot(side_[1]), c = n.dot(side_[2]);
        return std::max(std::max(a, b), c) > most && std::min(std::min(a, b), c) < -most;
    }

private:
    // More [-] than the 0.005 that NormalCone allows. Larger excludes fewer edges and costs time
    // only; at 0.005 or less rounding would exclude axes that are valid.
    static constexpr double kOutside = 0.006;

    std::array<Vec3, 3> side_;
    double size_;
};

}  // namespace ice
