// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/broad/find_pairs.hpp"
#include "solver/narrow/kind_bound.hpp"
#include "solver/narrow/pair_view.hpp"
#include "solver/narrow/separating_axis.hpp"
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

    /// What row k's bodies may do within the coming step, as far as is known.
    enum class State {
        asleep,   ///< they cannot touch
        polygon,  ///< they may, and meet along axes(k)
        known,    ///< they may, with the spheres of near(k)
        unknown   ///< they have gone too far
    };
    /// @param margin  [m] bodies that are further apart at the end of the step have no contact
    /// @param polygon  the solids meet in a polygon (meets_in_polygon)
    /// @pre travel was updated with the present poses and dt
    State look(std::size_t k, const Scene& scene, BodyPair pair, const Travel& travel, double dt,
               double margin, bool polygon);

    /// The separating axes of row k's solids. @pre look() found State::polygon
    const SeparatingAxes& axes(std::size_t k) const { return rows_[k].axes; }

    /// Spheres of row k that may touch while it is known; good until the next keep() or match().
    std::span<const SpherePair> near(std::size_t k) const {
        return {near_.data() + rows_[k].first, rows_[k].count};
    }

    /// May row k's solids overlap so far that spheres have lost each other (is_deep, DeepSeat)?
    /// @pre look() found it known or unknown
    bool deep(std::size_t k) const { return rows_[k].deep; }

    /// No seat of row k lies deep before its bodies have moved `room` [m] relative to each other
    /// (find_deep_seats). Rows may be told at the same time.
    void set_room(std::size_t k, const PairView& view, double room);

    /// From now on row k is known as far as `leeway`, and cannot touch before its bodies have gone
    /// `free` [m] relative to each other. Rows may be settled at the same time.
    void settle(std::size_t k, const PairView& view, const Travel& travel, const Leeway& leeway,
                double free);

    /// Keeps the spheres of row k that may touch while it is known.
    void keep(std::size_t k, std::span<const SpherePair> near);

private:
    struct Row {
        // where b was in a's axes when the row was settled
        Mat3 turn = Mat3::Zero();
        Vec3 shift = Vec3::Zero();
        double crushed = 0.0;       // of both bodies then [m]
        double free = 0.0;          // how far they may go until they touch, and until nothing is
        Leeway leeway{-1.0, -1.0};  // known any more
        // sums of the bodies' soon() and turn() at which to look at the poses again: going the same
        // way they come no nearer to each other
        double soon_wake = 0.0, soon_unknown = 0.0, turn_unknown = 0.0;
        double room = 0.0;                 // until seats may lie deep, when last looked at [m]
        std::size_t axis = 0;              // of separation(), when last looked at
        SeparatingAxes axes;               // instead of it where the solids meet in a polygon
        std::size_t first = 0, count = 0;  // of near_
        bool deep = false;
        // where b was when its seats were looked at last, and how far they may go from there
        Mat3 seat_turn = Mat3::Zero();
        Vec3 seat_shift = Vec3::Zero();
        double seat_room = -1.0;
    };
    // How far apart row k's solids are at least: exact where it is no more than `enough` [m].
    static double part_solids(Row& row, const PairView& view, double enough);
    static void remind(Row& row, BodyPair pair, const Travel& travel, double gone, double turned);
    // How far the pair may go until its seats have to be looked at [m].
    static double room_left(const Row& row, const PairView& view, double apart);
    void close_gaps();

    std::vector<BodyPair> pairs_;
    std::vector<Row> rows_, moved_;  // by pair
    std::vector<SpherePair> near_, moved_near_;
    std::size_t kept_ = 0;  // entries of near_ that rows use
};

/// How far a pair is looked ahead. @param dt  the step [s]
Leeway dormant_leeway(const Scene& scene, BodyPair pair, double dt);

}  // namespace ice
