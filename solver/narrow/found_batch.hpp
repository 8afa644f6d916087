// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solver/narrow/feature/contact_polygon.hpp"
#include "solver/narrow/manifold/deep_seats.hpp"
#include "solver/narrow/manifold/find_polygon.hpp"
#include "solver/narrow/manifold/make_contacts.hpp"
#include "solver/narrow/manifold/measure_spheres.hpp"
#include "solver/narrow/manifold/reduce_manifold.hpp"
#include "solver/narrow/neighbours/pair_cache.hpp"
#include "solver/narrow/neighbours/search_pair.hpp"

namespace ice {

/// A pair's part of one of FoundBatch's lists.
struct FoundPart {
    std::size_t first = 0, count = 0;

    /// Appends what was found for a pair to the thread's list.
    template <class T>
    static FoundPart append(const std::vector<T>& found, std::vector<T>& list) {
        const FoundPart out{list.size(), found.size()};
        list.insert(list.end(), found.begin(), found.end());
        return out;
    }
    template <class T>
    std::span<const T> of(const std::vector<T>& list) const {
        return std::span(list).subspan(first, count);
    }
};

/// What one thread finds for its pairs, one pair after the other, and its work memory. Stored by
/// thread: lists by pair would all grow to the largest pair's size.
struct FoundBatch {
    std::vector<Candidate> candidates;  ///< that are contacts
    std::vector<SpherePair> spheres;    ///< newly listed
    std::vector<MetCorner> corners;
    std::vector<DeepSeat> seats;

    /// Of the pair at hand.
    struct Pair {
        PairSearch search;
        std::vector<SpherePair> spheres;
        std::vector<Candidate> candidates;
        std::vector<DeepSeat> seats;
        ContactPolygon polygon;
        SectionWork section;

        // work memory of the functions that find and make these
        std::vector<TypesRow> rows;
        ReductionWork reduction;
        ClippingWork clipping;
        PartsWork parts;
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
