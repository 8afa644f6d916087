// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/case/contact_law.hpp"
#include "solver/contact/constraints.hpp"

namespace ice {

/// Convex floes crush each other. A contact at its bound cuts the more slender solid by the other
/// floe's face, where the step leaves this face (method, section 5). The corners of a pair's
/// polygon make one cut, that which takes off the least.
class CrushSolids {
public:
    /// @param dt  time step [s]
    /// @pre called before the poses advance, after resolve_rest, with the constraints' law and dt
    void cut(Scene& scene, const std::vector<Contact>& contacts,
             const std::vector<Constraint>& constraints, const ContactLaw& law, double dt);

    /// The constraints of pairs whose ice could not be cut (crush_solid), ascending: position
    /// correction opens their overlap, at their bound or not.
    const std::vector<std::size_t>& uncut() const { return uncut_; }

private:
    struct Cut {
        std::int32_t body, other;
        Vec3 outward;   // unit, body axes
        Vec3 point;     // on the plane, body axes [m]
        double offset;  // outward . point [m]
    };
    void add(const Cut& cut);
    // The constraints of the pair.
    void list_uncut(const std::vector<Constraint>& constraints, const Cut& cut);

    std::vector<Cut> cuts_;  ///< in the order of the contacts
    std::vector<std::size_t> uncut_;
};

}  // namespace ice
