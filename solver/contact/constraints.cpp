// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/contact/constraints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "common/base/assert.hpp"
#include "common/base/parallel.hpp"
#include "common/formats/checkpoint_file.hpp"
#include "solver/contact/constraint_order.hpp"

namespace ice {

namespace {

// [r] m [r] with the matrix [r] of the product r x, without the products with its zeros.
Mat3 crossed_twice(const Vec3& r, const Mat3& m) {
    Mat3 once, twice;
    for (int k = 0; k < 3; ++k) once.col(k) = r.cross(m.col(k));
    for (int k = 0; k < 3; ++k) twice.row(k) = Vec3(once.row(k)).cross(r);
    return twice;
}

// A ship moves in a few directions only: one in which an impulse turns or shifts it by less than
// this share [-] of its largest response is one in which it cannot move, and the ice is crushed.
// Larger takes slow motions for none; smaller takes rounding for a motion, with huge impulses.
constexpr double kLeastResponse = 1e-9;

// Contacts below which waking threads costs more than they save [-]. It changes the time alone.
constexpr std::size_t kSerialContacts = 1024;

bool ship_can_move(const ShipResponse& ship, const Vec3& arm, const Vec3& normal) {
    const double most =
        largest_response(ship) + arm.squaredNorm() * ship.inverse_inertia.cwiseAbs().maxCoeff();
    return ship_response(ship, arm, normal) > kLeastResponse * most;
}

// Largest normal impulse [N s], (13): crushing pressure on the section. Of spheres it is that cut
// half way through the step: at the start of the step, the bound would lag behind by half a step.
double max_impulse(const Contact& contact, double approach, const ContactLaw& law, double dt) {
    // the section of solids is that at the step's beginning
    const bool solids = contact.is_of_solids();
    if (law.is_rigid() || (solids && std::isinf(contact.section)))
        return std::numeric_limits<double>::infinity();
    if (solids) return law.crushing_pressure * contact.section * dt;
    // half a step of closing speed: the section of (13) at mid-step; opening does not reduce it
    const double depth = contact.patch.depth - 0.5 * dt * std::min(approach, 0.0);
    return law.crushing_pressure * cut_area(contact.patch, depth) * dt;
}

}  // namespace

void apply_impulse(Bodies& bodies, const Constraint& c, const Vec3& j) {
    // (5): the impulse acts on b, its opposite on a, both at the contact's point
    bodies.velocity[c.a] -= bodies.response(static_cast<std::size_t>(c.a), j);
    bodies.velocity[c.b] += bodies.response(static_cast<std::size_t>(c.b), j);
    bodies.angular_velocity[c.a] -= bodies.inverse_inertia_world[c.a] * c.arm_a.cross(j);
    bodies.angular_velocity[c.b] += bodies.inverse_inertia_world[c.b] * c.arm_b.cross(j);
    if (c.a == static_cast<std::int32_t>(kShip) && bodies.ship.free) push_ship(bodies, c, j);
}

void push_ship(Bodies& bodies, const Constraint& c, const Vec3& j) {
    ICE_ASSERT(c.a == static_cast<std::int32_t>(kShip) && bodies.ship.free);
    bodies.velocity[kShip] -= bodies.ship.inverse_mass * j;
    bodies.angular_velocity[kShip] -= bodies.ship.inverse_inertia * c.arm_a.cross(j);
}

double ship_response(const ShipResponse& ship, const Vec3& arm, const Vec3& direction) {
    // k(d) of section 13, d . (M + A)^-1 d + (r x d) . (I + A')^-1 (r x d)
    const Vec3 turn = arm.cross(direction);
    return direction.dot(ship.inverse_mass * direction) + turn.dot(ship.inverse_inertia * turn);
}

void build_constraints(const Bodies& bodies, const std::vector<Contact>& contacts,
                       const ContactLaw& law, double dt, std::vector<Constraint>& out) {
    out.resize(contacts.size());
    parallel_for(contacts.size(), kSerialContacts, [&](std::size_t k) {
        const Contact& contact = contacts[k];
        Constraint c;
        c.a = contact.a;
        c.b = contact.b;
        c.normal = contact.normal;
        c.arm_a = bodies.arm(c.a, contact.point);
        c.arm_b = contact.point - bodies.position[c.b];
        // between two immovable bodies no impulse changes anything
        c.can_move = bodies.inverse_mass[c.a] + bodies.inverse_mass[c.b] > 0.0 ||
                     (c.a == static_cast<std::int32_t>(kShip) && bodies.ship.free &&
                      ship_can_move(bodies.ship, c.arm_a, c.normal));
        c.on_unbent = c.a == static_cast<std::int32_t>(kShip) &&
                      bodies.is_unbent(static_cast<std::size_t>(c.b));
        c.friction =
            c.a == static_cast<std::int32_t>(kShip) ? law.friction_ship_ice : law.friction_ice_ice;
        c.gap = contact.gap;
        // before any impulse of this step: restitution and crushing are measured by it
        c.approach = relative_velocity(bodies, c).dot(c.normal);
        c.max_impulse = max_impulse(contact, c.approach, law, dt);
        c.rebounds = true;
        out[k] = c;
    });
}

double largest_response(const ShipResponse& ship) {
    return ship.inverse_mass.cwiseAbs().rowwise().sum().maxCoeff();
}

Mat3 response_matrix(double inverse_mass, const Mat3& inverse_inertia_a, const Vec3& arm_a,
                     const Mat3& inverse_inertia_b, const Vec3& arm_b) {
    // (5) as a matrix: (I^-1 (r x j)) x r is -[r] I^-1 [r] j with the matrix [r] of r x
    return inverse_mass * Mat3::Identity() - crossed_twice(arm_a, inverse_inertia_a) -
           crossed_twice(arm_b, inverse_inertia_b);
}

bool WarmStart::less(const Entry& l, const Entry& r) {
    return std::tie(l.a, l.b, l.key) < std::tie(r.a, r.b, r.key);
}

// Is it of an earlier pair?
bool WarmStart::precedes(const Entry& e, const Contact& c) {
    return std::tie(e.a, e.b) < std::tie(c.a, c.b);
}

void WarmStart::recall(const std::vector<Contact>& contacts,
                       std::vector<Constraint>& constraints) const {
    ICE_ASSERT(constraints.size() == contacts.size() && are_ordered(constraints));
    // Entries and contacts are both sorted by pair: one walk, and a search by key within the
    // pair.
    auto first = entries_.begin(), last = entries_.begin();  // of the contact's pair
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        const Contact& contact = contacts[k];
        while (first != entries_.end() && precedes(*first, contact)) last = ++first;
        while (last != entries_.end() && last->a == contact.a && last->b == contact.b) ++last;
        const auto found =
            std::lower_bound(first, last, contact.key,
                             [](const Entry& e, std::uint64_t key) { return e.key < key; });
        if (found == last || found->key != contact.key) continue;
        Constraint& c = constraints[k];
        if (!c.can_move) continue;
        // The rest stage may use the part of the bound (13) that the impact left. With the plane
        // and the cone of the present normal the first guess satisfies bounds and friction law.
        c.rest_normal = std::min(found->normal, std::max(c.max_impulse - c.impact_normal, 0.0));
        if (c.rest_normal <= 0.0) continue;
        c.rest_tangent = found->tangent - found->tangent.dot(c.normal) * c.normal;
        const double most = c.friction * c.rest_normal, size = c.rest_tangent.norm();
        if (size > most) c.rest_tangent *= most / size;
    }
}

