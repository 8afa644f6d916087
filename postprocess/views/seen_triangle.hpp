// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "common/base/assert.hpp"
#include "common/geometry/triangle_mesh.hpp"

namespace ice::views {

/// A triangle that is seen along z: the places (x, y) that it covers, and its z there [m].
class SeenTriangle {
public:
    SeenTriangle(const Vec3& a, const Vec3& b, const Vec3& c)
        : a_(a),
          b_(b),
          c_(c),
          twice_area_((b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x())) {}

    /// A triangle that is seen from its edge covers no place.
    bool covers_nothing() const { return twice_area_ == 0.0; }

    /// None outside; the border counts. @pre it covers something
    std::optional<double> z_at(double x, double y) const {
        ICE_ASSERT(!covers_nothing());
        // barycentric coordinates; the sign of the area cancels
        const double wb =
            ((x - a_.x()) * (c_.y() - a_.y()) - (y - a_.y()) * (c_.x() - a_.x())) / twice_area_;
        const double wc =
            ((b_.x() - a_.x()) * (y - a_.y()) - (b_.y() - a_.y()) * (x - a_.x())) / twice_area_;
        if (wb < 0.0 || wc < 0.0 || wb + wc > 1.0) return std::nullopt;
        return a_.z() + wb * (b_.z() - a_.z()) + wc * (c_.z() - a_.z());
    }

private:
    Vec3 a_, b_, c_;
    double twice_area_;  // signed [m2]
};

}  // namespace ice::views
