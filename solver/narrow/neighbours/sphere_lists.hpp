// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solver/narrow/neighbours/appended_lists.hpp"
#include "solver/narrow/neighbours/touching_spheres.hpp"

namespace ice {

/// Neighbour lists of the rule "centres": the spheres of a pair of bodies that may touch while the
/// bodies move within the skin, and the clearance up to which the pair need not be measured.
class SphereLists {
public:
    /// The list of one pair.
    struct Row {
        // when its spheres were listed
        Mat3 rotation = Mat3::Zero();     ///< PairView's
        Vec3 translation = Vec3::Zero();  ///< PairView's, the list's origin [m]
        double crushed = 0.0;             ///< MotionBounds::crushed of both bodies [m]
        double range = -1.0;  ///< all whose gap was at most this are listed [m]; < 0: none
        double unit = 1.0;    ///< of the list [m]

        std::size_t axis = 0;  ///< of separation(), when last measured
    };

    /// Keeps the rows of pairs that are in the new list, too; both lists are sorted.
    void carry_over(const std::vector<BodyPair>& pairs);

    /// Row of the k-th pair of the last carry_over().
    Row& row(std::size_t k) { return lists_.row(k); }

    /// Pair k has no contact while the sum of its bodies' MotionBounds::path_after_step is less
    /// than this [m].
    double& clearance(std::size_t k) { return clearance_[k]; }

    /// Spheres of pair k that may touch; valid until the next keep() or carry_over().
    std::span<const ListedSpheres> listed(std::size_t k) const { return lists_.listed(k); }

    /// Replaces the spheres of pair k. One thread at a time.
    void keep(std::size_t k, std::span<const ListedSpheres> listed) { lists_.keep(k, listed); }

private:
    // blocks [-] up to which gaps are left, some 100 kB
    static constexpr std::size_t kFewest = 256;

    std::vector<double> clearance_, moved_clearance_;  // by pair; all are read in every step
    AppendedLists<Row, ListedSpheres, kFewest> lists_;
};

}  // namespace ice
