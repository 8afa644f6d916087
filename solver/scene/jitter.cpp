// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/scene/jitter.hpp"

#include <cmath>

namespace ice {

namespace {

// splitmix64: the n-th word of a stream is a function of seed and n alone
std::uint64_t random_word(std::uint64_t seed, std::uint64_t n) {
    std::uint64_t z = (seed << 32) + 0x9e3779b97f4a7c15ull * (n + 1);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
}

// uniform in (-1, 1)
double random_offset(std::uint64_t seed, std::uint64_t n) {
    return static_cast<double>(random_word(seed, n) >> 11) * 0x1p-52 - 1.0;
}

}  // namespace

void apply_jitter(Scene& scene, const Case& parameters) {
    if (parameters.jitter == 0.0) return;
    Bodies& b = scene.bodies;
    const auto seed = static_cast<std::uint64_t>(parameters.seed);
    for (std::size_t i = 1; i < b.size(); ++i) {
        if (parameters.floes[static_cast<std::size_t>(b.group[i])].hold == Hold::always) continue;
        const auto draw = [&](std::uint64_t k) {
            return parameters.jitter * random_offset(seed, 3 * i + k);
        };
        b.position[i].x() += draw(0);
        if (scene.dimension == 2) continue;
        b.position[i].y() += draw(1);
        const Shape& shape = scene.shapes[static_cast<std::size_t>(b.shape[i])];
        const double half_side = 0.5 * shape.box.sizes().maxCoeff();
        // half the angle for its tangent: the same bits whatever the system's libm
        const Quaternion turn(1.0, 0.0, 0.0, 0.5 * draw(2) / half_side);
        b.orientation[i] = (turn * b.orientation[i]).normalized();
        update_derived(b, i);
    }
}

}  // namespace ice
