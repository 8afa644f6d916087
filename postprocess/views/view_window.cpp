// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/views/view_window.hpp"

#include <algorithm>

namespace ice::views {

Window choose_window(const Eigen::AlignedBox3d& hull, ViewFrom from, double floe_size,
                     double half_breadth, double waterline) {
    // Shares of the hull's length that show its wake, the ice ahead, and floes under the bottom (no
    // more than a quarter length: larger ice is unbroken and stays at the surface); 1e-3 m keeps a
    // window for a mesh without length.
    const double length = std::max(hull.sizes().x(), 1e-3);
    const double side = half_breadth > 0.0 ? half_breadth : 0.45 * length;
    const double aft = hull.min().x() - 0.25 * length, ahead = hull.max().x() + 0.3 * length;
    const double deep = hull.min().z() - std::clamp(1.8 * floe_size, 0.06 * length, 0.25 * length);
    const double high = std::max(hull.max().z(), waterline) + 0.04 * length;
    switch (from) {
        case ViewFrom::below:
        case ViewFrom::top:
            return {aft, ahead, -side, side};
        case ViewFrom::side:
            return {aft, ahead, deep, high};
        case ViewFrom::port:
            return {-ahead, -aft, deep, high};
        case ViewFrom::front:
            return {-side, side, deep, high};
        case ViewFrom::quarter:
            break;
    }
    // An oblique view has no edges along axes: it shows all eight corners of a box about the hull.
    const Projection p = projection_of(from);
    const Eigen::AlignedBox3d shown(
        Vec3(hull.min().x() - 0.1 * length, -0.8 * side, hull.min().z()),
        Vec3(hull.max().x() + 0.3 * length, 0.8 * side, hull.max().z()));
    Eigen::AlignedBox3d page;
    for (int k = 0; k < 8; ++k)
        page.extend(p.apply(shown.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k))));
    return {page.min().x(), page.max().x(), page.min().y(), page.max().y()};
}

}  // namespace ice::views
