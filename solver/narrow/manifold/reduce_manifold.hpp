// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "solver/narrow/feature/pair_view.hpp"

namespace ice {

/// Work memory of reduce_manifold, which keeps its capacity between pairs.
struct ReductionWork {
    /// A candidate's place in the order: by incident sphere, then by distance, ties by the mirror
    /// rank. Candidates are large: rows are sorted in their place.
    struct Row {
        std::int64_t incident;
        double reference_offset_sq;  ///< [m2]
        const Candidate* candidate;
    };
    std::vector<Row> rows;
    std::vector<Candidate> kept;
};

/// Reduces a pair's candidates to contacts: one for each incident sphere and reference face, the
/// laterally nearest. Where two faces meet at a convex edge it keeps the one with the smaller
/// penetration: a point behind only one of the two planes is still outside. Normals within 30
/// degrees count as one face (kSameFace). Clears the candidates if no gap is within `margin` [m],
/// else drops those beyond it, after they have ruled out others. Afterwards the candidates of an
/// incident sphere are adjacent, in an order that mirror images have in common.
void reduce_manifold(const PairView& view, double margin, ReductionWork& work,
                     std::vector<Candidate>& candidates);

}  // namespace ice
