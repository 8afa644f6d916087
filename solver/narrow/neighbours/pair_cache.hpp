// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/broad/find_pairs.hpp"
#include "solver/narrow/feature/feature_pair_bound.hpp"
#include "solver/narrow/feature/pair_view.hpp"
#include "solver/narrow/feature/separating_axis.hpp"
#include "solver/narrow/feature/solid_pair.hpp"
#include "solver/narrow/neighbours/appended_lists.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Two spheres, by number, that may touch while their bodies move within the skin.
struct SpherePair {
    std::int32_t a, b;
};

/// Neighbour lists of pairs of bodies: the clearance before they can touch, and the spheres that
/// may touch, both valid while the bodies move within the skin. Row k is that of the k-th pair of
/// the last carry_over().
class PairCache {
public:
    /// Keeps the rows of pairs that are in the new list, too; both lists are sorted.
    void carry_over(const std::vector<BodyPair>& pairs);

    /// Makes the rows of all pairs with these bodies stale. @pre sorted
    void forget(const std::vector<std::int32_t>& bodies);

    /// State of a pair for the coming step.
    enum class State {
        separated,  ///< the bodies cannot touch
        polygon,    ///< they may touch, as solids
        listed,     ///< they may touch, with the spheres of listed(k)
        stale       ///< the list is no longer valid
    };
    /// @param margin  [m] bodies that are further apart at the end of the step have no contact
    /// @param how  how the pair's contacts are found
    /// @pre motion was updated with the present poses and dt
    State state(std::size_t k, const Scene& scene, BodyPair pair, const MotionBounds& motion,
                double dt, double margin, PairRule how);

    /// The separating axes of row k's solids. @pre state() returned State::polygon, both are convex
    const SeparatingAxes& axes(std::size_t k) const { return lists_.row(k).axes; }

    /// Spheres of row k that may touch, and its seats that may lie deep (list_near_seats); valid
    /// until the next keep() or carry_over().
    std::span<const SpherePair> listed(std::size_t k) const { return lists_.listed(k); }

    /// How far apart row k's solids were at the last state(): a lower bound, exact between two
    /// convex ones [m]. @pre it returned State::listed or State::stale
    double apart(std::size_t k) const { return lists_.row(k).apart; }

    /// May row k's solids overlap so far that spheres have lost each other (is_deep, DeepSeat)?
    /// @pre state() returned State::listed
    bool may_be_deep(std::size_t k) const { return lists_.row(k).deep; }

    /// How far the bodies of a row may move relative to each other [m] before spheres can touch,
    /// and before seats can lie deep.
    struct Clearance {
        double spheres = 0.0, seats = 0.0;
    };
    /// Starts a new list of row k, valid within `skin`. Different rows may be renewed at the same
    /// time.
    void renew(std::size_t k, const PairView& view, const MotionBounds& motion, const Skin& skin,
               const Clearance& clearance);

    /// Stores the list of row k. One thread at a time.
    void keep(std::size_t k, std::span<const SpherePair> near) { lists_.keep(k, near); }

private:
    struct Row {
        // pose of b in a's axes when the row was renewed
        Mat3 rotation = Mat3::Zero();
        Vec3 translation = Vec3::Zero();
        double crushed = 0.0;  // of both bodies then [m]
        Clearance clearance;
        Skin skin{-1.0, -1.0};
        // Sums of both bodies' paths and rotations up to which their poses need not be compared:
        // the relative motion is at most that sum. Until the pair may touch [m]; until it is stale
        // [m], [rad].
        double path_clearance = 0.0, path_stale = 0.0, rotation_stale = 0.0;
        std::size_t axis = 0;  // of separation(), when last compared
        SeparatingAxes axes;   // instead of it where two convex solids meet in a polygon
        double apart = 0.0;    // when last compared [m]
        bool deep = false;
    };
    // A lower bound of the distance of row k's solids; of two convex ones exact where it is at most
    // `enough` [m].
    static double separation_of_solids(Row& row, const PairView& view, double enough);
    static void set_clearances(Row& row, BodyPair pair, const MotionBounds& motion, double gone,
                               double turned);

    // Entries [-] up to which lists that are no longer in use cost less than closing the gaps.
    static constexpr std::size_t kFewest = 4096;

    AppendedLists<Row, SpherePair, kFewest> lists_;
};

/// The skin of a pair: its motion within five steps, between 0.3 and 0.6 of the ice's radius and
/// between 0.0075 and 0.015 rad (pair_cache.cpp). @param dt  the step [s]
Skin skin_of(const Scene& scene, BodyPair pair, double dt);

/// Is a list with this skin valid for two steps of `dt` [s]? A list for one step costs more than it
/// saves.
bool lasts(const Scene& scene, BodyPair pair, const Skin& skin, double dt);

}  // namespace ice
