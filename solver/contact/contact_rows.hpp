// SPDX-License-Identifier: GPL-3.0-or-later
/// Contacts as the sweeps of the solver read them: eight body pairs beside each other
/// (docs/method.md, section 4).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/assert.hpp"
#include "solver/contact/constraints.hpp"

namespace ice {

/// Body pairs in a block [-]; fixed, so that the arithmetic's order depends on no instruction set.
/// Eight doubles are the widest vector in use; another number gives other last digits.
constexpr std::size_t kLanes = 8;

/// One number for each pair of a block.
struct alignas(64) LaneValues {
    double v[kLanes];  ///< by lane
};
using LaneVectors = std::array<LaneValues, 3>;  ///< x, y, z

/// The vector in one lane.
inline Vec3 get(const LaneVectors& from, std::size_t lane) {
    return {from[0].v[lane], from[1].v[lane], from[2].v[lane]};
}

/// Impulses of a row: what a sweep changes.
struct RowImpulses {
    LaneValues normal;    ///< accumulated in the stage, >= 0 [N s]
    LaneVectors tangent;  ///< friction, across the normal, world axes [N s]
};

/// One contact of each pair of a block; where a pair has no more contacts all is zero.
struct ContactRow {
    LaneVectors normal, arm_a, arm_b;           ///< as in Constraint; arms [m]
    LaneVectors response;                       ///< change of v_r by a unit normal impulse [1/kg]
    LaneValues inverse_effective_mass;          ///< k(n) [1/kg]
    LaneValues tangent_inverse_effective_mass;  ///< largest k(t) [1/kg]
    LaneValues effective_mass, tangent_effective_mass;  ///< 1 / the responses [kg]
    LaneValues friction;                                ///< Coulomb's coefficient [-]
    // of the stage
    LaneValues target_velocity;  ///< v* of (6): least v_r . n [m/s]
    LaneValues max_impulse;      ///< largest normal impulse, >= 0 [N s]
    RowImpulses impulse;
};

/// Eight body pairs without a common free body, so that they may be solved at once.
struct PairBlock {
    std::int32_t first_row = 0, rows = 0;  ///< of ContactRows::rows
    /// Blocks of one colour share no free body either; within a colour the number of rows falls.
    std::int32_t colour = 0;
    std::array<std::int32_t, kLanes> a{}, b{};      ///< local bodies; lanes without a pair: -1
    LaneValues inverse_mass_a{}, inverse_mass_b{};  ///< [1/kg]; 0 for immovable bodies
    /// World axes: xx yy zz xy xz yz [1/(kg m2)].
    std::array<LaneValues, 6> inverse_inertia_a{}, inverse_inertia_b{};
};

/// inverse_mass_excess of a block's bodies, where they have added mass [1/kg].
struct PairExcess {
    std::array<LaneValues, 6> a{}, b{};  ///< xx yy zz xy xz yz
};

/// Velocity [m/s] and angular velocity [rad/s] of a body, world axes: v x y z, w x y z; two are not
/// used.
struct alignas(64) BodyMotion {
    double v[8];
};

/// The contacts that take part in a stage and can move something, in blocks.
///
/// Pairs are coloured greedily in their order: each gets the first colour that none of its free
/// bodies has yet, and the blocks of a colour hold pairs of about as many contacts. So the order of
/// the sweeps depends on which bodies touch at how many points, and on nothing else.
///
/// A free ship would couple all its contacts. Instead each of its n pairs has a copy of it,
/// n times as light (mass splitting: Tonge, Benevolenski, Voroshilov, ACM TOG 31(4), 2012), and
/// after a sweep join_ship() makes one of them again. In a sweep every copy has one inverse mass
/// for all directions, n times the ship's largest. At the fixed point no copy changes, so the
/// solution is the ship's own.
class ContactRows {
public:
    /// Measures their responses, with the bodies' present poses.
    /// @pre constraints ordered by (a, b), as ContactFinder gives them
    /// @param which  constraints that take part, ascending; ones that can move nothing are passed
    ///               over
    void build(const Bodies& bodies, const std::vector<Constraint>& constraints,
               const std::vector<std::int32_t>& which);

