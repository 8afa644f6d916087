// SPDX-License-Identifier: GPL-3.0-or-later
/// Contacts as the solver sees them: lever arms, bounds and impulses (docs/method.md, section 4).
/// Their effective masses are in ContactRow.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "solver/case/contact_law.hpp"
#include "solver/narrow/manifold/contact.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

class CheckpointFile;

/// One contact in the solver, vectors in world axes; impulses act on b, their opposites on a. In 2D
/// impulses are per metre of breadth [N s/m].
struct Constraint {
    std::int32_t a, b;
    bool can_move;               ///< does an impulse along the normal move either body?
    bool on_unbent;              ///< the ship presses on ice held until it bends
    bool rebounds;               ///< false once the contact has crushed in this step's impacts
    double gap;                  ///< at the start of the step [m]
    Vec3 normal;                 ///< from a to b
    Vec3 arm_a, arm_b;           ///< r = p - x [m]
    double approach;             ///< v_r . n at the start of the step [m/s], < 0 approaching
    double max_impulse;          ///< largest normal impulse per step: p A dt [N s]
    double friction;             ///< Coulomb's coefficient [-]
    double impact_normal = 0.0;  ///< normal impulse of the impact stage [N s]
    Vec3 impact_tangent = Vec3::Zero();  ///< its friction, across the normal [N s]
    double rest_normal = 0.0;            ///< normal impulse of the rest stage [N s]
    Vec3 rest_tangent = Vec3::Zero();    ///< its friction, across the normal [N s]

    /// Normal impulse of both stages [N s].
    double total_normal() const { return impact_normal + rest_normal; }
    /// Friction of both stages, across the normal [N s].
    Vec3 total_tangent() const { return impact_tangent + rest_tangent; }
    /// Is the ice crushed here? Never where max_impulse is infinite. The share of 1e-9 is rounding
    /// of the sum of two impulses.
    bool is_at_bound() const { return total_normal() >= max_impulse * (1.0 - 1e-9); }
};

/// Prepares contacts with the bodies' present pose and velocity, v_r = (v_b + w_b x r_b) -
/// (v_a + w_a x r_a), equation (4). One constraint per contact, same order; all impulses are zero.
/// @param dt   time step [s]
/// @param out  its old content is dropped
void build_constraints(const Bodies& bodies, const std::vector<Contact>& contacts,
                       const ContactLaw& law, double dt, std::vector<Constraint>& out);

/// K with K j = change of v_r by an impulse j at points r_a and r_b from two bodies' centres:
///
///     K j = (1/m_a + 1/m_b) j + (I_a^-1 (r_a x j)) x r_a + (I_b^-1 (r_b x j)) x r_b
///
/// (equation (5)) and k(d) = d . K d [1/kg] for a unit vector d. Without added mass: callers add
/// inverse_mass_excess. Zero for immovable bodies.
/// @param inverse_mass  1/m_a + 1/m_b [1/kg]
/// @param arm_a, arm_b  r_a and r_b, world axes [m]
/// @param inverse_inertia_a, inverse_inertia_b  I^-1, world axes [1/(kg m2)]
Mat3 response_matrix(double inverse_mass, const Mat3& inverse_inertia_a, const Vec3& arm_a,
                     const Mat3& inverse_inertia_b, const Vec3& arm_b);

/// v_r at a constraint from the bodies' present velocities [m/s].
inline Vec3 relative_velocity(const Bodies& bodies, const Constraint& c) {
    return bodies.velocity[c.b] + bodies.angular_velocity[c.b].cross(c.arm_b) -
           bodies.velocity[c.a] - bodies.angular_velocity[c.a].cross(c.arm_a);
}

/// Gives impulse j [N s] to b and -j to a: velocities and angular velocities change.
void apply_impulse(Bodies& bodies, const Constraint& c, const Vec3& j);

/// The ship's part of it, for a free ship: -j [N s] at its arm. @pre c.a is the ship
void push_ship(Bodies& bodies, const Constraint& c, const Vec3& j);

/// d . K d of the ship alone for a unit vector d: its k(d) at a point [1/kg]; 0 for a ship on a
/// prescribed course. @param arm  from its centre of gravity to the point [m]
double ship_response(const ShipResponse& ship, const Vec3& arm, const Vec3& direction);

/// An upper bound of d . inverse_mass d over all unit vectors d [1/kg]: the largest sum of a row's
/// amounts. 0 for a ship on a prescribed course.
double largest_response(const ShipResponse& ship);

/// Resting impulses of the last step, found again by (a, b, key): the solver's first guess.
class WarmStart {
public:
    /// Sets rest_normal and rest_tangent of the contacts known from the last step, where either
    /// body can move. The tangential part is projected on the new tangent plane and the new cone.
    /// @pre contacts ordered by (a, b), as ContactFinder gives them
    void recall(const std::vector<Contact>& contacts, std::vector<Constraint>& constraints) const;
    /// Takes the impulses of the rest stage. @pre as of recall
    /// @param which  constraints that took part in it, ascending
    void remember(const std::vector<Contact>& contacts, const std::vector<Constraint>& constraints,
                  const std::vector<std::int32_t>& which);

    /// Writes or sets its state, by the file's direction.
    void carry(CheckpointFile& file);

private:
    struct Entry {
        std::int32_t a, b;
        std::uint64_t key;
        double normal;  // impulses of the last rest stage [N s]
        Vec3 tangent;
    };
    static bool precedes(const Entry& e, const Contact& c);
    static bool less(const Entry& l, const Entry& r);

    std::vector<Entry> entries_;  ///< sorted by (a, b, key)
};

}  // namespace ice
