// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "solver/broad/find_pairs.hpp"
#include "solver/narrow/measure_gap.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Pairs that need not be looked at: how far their bodies may go before they can touch.
class DormantPairs {
public:
    /// Takes what is known of pairs over to a new list; both sorted. What a body lost by crushing
    /// since the last call wakes its pairs.
    void match(const Scene& scene, const std::vector<BodyPair>& pairs);

    /// May row k's bodies touch within the coming step?
    bool is_awake(std::size_t k, BodyPair pair, const Travel& travel) const {
        return travel.soon(pair.a) + travel.soon(pair.b) >= rows_[k].wake ||
               travel.turn(pair.a) + travel.turn(pair.b) >= rows_[k].turn;
    }

    /// Is it time to ask how far they may go? Not again at once where the answer was: not far.
    bool may_try(std::size_t k) { return rows_[k].wait == 0 || --rows_[k].wait == 0; }

    /// Row k's bodies may now go and turn so far together.
    void settle(std::size_t k, BodyPair pair, const Travel& travel, const Leeway& leeway);

private:
    struct Row {
        double wake = 0.0;  // sum of the bodies' ways at which they may touch [m]
        double turn = 0.0;  // sum of their turns at which they may [rad]
        int wait = 0;       // looks until it is worth to ask again
    };
    std::vector<BodyPair> pairs_;
    std::vector<Row> rows_, moved_;  // by pair
    std::size_t crushed_ = 0;        // CrushedIce::changes at the last match
};

/// How far a pair is looked ahead.
Leeway dormant_leeway(const Scene& scene, BodyPair pair);

}  // namespace ice
