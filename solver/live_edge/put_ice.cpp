// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/live_edge/put_ice.hpp"

#include <algorithm>
#include <utility>

#include "solver/scene/inertia_of.hpp"
#include "solver/water/hydrostatics.hpp"

namespace ice {

namespace {

// Sets the crushed depths of a body with `spheres` surface spheres back to 0.
void make_whole(CrushedIce& crushed, std::int32_t body, std::size_t spheres) {
    if (crushed.is_whole(body)) return;
    const auto i = static_cast<std::size_t>(body);
    const std::int64_t gone = std::exchange(crushed.first[i], -1);
    const auto count = static_cast<std::int64_t>(spheres);
    // its rows are cut out of the table, and those of later bodies move up
    crushed.deepest[i] = 0.0;
    crushed.displacement.erase(crushed.displacement.begin() + gone,
                               crushed.displacement.begin() + gone + count);
    for (std::int64_t& row : crushed.first)
        if (row > gone) row -= count;
}

}  // namespace

void put_shape(Scene& scene, std::size_t body, Shape shape, double density) {
    Bodies& b = scene.bodies;
    b.mass[body] = density * shape.solid.volume;
    b.inertias[static_cast<std::size_t>(b.inertia_row[body])] = inertia_of(shape, density);
    scene.shapes[static_cast<std::size_t>(b.shape[body])] = std::move(shape);
}

void put_ice(Scene& scene, std::size_t body, Shape shape, const PutIce& as) {
    Bodies& b = scene.bodies;
    const Shape& old = scene.shapes[static_cast<std::size_t>(b.shape[body])];
    make_whole(scene.crushed, static_cast<std::int32_t>(body), old.center.size());
    scene.crushed_solids.forget(static_cast<std::int32_t>(body));
    // afloat at its own draught, without a velocity relative to the ice: no force acts at first
    const double height = floating_height(shape, Mat3::Identity(), as.share);
    put_shape(scene, body, std::move(shape), as.density);
    b.position[body] = {as.at.x(), as.at.y(), height};
    b.orientation[body] = Quaternion::Identity();
    b.momentum[body] = b.mass[body] * Vec3(as.velocity.x(), as.velocity.y(), 0.0);
    b.angular_momentum[body].setZero();
    b.held[body] = as.held ? Bodies::kHeld : Bodies::kFree;
    update_derived(b, body);
    // Moving bodies are listed in ascending order, which is that of all sums over them.
    const auto number = static_cast<std::int32_t>(body);
    const auto place = std::lower_bound(b.moving.begin(), b.moving.end(), number);
    const bool listed = place != b.moving.end() && *place == number;
    if (as.held && listed) b.moving.erase(place);
    if (!as.held && !listed) b.moving.insert(place, number);
}

}  // namespace ice
