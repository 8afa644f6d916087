// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/dormant_pairs.hpp"

#include <algorithm>
#include <utility>

namespace ice {

namespace {

// A pair is looked ahead for this turn [rad] and this share of its ice's radius: more keeps more
// spheres, less has to be found anew sooner.
constexpr double kLeewayAngle = 0.015, kLeewayShare = 0.6;

// Up to so many entries gaps do not matter.
constexpr std::size_t kFewest = 4096;

}  // namespace

void DormantPairs::match(const std::vector<BodyPair>& pairs) {
    if (pairs == pairs_) return;
    moved_.assign(pairs.size(), Row{});
    kept_ = 0;
    std::size_t old = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        while (old < pairs_.size() && pairs_[old] < pairs[k]) ++old;
        if (old < pairs_.size() && pairs_[old] == pairs[k]) moved_[k] = rows_[old];
        kept_ += moved_[k].count;
    }
    rows_.swap(moved_);
    pairs_ = pairs;
}

void DormantPairs::keep(std::size_t k, std::span<const SpherePair> near) {
    Row& row = rows_[k];
    kept_ += near.size() - row.count;
    row.count = near.size();
    row.first = near_.size();
    near_.insert(near_.end(), near.begin(), near.end());
    if (near_.size() > kFewest && near_.size() > 2 * kept_) close_gaps();
}

void DormantPairs::close_gaps() {
    moved_near_.clear();
    for (Row& row : rows_) {
        const auto first = near_.begin() + static_cast<std::ptrdiff_t>(row.first);
        row.first = moved_near_.size();
        moved_near_.insert(moved_near_.end(), first,
                           first + static_cast<std::ptrdiff_t>(row.count));
    }
    near_.swap(moved_near_);
}

void DormantPairs::settle(std::size_t k, BodyPair pair, const Travel& travel, const Leeway& leeway,
                          double free) {
    Row& row = rows_[k];
    const double gone = travel.way(pair.a) + travel.way(pair.b);
    row.wake = gone + free;
    row.way = gone + leeway.distance;
    row.turn = travel.turn(pair.a) + travel.turn(pair.b) + leeway.angle;
}

Leeway dormant_leeway(const Scene& scene, BodyPair pair) {
    const auto shape = scene.bodies.shape[static_cast<std::size_t>(pair.b)];
    return {kLeewayShare * scene.shapes[static_cast<std::size_t>(shape)].largest_radius,
            kLeewayAngle};
}

}  // namespace ice
