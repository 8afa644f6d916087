// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/dormant_pairs.hpp"

#include <algorithm>

namespace ice {

namespace {

// To ask costs as much as to look: worth it from this distance on [m], else not for some looks.
constexpr double kWorth = 0.002;
constexpr int kWait = 4;

// A pair is looked ahead for this turn [rad] and one radius of its ice: more leaves more undecided.
constexpr double kLeewayAngle = 0.01;

}  // namespace

void DormantPairs::match(const Scene& scene, const std::vector<BodyPair>& pairs) {
    if (crushed_ != scene.crushed.changes) {
        crushed_ = scene.crushed.changes;
        for (std::size_t k = 0; k < rows_.size(); ++k)
            if (!scene.crushed.is_whole(pairs_[k].a) || !scene.crushed.is_whole(pairs_[k].b))
                rows_[k].wake = 0.0;
    }
    if (pairs == pairs_) return;
    moved_.assign(pairs.size(), Row{});
    std::size_t old = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        while (old < pairs_.size() && pairs_[old] < pairs[k]) ++old;
        if (old < pairs_.size() && pairs_[old] == pairs[k]) moved_[k] = rows_[old];
    }
    rows_.swap(moved_);
    pairs_ = pairs;
}

void DormantPairs::settle(std::size_t k, BodyPair pair, const Travel& travel,
                          const Leeway& leeway) {
    Row& row = rows_[k];
    row = {0.0, 0.0, kWait};
    if (leeway.distance < kWorth) return;
    row.wake = travel.way(pair.a) + travel.way(pair.b) + leeway.distance;
    row.turn = travel.turn(pair.a) + travel.turn(pair.b) + leeway.angle;
    row.wait = 0;
}

Leeway dormant_leeway(const Scene& scene, BodyPair pair) {
    const auto shape = scene.bodies.shape[static_cast<std::size_t>(pair.b)];
    return {scene.shapes[static_cast<std::size_t>(shape)].largest_radius, kLeewayAngle};
}

}  // namespace ice