void WarmStart::remember(const std::vector<Contact>& contacts,
                         const std::vector<Constraint>& constraints,
                         const std::vector<std::int32_t>& which) {
    ICE_ASSERT(constraints.size() == contacts.size() && are_ordered(constraints));
    entries_.clear();
    std::size_t first = 0;  // of the pair's entries
    for (const std::int32_t k : which) {
        // contacts without an impulse are not worth an entry: zero is the guess without one
        if (constraints[k].rest_normal <= 0.0) continue;
        if (entries_.size() > first && precedes(entries_[first], contacts[k])) {
            std::sort(entries_.begin() + static_cast<std::ptrdiff_t>(first), entries_.end(), less);
            first = entries_.size();
        }
        entries_.push_back({contacts[k].a, contacts[k].b, contacts[k].key,
                            constraints[k].rest_normal, constraints[k].rest_tangent});
    }
    std::sort(entries_.begin() + static_cast<std::ptrdiff_t>(first), entries_.end(), less);
}

void WarmStart::carry(CheckpointFile& file) {
    file.column("warm_start.a", entries_, &Entry::a);
    file.column("warm_start.b", entries_, &Entry::b);
    file.column("warm_start.key", entries_, &Entry::key);
    file.column("warm_start.normal", entries_, &Entry::normal);
    file.column("warm_start.tangent", entries_, &Entry::tangent);
}

}  // namespace ice
