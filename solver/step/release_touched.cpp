// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/step/release_touched.hpp"

#include <Eigen/Geometry>

namespace ice {

namespace {

bool touches(const Bodies& b, const Contact& c, double dt) {
    const auto velocity_at = [&](std::int32_t i) -> Vec3 {
        return b.velocity[i] + b.angular_velocity[i].cross(b.arm(i, c.point));
    };
    // the same criterion as for impacts
    const double approach = (velocity_at(c.b) - velocity_at(c.a)).dot(c.normal);
    return meet_within(c.gap, approach, dt);
}

// May `touched` be released by a contact with `other`?
bool may_release(const Scene& scene, const Case& parameters, std::int32_t touched,
                 std::int32_t other) {
    const Bodies& b = scene.bodies;
    if (touched == static_cast<std::int32_t>(kShip) || !b.held[touched]) return false;
    const bool ship = other == static_cast<std::int32_t>(kShip);
    switch (parameters.floes[static_cast<std::size_t>(b.group[touched])].hold) {
        case Hold::never:
            return true;
        case Hold::until_hull_contact:
            return ship;
        case Hold::until_contact:
            return ship || !b.held[other];
        case Hold::until_bent:  // release_bent() has the rule; ice without strength needs no load
            return b.breaking_load_of(touched) == 0.0 && (ship || !b.held[other]);
        case Hold::always:
            return false;
    }
    return false;
}

}  // namespace

bool release_touched(Scene& scene, const Case& parameters, const std::vector<Contact>& contacts) {
    if (scene.bodies.moving.size() + 1 == scene.bodies.size()) return false;  // none is held
    // The caller searches contacts again while floes are released: a released floe may press on the
    // next.
    bool any = false;
    for (const Contact& c : contacts) {
        // either body may be held by the rule of its own group
        const bool a = may_release(scene, parameters, c.a, c.b);
        const bool b = may_release(scene, parameters, c.b, c.a);
        if ((!a && !b) || !touches(scene.bodies, c, parameters.time_step)) continue;
        if (a) release(scene.bodies, c.a);
        if (b) release(scene.bodies, c.b);
        any = true;
    }
    return any;
}

}  // namespace ice
