// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "postprocess/views/faces.hpp"
#include "postprocess/views/projection.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::views {

/// Metres on the page -> pixels; the same scale both ways, up is up.
struct PageScale {
    double left = 0.0, top = 0.0;  ///< metres at pixel (x0, y0)
    double x0 = 0.0, y0 = 0.0;     ///< [px]
    double per_metre = 1.0;        ///< [px/m]
    /// Pixel of a place on the page [m].
    Vec2 pixel(double right, double up) const {
        return {x0 + (right - left) * per_metre, y0 + (top - up) * per_metre};
    }
};

/// Base colours of the hull's faces, red, green, blue in [0, 255].
struct HullColours {
    Eigen::Vector3i wet{186, 84, 62}, dry{112, 124, 136};
};

/// The hull as SVG: faces under and above the waterline in different colours, shaded, far ones
/// first, then its silhouette and, from above and below, its waterline.
/// @param mesh in the ship frame; @param waterline height of the water there [m]
std::string draw_hull(const TriangleMesh& mesh, const Projection& projection,
                      const PageScale& scale, double waterline, const HullColours& colours = {});

/// The two halves of draw_hull(): ice drawn between them hides faces, but no outline. Arguments as
/// above.
std::string draw_hull_faces(const TriangleMesh& mesh, const Projection& projection,
                            const PageScale& scale, double waterline,
                            const HullColours& colours = {});
std::string draw_hull_lines(const TriangleMesh& mesh, const Projection& projection,
                            const PageScale& scale, double waterline);

/// Brightness of a face in [0.68, 1.06] [-], in steps that the eye does not see: light comes from
/// the viewer's upper left.
double brightness(const Vec3& normal, const Projection& projection);

}  // namespace ice::views
