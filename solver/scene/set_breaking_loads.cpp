// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/scene/set_breaking_loads.hpp"

#include <algorithm>
#include <limits>

#include "solver/bending/breaking_load.hpp"

namespace ice {

void set_breaking_loads(Scene& scene, const Case& parameters) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    Bodies& b = scene.bodies;
    const auto bends = [&](std::size_t i) {
        return parameters.floes[static_cast<std::size_t>(b.group[i])].hold == Hold::until_bent;
    };
    // bodies from the last call on: the others have their loads
    for (std::size_t i = std::max(b.breaking_load.size(), kShip + 1); i < b.size(); ++i) {
        if (!bends(i)) continue;
        b.breaking_load.resize(b.size(), kNever);
        const TriangleMesh& mesh = scene.shapes[static_cast<std::size_t>(b.shape[i])].mesh;
        b.breaking_load[i] = breaking_load(measure_outline(mesh, b.rotation[i]), parameters);
    }
    // bodies that came after the last one that bends have no load that breaks them
    if (!b.breaking_load.empty()) b.breaking_load.resize(b.size(), kNever);
}

}  // namespace ice
