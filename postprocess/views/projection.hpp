// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "common/geometry/triangle_mesh.hpp"

namespace ice::views {

/// The viewer's place. The bow is at the right, except for `port`, where it is at the left,
/// and for `front`, which looks aft.
enum class ViewFrom { below, top, side, port, front, quarter };

/// Parallel projection of world axes onto the page; right x up = toward.
struct Projection {
    Vec3 right, up;  ///< unit vectors on the page
    Vec3 toward;     ///< unit vector to the viewer
    /// (right, up, nearness) of a point [m]; larger nearness is nearer to the viewer
    Vec3 apply(const Vec3& p) const { return {right.dot(p), up.dot(p), toward.dot(p)}; }
};

/// below: starboard is up on the page; side: seen from starboard; port: from port; front: from
/// ahead; quarter: oblique, from ahead, starboard and below.
Projection projection_of(ViewFrom from);

/// "below", "top", "side", "port", "front" or "quarter"; nothing for other names.
std::optional<ViewFrom> parse_view(const std::string& name);

/// Caption: "From below", "From above", ...
std::string view_caption(ViewFrom from);

}  // namespace ice::views
