// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/narrow/dormant_pairs.hpp"

namespace ice {

/// Of the spheres that may touch before their bodies have gone too far, picks those that decide
/// about the contacts of this step. Keeps its memory between pairs.
class DecisiveSpheres {
public:
    /// Before pick: how many spheres the two bodies have.
    void begin(std::size_t spheres_a, std::size_t spheres_b) {
        of_a_.resize(std::max(of_a_.size(), spheres_a), 0);
        of_b_.resize(std::max(of_b_.size(), spheres_b), 0);
    }

    /// Puts into `out` those of `near` whose gap may be at most `gap` [m] after their bodies have
    /// gone `gone` [m], and all that share a sphere with one of them: a face that is farther away
    /// may still show that the sphere is outside (keep_one_per_face). No other ones have a contact
    /// of that gap, or change one. The order is kept.
    void pick(std::span<const SpherePair> near, double gone, double gap,
              std::vector<SpherePair>& out) {
        ++call_;
        const double most = gone + gap;
        for (const SpherePair& s : near) {
            if (s.least > most) continue;
            mark(of_a_, s.a);
            mark(of_b_, s.b);
        }
        out.clear();
        for (const SpherePair& s : near)
            if (is_marked(of_a_, s.a) || is_marked(of_b_, s.b)) out.push_back(s);
    }

private:
    using Marks = std::vector<std::uint64_t>;  // by sphere: the last call that marked it
    void mark(Marks& marks, std::int32_t sphere) const {
        marks[static_cast<std::size_t>(sphere)] = call_;
    }
    bool is_marked(const Marks& marks, std::int32_t sphere) const {
        return marks[static_cast<std::size_t>(sphere)] == call_;
    }

    Marks of_a_, of_b_;
    std::uint64_t call_ = 0;
};

}  // namespace ice
