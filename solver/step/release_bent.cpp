// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/step/release_bent.hpp"

#include <algorithm>
#include <utility>

#include "solver/bending/breaking_load.hpp"

namespace ice {

void release_bent(Bodies& bodies) {
    if (bodies.breaking_load.empty()) return;
    for (std::size_t i = kShip + 1; i < bodies.size(); ++i)
        if (bodies.held[i] == Bodies::kBent) release(bodies, i);
}

void BentFloes::add(std::int32_t floe, double up, const Constraint& c) {
    Load& load = loads_[static_cast<std::size_t>(floe)];
    if (load.normal == 0.0) pressed_.push_back(floe);
    load.down -= up;
    load.normal += c.total_normal();
    // v_n is a closing speed: a contact that opens counts with 0.
    load.closing += c.total_normal() * std::max(-c.approach, 0.0);
}

void BentFloes::find(Scene& scene, const Case& parameters,
                     const std::vector<Constraint>& constraints) {
    Bodies& b = scene.bodies;
    if (b.breaking_load.empty()) return;
    loads_.resize(b.size());
    for (const Constraint& c : constraints) {
        if (c.total_normal() <= 0.0) continue;
        // The downward load (26) of ship and moving floes, summed in the order of the contacts.
        const double up = c.total_normal() * c.normal.z() + c.total_tangent().z();  // on b
        if (b.is_unbent(static_cast<std::size_t>(c.b))) add(c.b, up, c);
        if (b.is_unbent(static_cast<std::size_t>(c.a))) add(c.a, -up, c);
    }
    for (const std::int32_t floe : pressed_) {
        const auto i = static_cast<std::size_t>(floe);
        // taken and set to zero at once: the table of loads is empty again for the next step
        const Load load = std::exchange(loads_[i], Load{});
        // Impulses of a step against load times step: P_f f(v_n) dt with the mean closing speed,
        // weighted by normal impulse.
        const double bears =
            b.breaking_load[i] * speed_factor(parameters.bending, load.closing / load.normal);
        // held for the rest of the step, whose impulses were computed with a floe that cannot move
        if (load.down >= bears * parameters.time_step) b.held[i] = Bodies::kBent;
    }
    pressed_.clear();
}

}  // namespace ice
