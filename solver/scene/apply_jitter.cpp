// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/scene/apply_jitter.hpp"

#include "common/base/counter_random.hpp"

namespace ice {

void apply_jitter(Scene& scene, const Case& parameters) {
    if (parameters.jitter == 0.0) return;
    Bodies& b = scene.bodies;
    const auto seed = static_cast<std::uint64_t>(parameters.seed);
    for (std::size_t i = 1; i < b.size(); ++i) {
        if (parameters.floes[static_cast<std::size_t>(b.group[i])].hold == Hold::always) continue;
        // three numbers for each floe from its own number: other floes do not change them
        const auto draw = [&](std::uint64_t k) {
            return parameters.jitter * random_offset(seed, 3 * i + k);
        };
        b.position[i].x() += draw(0);
        if (scene.dimension == 2) continue;
        b.position[i].y() += draw(1);
        // a turn that moves the floe's sides by about as much as its centre
        const Shape& shape = scene.shapes[static_cast<std::size_t>(b.shape[i])];
        const double half_side = 0.5 * shape.box.sizes().maxCoeff();
        // half the angle for its tangent: the same bits whatever the system's libm
        const Quaternion turn(1.0, 0.0, 0.0, 0.5 * draw(2) / half_side);
        b.orientation[i] = (turn * b.orientation[i]).normalized();
        update_derived(b, i);
    }
}

}  // namespace ice
