// SPDX-License-Identifier: GPL-3.0-or-later
/// A hull that is not convex, and a box beside it: what tests of deep contacts need.
#pragma once

#include <utility>
#include <vector>

#include "tests/support/make_filled_sets.hpp"
#include "tests/support/make_prisms.hpp"
#include "tests/support/make_worlds.hpp"

namespace ice::test {

/// A prism, 1 m high, over a square of 4 m without its quarter x, y > 0: an angle seen from above.
inline TriangleMesh make_angle_mesh() {
    std::vector<Vec3> low, high;
    for (const auto& [x, y] : {std::pair(0, 0), {0, 2}, {-2, 2}, {-2, -2}, {2, -2}, {2, 0}}) {
        low.emplace_back(x, y, -0.5);
        high.emplace_back(x, y, 0.5);
    }
    return make_ring_mesh(low, high);
}

/// The angle as a hull at the origin, and a box of 1.2 x 1 x 0.4 m as a floe at `place` [m]; both
/// have spheres of `radius` [m], 0.1 m apart. The ice is rigid.
inline World angle_and_box(double radius, const Vec3& place,
                           const Quaternion& turn = Quaternion::Identity()) {
    World w;
    w.parameters = empty_space(0.01);
    w.scene = make_scene(build_shape(fill_surface(make_angle_mesh(), radius, 0.1), false),
                         Vec3::Zero(), Vec3::Zero());
    const auto box = add_shape(w, fill_box(Vec3(1.2, 1, 0.4), radius, 0.1));
    add_floe(w.scene, box, 900.0, place, turn, 0, false);
    return w;
}

}  // namespace ice::test
