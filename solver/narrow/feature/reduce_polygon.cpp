// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>

#include "common/base/assert.hpp"
#include "solver/narrow/feature/contact_polygon.hpp"

namespace ice {

namespace {

// A sort key that mirror images about y = 0 have in common.
auto mirror_key(const PolygonCorner& c) {
    return std::tuple(c.point.x(), std::abs(c.point.y()), c.point.z());
}

// Area of the triangle that the polygon loses with corner k [m2], twice.
double loss_of(const std::vector<PolygonCorner>& corners, std::size_t k) {
    const std::size_t n = corners.size();
    const Vec3 &at = corners[k].point, before = corners[(k + n - 1) % n].point - at,
               after = corners[(k + 1) % n].point - at;
    return before.cross(after).norm();
}

}  // namespace

void order_around(ContactPolygon& polygon) {
    ICE_ASSERT(!polygon.corners.empty());
    Vec3 middle = Vec3::Zero();
    for (const PolygonCorner& corner : polygon.corners) middle += corner.point;
    middle /= static_cast<double>(polygon.corners.size());
    // two directions in the plane; the normal's least component is at most 0.58
    Vec3::Index least = 0;
    polygon.normal.cwiseAbs().minCoeff(&least);
    const Vec3 x = polygon.normal.cross(Vec3(Vec3::Unit(least))), y = polygon.normal.cross(x);
    // it grows with the angle from -2 to 2, as the angle does from -pi to pi
    const auto turn = [&](const PolygonCorner& c) {
        const double along = x.dot(c.point - middle), aside = y.dot(c.point - middle);
        const double size = std::abs(along) + std::abs(aside);
        if (size == 0.0) return 0.0;
        return aside < 0.0 ? along / size - 1.0 : 1.0 - along / size;
    };
    std::sort(polygon.corners.begin(), polygon.corners.end(),
              [&](const PolygonCorner& l, const PolygonCorner& r) {
                  return std::tuple(turn(l), l.gap, l.id) < std::tuple(turn(r), r.gap, r.id);
              });
}

void reduce_polygon(std::size_t count, ContactPolygon& polygon) {
    ICE_ASSERT(count > 2);
    std::vector<PolygonCorner>& corners = polygon.corners;
    while (corners.size() > count) {
        // The deepest corner stays, as it bounds the overlap; of the others the one is dropped
        // whose removal costs the least area. Ties are decided by place, mirrored alike, so that a
        // mirrored pair keeps mirrored corners.
        std::size_t deepest = 0, least = corners.size();
        for (std::size_t k = 1; k < corners.size(); ++k)
            if (std::tuple(corners[k].gap, mirror_key(corners[k])) <
                std::tuple(corners[deepest].gap, mirror_key(corners[deepest])))
                deepest = k;
        double loss = 0.0;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const double now = loss_of(corners, k);
            if (k == deepest) continue;
            if (least < corners.size() && std::tuple(now, mirror_key(corners[k])) >=
                                              std::tuple(loss, mirror_key(corners[least])))
                continue;
            least = k;
            loss = now;
        }
        corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(least));
    }
}

}  // namespace ice
