// SPDX-License-Identifier: GPL-3.0-or-later
/// Loops over the floes that are not held, by several threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "common/base/parallel.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Below this many bodies [-] waking threads costs more than they save. Only time depends on it.
constexpr std::size_t kSerialBodies = 512;

/// Calls body(i, k) for every floe i that is not held, the k-th of them.
template <class Body>
void for_each_moving(const Bodies& b, const Body& body) {
    parallel_for(b.moving.size(), kSerialBodies,
                 [&](std::size_t k) { body(static_cast<std::size_t>(b.moving[k]), k); });
}

/// Calls body(floes, k) for groups of floes that are not held, the first the k-th of all.
template <class Body>
void for_each_group(const Bodies& b, const Body& body) {
    // as many at once as the widest instruction set has lanes
    constexpr std::size_t kGroup = 8;
    const std::span<const std::int32_t> moving = b.moving;
    parallel_for((moving.size() + kGroup - 1) / kGroup, kSerialBodies / kGroup, [&](std::size_t g) {
        const std::size_t first = kGroup * g;
        body(moving.subspan(first, std::min(kGroup, moving.size() - first)), first);
    });
}

}  // namespace ice
