// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/contact/impact_energy_limiter.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/assert.hpp"

namespace ice {

namespace {

// Largest s in [0, 1] where a convex parabola through its values at 0, 1/2 and 1 is at most 0.
double largest_share(double at_zero, double at_half, double at_one) {
    if (at_one <= 0.0) return 1.0;
    // The energy of a mixture is quadratic in its share s, (8): three values determine the
    // parabola.
    const double curve = 2.0 * (at_zero - 2.0 * at_half + at_one);
    const double slope = at_one - at_zero - curve;
    if (at_zero > 0.0) return 0.0;
    if (curve <= 0.0) return std::clamp(-at_zero / (at_one - at_zero), 0.0, 1.0);
    const double root = std::sqrt(std::max(slope * slope - 4.0 * curve * at_zero, 0.0));
    return std::clamp((-slope + root) / (2.0 * curve), 0.0, 1.0);
}

template <class T>
void mix(const std::vector<T>& a, const std::vector<T>& b, std::vector<T>& out) {
    out.resize(a.size());
    for (std::size_t k = 0; k < a.size(); ++k) out[k] = 0.5 * (a[k] + b[k]);
}

}  // namespace

void ImpactEnergyLimiter::save(const Bodies& bodies, const ContactRows& contacts,
                               const std::vector<Constraint>& constraints, State& out) const {
    out.velocity.clear();
    out.angular_velocity.clear();
    out.normal.clear();
    out.tangent.clear();
    for (const std::int32_t body : contacts.bodies()) {
        out.velocity.push_back(bodies.velocity[body]);
        out.angular_velocity.push_back(bodies.angular_velocity[body]);
    }
    for (const std::int32_t k : which_) {
        out.normal.push_back(constraints[k].impact_normal);
        out.tangent.push_back(constraints[k].impact_tangent);
    }
}

// Free bodies connected by contacts share the smallest of their numbers.
void ImpactEnergyLimiter::find_islands(const Bodies& bodies, const ContactRows& contacts,
                                       const std::vector<Constraint>& constraints) {
    islands_.resize(contacts.bodies().size());
    // Union-find: each body points to one of its island, the root to itself.
    std::iota(islands_.begin(), islands_.end(), 0);
    const auto root = [&](std::int32_t i) {
        while (islands_[i] != i) i = islands_[i] = islands_[islands_[i]];
        return i;
    };
    for (const std::int32_t k : which_) {
        const Constraint& c = constraints[k];
        // Ship and held ice do not connect islands: each island may gain or lose energy by itself.
        if (bodies.inverse_mass[c.a] == 0.0 || bodies.inverse_mass[c.b] == 0.0) continue;
        const std::int32_t a = root(contacts.local_of(c.a)), b = root(contacts.local_of(c.b));
        islands_[std::max(a, b)] = std::min(a, b);
    }
    for (std::size_t i = 0; i < islands_.size(); ++i)
        islands_[i] = root(static_cast<std::int32_t>(i));
}

std::int32_t ImpactEnergyLimiter::island_of(const Bodies& bodies, const ContactRows& contacts,
                                            const Constraint& c) const {
    return islands_[contacts.local_of(bodies.inverse_mass[c.a] > 0.0 ? c.a : c.b)];
}

void ImpactEnergyLimiter::measure_gains(const Bodies& bodies, const ContactRows& contacts,
                                        const std::vector<Constraint>& constraints,
                                        const State& end, std::vector<double>& out) const {
    // A contact's work is entered for the island of its free body, so islands may be limited
    // apart.
    out.assign(contacts.bodies().size(), 0.0);
    for (std::size_t n = 0; n < which_.size(); ++n) {
        const Constraint& c = constraints[which_[n]];
        if (!c.can_move) continue;
        const std::int32_t a = contacts.local_of(c.a), b = contacts.local_of(c.b);
        const auto relative = [&](const State& s) -> Vec3 {
            return s.velocity[b] + s.angular_velocity[b].cross(c.arm_b) - s.velocity[a] -
                   s.angular_velocity[a].cross(c.arm_a);
        };
        // Work of the impulse on the mean of the relative velocities before and after: the exact
        // change of kinetic energy, because velocities are linear in impulses.
        const Vec3 j = end.normal[n] * c.normal + end.tangent[n];
        out[island_of(bodies, contacts, c)] += 0.5 * j.dot(relative(start_) + relative(end));
    }
}

void ImpactEnergyLimiter::begin(const Bodies& bodies, const ContactRows& contacts,
                                const std::vector<Constraint>& constraints,
                                const std::vector<std::int32_t>& which) {
    ICE_ASSERT(which.empty() || which.back() < std::ssize(constraints));
    which_ = which;
    save(bodies, contacts, constraints, start_);
}

double ImpactEnergyLimiter::energy_gain(const Bodies& bodies, const ContactRows& contacts,
                                        const std::vector<Constraint>& constraints) {
    save(bodies, contacts, constraints, now_);
    find_islands(bodies, contacts, constraints);
    measure_gains(bodies, contacts, constraints, now_, gains_);
    return gains_.empty() ? 0.0 : *std::max_element(gains_.begin(), gains_.end());
}

void ImpactEnergyLimiter::set_aside(Bodies& bodies, const ContactRows& contacts,
                                    std::vector<Constraint>& constraints) {
    // The plastic solution starts from the same state as the rebound did: the two differ in the
    // targets alone.
    save(bodies, contacts, constraints, rebound_);
    for (std::size_t k = 0; k < contacts.bodies().size(); ++k) {
        const std::int32_t body = contacts.bodies()[k];
        bodies.velocity[body] = start_.velocity[k];
        bodies.angular_velocity[body] = start_.angular_velocity[k];
    }
    for (std::size_t n = 0; n < which_.size(); ++n) {
        constraints[which_[n]].impact_normal = start_.normal[n];
        constraints[which_[n]].impact_tangent = start_.tangent[n];
    }
}

void ImpactEnergyLimiter::limit_rebound(Bodies& bodies, const ContactRows& contacts,
                                        std::vector<Constraint>& constraints) {
    ICE_ASSERT(rebound_.velocity.size() == contacts.bodies().size());
    // The gain of a mixture is a parabola in s, because velocities and impulses are linear in
    // it: it is measured at the plastic solution, half way, and at the rebound.
    save(bodies, contacts, constraints, plastic_);
    mix(plastic_.velocity, rebound_.velocity, now_.velocity);
    mix(plastic_.angular_velocity, rebound_.angular_velocity, now_.angular_velocity);
    mix(plastic_.normal, rebound_.normal, now_.normal);
    mix(plastic_.tangent, rebound_.tangent, now_.tangent);
    find_islands(bodies, contacts, constraints);
    measure_gains(bodies, contacts, constraints, plastic_, at_zero_);
    measure_gains(bodies, contacts, constraints, now_, at_half_);
    measure_gains(bodies, contacts, constraints, rebound_, at_one_);
    const auto share = [&](std::int32_t island) {
        return largest_share(at_zero_[island], at_half_[island], at_one_[island]);
    };
    const auto between = [](const auto& plastic, auto& rebound, double s) {
        // the whole rebound to the last bit, not the sum of its parts
        if (s != 1.0) rebound = plastic + s * (rebound - plastic);
    };
    for (std::size_t k = 0; k < contacts.bodies().size(); ++k) {
        const std::int32_t body = contacts.bodies()[k];
        const double s = share(islands_[k]);
        between(plastic_.velocity[k], rebound_.velocity[k], s);
        between(plastic_.angular_velocity[k], rebound_.angular_velocity[k], s);
        bodies.velocity[body] = rebound_.velocity[k];
        bodies.angular_velocity[body] = rebound_.angular_velocity[k];
    }
    // impulses with the same share as the velocities that they made: momentum stays balanced
    for (std::size_t n = 0; n < which_.size(); ++n) {
        Constraint& c = constraints[which_[n]];
        const double s = c.can_move ? share(island_of(bodies, contacts, c)) : 1.0;
        between(plastic_.normal[n], rebound_.normal[n], s);
        between(plastic_.tangent[n], rebound_.tangent[n], s);
        c.impact_normal = rebound_.normal[n];
        c.impact_tangent = rebound_.tangent[n];
    }
    if (bodies.ship.free) mix_ship(bodies, contacts, constraints);
}

// The ship belongs to no island: the impulses of all islands act on it.
void ImpactEnergyLimiter::mix_ship(Bodies& bodies, const ContactRows& contacts,
                                   const std::vector<Constraint>& constraints) const {
    if (contacts.local_of(static_cast<std::int32_t>(kShip)) < 0) return;
    const auto local = static_cast<std::size_t>(contacts.local_of(kShip));
    bodies.velocity[kShip] = start_.velocity[local];
    bodies.angular_velocity[kShip] = start_.angular_velocity[local];
    for (std::size_t n = 0; n < which_.size(); ++n) {
        const Constraint& c = constraints[which_[n]];
        if (c.a != static_cast<std::int32_t>(kShip)) continue;
        push_ship(bodies, c,
                  (c.impact_normal - start_.normal[n]) * c.normal +
                      (c.impact_tangent - start_.tangent[n]));
    }
}

}  // namespace ice
