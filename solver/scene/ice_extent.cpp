// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/scene/ice_extent.hpp"

namespace ice {

namespace {

Eigen::AlignedBox2d seen_from_above(const Eigen::AlignedBox3d& box) {
    return {box.min().head<2>(), box.max().head<2>()};
}

// Do two ranges share more than a point?
bool meet(double low_a, double high_a, double low_b, double high_b) {
    return low_a < high_b && low_b < high_a;
}

}  // namespace

Eigen::AlignedBox3d box_of(const Scene& scene, std::size_t body) {
    const Bodies& b = scene.bodies;
    const Shape& shape = scene.shapes[static_cast<std::size_t>(b.shape[body])];
    Eigen::AlignedBox3d box;
    for (const Vec3& v : shape.mesh.vertices) box.extend(b.position[body] + b.rotation[body] * v);
    return box;
}

bool is_unbroken(const Scene& scene, const Case& parameters, std::size_t floe) {
    return parameters.floes[static_cast<std::size_t>(scene.bodies.group[floe])].hold ==
           Hold::always;
}

IceAtStart find_ice_at_start(const Scene& scene, const Case& parameters) {
    // level ice that never moves is the channel's wall; all other floes lie in the channel
    IceAtStart ice;
    std::vector<Eigen::AlignedBox2d> unbroken;
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
        const Eigen::AlignedBox2d box = seen_from_above(box_of(scene, i));
        if (is_unbroken(scene, parameters, i))
            unbroken.push_back(box);
        else
            ice.loose.extend(box);
    }
    if (ice.loose.isEmpty()) return ice;
    // Unbroken ice beside the loose floes on both sides makes a channel; unbroken ice ahead of
    // them, across the channel's middle, closes it.
    bool starboard = false, port = false;
    const Eigen::Vector2d low = ice.loose.min(), high = ice.loose.max(),
                          middle = ice.loose.center();
    for (const Eigen::AlignedBox2d& u : unbroken) {
        const bool beside = meet(u.min().x(), u.max().x(), low.x(), high.x());
        starboard |= beside && u.center().y() < low.y();
        port |= beside && u.center().y() > high.y();
        ice.closed |=
            u.center().x() > high.x() && u.min().y() <= middle.y() && u.max().y() >= middle.y();
    }
    ice.walls = starboard && port;
    return ice;
}

}  // namespace ice
