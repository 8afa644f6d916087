// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "solver/broad/motion_bounds.hpp"
#include "solver/scene/bodies.hpp"
#include "solver/shape/sphere_grid.hpp"

namespace ice {

/// Two bodies, by number, that may touch within the step; a < b, so a hull pair has a = 0.
struct BodyPair {
    std::int32_t a, b;
    friend bool operator==(const BodyPair&, const BodyPair&) = default;
    friend auto operator<=>(const BodyPair&, const BodyPair&) = default;
};

/// Pairs whose bounding spheres (for the ship: its box) come within `margin` [m] of each other.
///
/// A uniform grid over the positions of floes near moving ones, so the cost is O(floes). Pairs
/// of two held floes are left out: neither can move. Sorted by a, then b; the result does not
/// depend on thread count. A scene without floes has none; a floe whose position is not a number
/// has none with other floes. @pre Bodies::moving lists the floes that are not held, ascending
/// @param out  its old content is dropped
void find_pairs(const Scene& scene, double margin, std::vector<BodyPair>& out);

namespace reference {
/// Finds pairs by testing all: the definition and the oracle of the tests.
void find_pairs(const Scene& scene, double margin, std::vector<BodyPair>& out);
}  // namespace reference

/// Work memory of a search for pairs: the floes whose position is a number, and a grid of them.
struct PlacedFloes {
    std::vector<std::int32_t> floes;
    std::vector<Vec3> places;  ///< [m]
    SphereGrid grid;
};

/// The pairs of bodies that may touch within a step: a neighbour list, renewed when a path exceeds
/// the skin. A renewal costs as much as there are floes in the box of all moving bodies. Held floes
/// outside it are assumed to stay in place; drifting ones are searched each time.
class PairList {
public:
    /// Brings the list up to date: afterwards it holds all pairs that find_pairs gives for bodies
    /// that keep their velocities for the coming step (MotionBounds::update), and others.
    /// @param margin  [m] beyond that motion
    void update(const Scene& scene, const MotionBounds& motion, double margin);

    /// Sorted by a, then b; empty before the first update().
    const std::vector<BodyPair>& pairs() const { return pairs_; }

private:
    bool is_good(const Scene& scene, const MotionBounds& motion) const;

    std::vector<BodyPair> pairs_;
    std::vector<std::int32_t> moving_;           // the floes that moved when the list was made
    std::vector<double> path_;                   // theirs then [m]
    double ship_path_ = 0.0, drift_path_ = 0.0;  // those of the ship and of drift then [m]
    std::int32_t drifting_ = -1;                 // the held floe that drifts fastest; -1: none does
    Eigen::AlignedBox3d vicinity_;               // of all moving bodies
    std::vector<std::int32_t> floes_;            // in it, held ones too
    std::size_t bodies_ = 0;                     // that were searched for them
    PlacedFloes placed_;                         // of these floes, when the list was made
};

}  // namespace ice
