// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/hull_contacts.hpp"

namespace ice {

void HullContacts::add(const Bodies& bodies, const std::vector<Contact>& contacts,
                       const std::vector<Constraint>& constraints) {
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const Constraint& c = constraints[k];
        const double normal = c.total_normal();
        if (c.a != static_cast<std::int32_t>(kShip) || normal <= 0.0) continue;
        // one entry for a floe and a hull sphere over the frame; its point is weighted by the
        // impulses
        Sum& sum = sums_[{c.b, contacts[k].sphere_a}];
        sum.weight += normal;
        // a ship that does not turn has the world's axes
        sum.point += normal * (bodies.ship.free ? Vec3(bodies.rotation[kShip].transpose() *
                                                       (c.arm_a + bodies.ship.centre))
                                                : c.arm_a);
        // impulses act on the floe; the ship feels the opposite
        sum.push -= normal * c.normal;
        sum.rub -= c.total_tangent();
    }
}

std::vector<HullContact> HullContacts::take(double span) {
    std::vector<HullContact> out;
    if (span > 0.0)
        for (const auto& [key, sum] : sums_)
            out.push_back(
                {key.first, key.second, sum.point / sum.weight, sum.push / span, sum.rub / span});
    sums_.clear();
    return out;
}

}  // namespace ice
