// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/residual_impulse.hpp"

#include <algorithm>

namespace ice {

namespace {

// k(n) = 1/m_a + 1/m_b + (r_a x n) . I_a^-1 (r_a x n) + (r_b x n) . I_b^-1 (r_b x n)
double inverse_effective_mass(const Bodies& b, const Constraint& c) {
    const Vec3 ta = c.arm_a.cross(c.normal), tb = c.arm_b.cross(c.normal);
    const bool ship = c.a == static_cast<std::int32_t>(kShip) && b.ship.free;
    const double of_ship = ship ? ship_response(b.ship, c.arm_a, c.normal) : 0.0;
    const double of_water =
        b.have_added_mass()
            ? c.normal.dot((b.inverse_mass_excess[c.a] + b.inverse_mass_excess[c.b]) * c.normal)
            : 0.0;
    return of_water + of_ship + b.inverse_mass[c.a] + b.inverse_mass[c.b] +
           ta.dot(b.inverse_inertia_world[c.a] * ta) + tb.dot(b.inverse_inertia_world[c.b] * tb);
}

}  // namespace

double residual_impulse(const Bodies& bodies, const std::vector<Constraint>& constraints,
                        double dt) {
    // each contact by itself: a joint solution would be the one that did not converge
    double sum = 0.0;
    for (const Constraint& c : constraints) {
        if (!c.can_move) continue;
        const double u = relative_velocity(bodies, c).dot(c.normal) + std::max(c.gap, 0.0) / dt;
        // An impulse is missing where the contact still closes below its bound, and is too much
        // where it pushes bodies apart. Contacts with an impact's impulse may separate: they
        // rebound.
        if (u < 0.0 && !c.is_at_bound())
            sum -= u / inverse_effective_mass(bodies, c);
        else if (u > 0.0 && c.rest_normal > 0.0 && c.impact_normal == 0.0)
            sum += std::min(c.rest_normal, u / inverse_effective_mass(bodies, c));
    }
    return sum;
}

}  // namespace ice
