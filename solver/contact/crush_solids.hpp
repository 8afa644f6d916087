// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/case/contact_law.hpp"
#include "solver/contact/constraints.hpp"

namespace ice {

/// Ice of convex floes that is crushed by other convex floes: a contact at its bound cuts the
/// solid that is crushed there by the other floe's face, where the step leaves it (method, section
/// 5). The corners of a pair's polygon make one cut, that which takes off the least.
/// @param dt  time step [s]
/// @pre called before the poses advance, after resolve_rest, with the constraints' law and dt
class CrushSolids {
public:
    void cut(Scene& scene, const std::vector<Contact>& contacts,
             const std::vector<Constraint>& constraints, const ContactLaw& law, double dt);

private:
    struct Cut {
        std::int32_t body, other;
        Vec3 outward;   // unit, body axes
        Vec3 point;     // on the plane, body axes [m]
        double offset;  // outward . point [m]
    };
    void add(const Cut& cut);

    std::vector<Cut> cuts_;  ///< in the order of the contacts
};

}  // namespace ice