    /// Right-hand side and bound of a contact in a stage.
    struct Target {
        double target_velocity;  ///< least v_r . n [m/s]
        double max_impulse;      ///< largest normal impulse [N s]; negative counts as 0
    };

    /// Takes velocities from the bodies, impulses and targets from the constraints.
    /// @param normal, tangent  members of Constraint with the impulses of this stage
    /// @param target_of        Constraint -> Target
    /// @pre build(), with the same constraints
    template <class TargetOf>
    void begin_stage(const Bodies& bodies, const std::vector<Constraint>& constraints,
                     double Constraint::*normal, Vec3 Constraint::*tangent,
                     const TargetOf& target_of) {
        ICE_ASSERT(which_.empty() || which_.back() < std::ssize(constraints));
        load_motions(bodies);
        for (std::size_t n = 0; n < which_.size(); ++n) {
            const Constraint& c = constraints[which_[n]];
            if (slot_[n] >= 0)
                set(static_cast<std::size_t>(slot_[n]), c.*normal, c.*tangent, target_of(c));
        }
    }

    /// Gives impulses [N s] to the constraints, and their change since begin_stage to the bodies.
    /// Rows without an impulse before and after change nothing.
    void end_stage(Bodies& bodies, std::vector<Constraint>& constraints, double Constraint::*normal,
                   Vec3 Constraint::*tangent) const;

    /// Notes the ship's motion before a sweep. Nothing to do for a prescribed course.
    void part_ship();
    /// Adds the changes of the ship's copies in a sweep to the ship, in the order of the pairs, and
    /// gives all copies its motion.
    void join_ship();

    /// Bodies that take part, by local number; a free ship once for each of its pairs.
    const std::vector<std::int32_t>& bodies() const { return bodies_; }
    /// Local number of a body; -1 for bodies that do not take part.
    std::int32_t local_of(std::int32_t body) const {
        return local_[static_cast<std::size_t>(body)];
    }

    std::vector<PairBlock> blocks;   ///< by colour; empty where nothing can move
    std::vector<ContactRow> rows;    ///< by block
    std::vector<PairExcess> excess;  ///< by block; empty where no body has added mass
    std::vector<BodyMotion> motion;  ///< by local number, of the bodies that take part

private:
    struct Pair {
        std::int32_t a, b, first, count, colour;  // local bodies, rows of which_
    };
    void find_pairs(const Bodies& bodies, const std::vector<Constraint>& constraints);
    void colour_pairs(const Bodies& bodies);
    void sort_pairs();
    void fill_block(const Bodies& bodies, const std::vector<Constraint>& constraints,
                    std::size_t first_pair, std::size_t last_pair);
    std::int32_t local(std::int32_t body);
    std::int32_t copy_of_ship();
    void set_copies(const Bodies& bodies);
    void load_motions(const Bodies& bodies);
    void set(std::size_t slot, double normal, const Vec3& tangent, const Target& target);

    std::vector<Pair> pairs_, sorted_;
    std::vector<std::size_t> places_;          // of sort_pairs
    std::vector<std::int32_t> which_;          // constraints that take part
    std::vector<std::int32_t> bodies_;         // by local number
    std::vector<std::int32_t> local_;          // by body; -1 for bodies that take no part
    std::vector<std::uint64_t> used_colours_;  // by local number
    std::vector<std::int32_t> slot_;           // by row of which_: kLanes row + lane, or -1

    std::vector<std::int32_t> copies_;  // of a free ship, local numbers; else none
    double copy_inverse_mass_ = 0.0;    // [1/kg]
    Mat3 copy_inverse_inertia_ = Mat3::Zero();
    Mat3 inverse_mass_ = Mat3::Zero();  // of the ship
    BodyMotion parted_{};               // its motion before the sweep
};

}  // namespace ice
