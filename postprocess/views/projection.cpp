// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/views/projection.hpp"

#include <Eigen/Geometry>

namespace ice::views {

Projection projection_of(ViewFrom from) {
    // Page to the right, page up, and the way to the viewer: right x up = toward in all of them, so
    // no view is a mirror image.
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    switch (from) {
        case ViewFrom::below:
            return {x, -y, -z};
        case ViewFrom::top:
            return {x, y, z};
        case ViewFrom::side:
            return {x, z, -y};
        case ViewFrom::port:
            return {-x, z, y};
        case ViewFrom::front:
            return {y, z, x};
        case ViewFrom::quarter:
            break;
    }
    const Vec3 toward = Vec3(0.45, -0.72, -0.53).normalized();
    const Vec3 right = z.cross(toward).normalized();
    return {right, toward.cross(right), toward};
}

std::optional<ViewFrom> parse_view(const std::string& name) {
    if (name == "below") return ViewFrom::below;
    if (name == "top") return ViewFrom::top;
    if (name == "side") return ViewFrom::side;
    if (name == "port") return ViewFrom::port;
    if (name == "front") return ViewFrom::front;
    if (name == "quarter") return ViewFrom::quarter;
    return std::nullopt;
}

std::string view_caption(ViewFrom from) {
    switch (from) {
        case ViewFrom::below:
            return "From below";
        case ViewFrom::top:
            return "From above";
        case ViewFrom::side:
            return "From starboard";
        case ViewFrom::port:
            return "From port";
        case ViewFrom::front:
            return "From ahead";
        case ViewFrom::quarter:
            break;
    }
    return "From ahead and below";
}

}  // namespace ice::views
