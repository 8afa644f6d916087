// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/narrow/contact_polygon.hpp"
#include "solver/narrow/deep_seats.hpp"
#include "solver/narrow/make_contacts.hpp"
#include "solver/narrow/measure_spheres.hpp"
#include "solver/narrow/pair_cache.hpp"
#include "solver/narrow/reduce_manifold.hpp"
#include "solver/narrow/search_pair.hpp"

namespace ice {

/// What one thread finds for its pairs, one pair after the other, and its work memory. Stored by
/// thread: lists by pair would all grow to the largest pair's size.
struct FoundBatch {
    std::vector<Candidate> candidates;  ///< that are contacts
    std::vector<SpherePair> spheres;    ///< newly listed
    std::vector<PolygonCorner> corners;
    std::vector<DeepSeat> seats;

    /// Of the pair at hand.
    struct Pair {
        PairSearch search;
        std::vector<SpherePair> spheres;
        std::vector<Candidate> candidates;
        std::vector<DeepSeat> seats;
        ContactPolygon polygon;

        // work memory of the functions that find and make these
        std::vector<TypesRow> rows;
        ReductionWork reduction;
        ClippingWork clipping;
        ContactsWork contacts;
    } pair;

    /// Drops the results and keeps the memory.
    void clear() {
        candidates.clear();
        spheres.clear();
        corners.clear();
        seats.clear();
    }
};

}  // namespace ice
