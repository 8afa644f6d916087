// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/hull_contacts.hpp"

namespace ice {

void HullContacts::add(const std::vector<Contact>& contacts,
                       const std::vector<Constraint>& constraints) {
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const Constraint& c = constraints[k];
        const double normal = c.total_normal();
        if (c.a != static_cast<std::int32_t>(kShip) || normal <= 0.0) continue;
        // impulses act on the floe; the ship feels the opposite. The ship does not turn: its
        // frame has the world's axes
        Sum& sum = sums_[{c.b, contacts[k].sphere_a}];
        sum.weight += normal;
        sum.point += normal * c.arm_a;
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
