// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/broad/find_pairs.hpp"
#include "solver/narrow/kind_bound.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Two spheres that may touch before their bodies have gone too far.
struct SpherePair {
    std::int32_t a, b;
};

/// What is known of pairs of bodies until they have gone too far: how far they may go before they
/// can touch, and which of their spheres may.
class DormantPairs {
public:
    /// Takes what is known of pairs over to a new list; both sorted.
    void match(const std::vector<BodyPair>& pairs);

    /// May row k's bodies touch within the coming step, as far as is known?
    bool is_awake(std::size_t k, BodyPair pair, const Travel& travel) const {
        return !is_known(k, pair, travel) ||
               travel.soon(pair.a) + travel.soon(pair.b) >= rows_[k].wake;
    }
    /// Is what is known of row k still true at the end of the coming step?
    bool is_known(std::size_t k, BodyPair pair, const Travel& travel) const {
        return travel.soon(pair.a) + travel.soon(pair.b) < rows_[k].way &&
               travel.turn(pair.a) + travel.turn(pair.b) < rows_[k].turn;
    }

    /// Spheres of row k that may touch while it is known; good until the next keep() or match().
    std::span<const SpherePair> near(std::size_t k) const {
        return {near_.data() + rows_[k].first, rows_[k].count};
    }

    /// From now on row k is known as far as `leeway`, and cannot touch before its bodies have gone
    /// `free` [m] together. Rows may be settled at the same time.
    void settle(std::size_t k, BodyPair pair, const Travel& travel, const Leeway& leeway,
                double free);

    /// Keeps the spheres of row k that may touch while it is known.
    void keep(std::size_t k, std::span<const SpherePair> near);

private:
    struct Row {
        double wake = 0.0;                 // sum of the bodies' ways at which they may touch [m]
        double way = 0.0, turn = 0.0;      // sums at which nothing is known any more [m], [rad]
        std::size_t first = 0, count = 0;  // of near_
    };
    void close_gaps();

    std::vector<BodyPair> pairs_;
    std::vector<Row> rows_, moved_;  // by pair
    std::vector<SpherePair> near_, moved_near_;
    std::size_t kept_ = 0;  // entries of near_ that rows use
};

/// How far a pair is looked ahead.
Leeway dormant_leeway(const Scene& scene, BodyPair pair);

}  // namespace ice
