// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/live_edge/hull_outlines.hpp"

#include <utility>

#include "solver/level_ice/section_outline.hpp"

namespace ice {

std::vector<Loop> hull_outlines(const Scene& scene, double top, double bottom) {
    const Bodies& b = scene.bodies;
    // in the ship's present pose: a free ship may be trimmed or heeled
    TriangleMesh hull = scene.shapes[0].mesh;
    for (Vec3& v : hull.vertices) v = b.position[kShip] + b.rotation[kShip] * v;
    std::vector<Loop> out;
    for (const double height : {top, bottom}) {
        Loop outline = section_outline(hull, height);
        if (outline.size() >= 3) out.push_back(std::move(outline));
    }
    return out;
}

}  // namespace ice
