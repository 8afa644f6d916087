// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/contact/crush_solids.hpp"

#include <algorithm>

#include "common/base/assert.hpp"
#include "solver/contact/overlaps.hpp"

namespace ice {

void CrushSolids::add(const Cut& cut) {
    // the corners of one polygon follow each other
    if (!cuts_.empty() && cuts_.back().body == cut.body && cuts_.back().other == cut.other) {
        if (cut.offset > cuts_.back().offset) cuts_.back() = cut;
        return;
    }
    cuts_.push_back(cut);
}

void CrushSolids::list_uncut(const std::vector<Constraint>& constraints, const Cut& cut) {
    const auto [a, b] = std::minmax(cut.body, cut.other);
    for (std::size_t k = 0; k < constraints.size(); ++k)
        if (constraints[k].a == a && constraints[k].b == b) uncut_.push_back(k);
}

void CrushSolids::cut(Scene& scene, const std::vector<Contact>& contacts,
                      const std::vector<Constraint>& constraints, const ContactLaw& law,
                      double dt) {
    ICE_ASSERT(constraints.size() == contacts.size());
    cuts_.clear();
    uncut_.clear();
    if (law.is_rigid()) return;
    const Bodies& bodies = scene.bodies;
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const Constraint& c = constraints[k];
        const Contact& contact = contacts[k];
        if (!contact.is_of_solids() || !c.is_at_bound()) continue;
        // The gap at the end of the step. Overlap that position correction tolerates need not be
        // cut off, and a solid keeps its planes for some steps.
        const double gap = c.gap + dt * relative_velocity(bodies, c).dot(c.normal);
        if (gap >= -kToleratedOverlap * smaller_radius(scene, c)) continue;
        // From the middle between the surfaces to the other body's, which moves against the ice
        // that stays, by gap - c.gap along the normal as the crushed body sees it.
        const double to_face = 0.5 * c.gap - (c.gap - gap);
        const bool of_a = contact.crushes_a;
        const std::int32_t body = of_a ? c.a : c.b;
        const Vec3 outward = of_a ? c.normal : Vec3(-c.normal);
        const Mat3 to_body = bodies.rotation[body].transpose();
        const Vec3 point = to_body * (contact.point + to_face * outward - bodies.position[body]);
        const Vec3 normal = to_body * outward;
        add({body, of_a ? c.b : c.a, normal, point, normal.dot(point)});
    }
    for (const Cut& cut : cuts_)
        if (!scene.crushed_solids.cut(cut.body, scene.shape_of(cut.body).convex, cut.outward,
                                      cut.point))
            list_uncut(constraints, cut);
    std::sort(uncut_.begin(), uncut_.end());
}

}  // namespace ice
