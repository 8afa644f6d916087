// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/contact/recess.hpp"

#include <algorithm>
#include <tuple>

#include "common/base/assert.hpp"
#include "common/formats/checkpoint_file.hpp"
#include "solver/contact/overlaps.hpp"

namespace ice {

namespace {

// Spheres whose centres are this near [patch radii] are neighbours: one and a half spacings.
constexpr double kNeighbours = 2.0;

// By how much a contact may have become deeper within the last step [m]: bodies came to their poses
// with the velocities that they have.
double most_closed(const Scene& scene, const Constraint& c, double dt) {
    const auto radius = [&](std::int32_t body) {
        return scene.shapes[static_cast<std::size_t>(scene.bodies.shape[body])].largest_radius;
    };
    return dt * std::max(0.0, -c.approach) + kToleratedOverlap * std::min(radius(c.a), radius(c.b));
}

// How much deeper than a sphere its neighbours have been crushed, at most [m].
double depth_beside(const Scene& scene, std::int32_t body, std::int32_t sphere,
                    const Vec3& inwards) {
    const Shape& shape = scene.shapes[static_cast<std::size_t>(scene.bodies.shape[body])];
    const double reach = kNeighbours * shape.patch_radius;
    double deepest = 0.0;
    for (std::size_t k = 0; k < shape.center.size(); ++k) {
        if ((shape.center[k] - shape.center[sphere]).squaredNorm() > reach * reach) continue;
        const auto of = static_cast<std::int32_t>(k);
        deepest = std::max(deepest, scene.crushed.displacement_of(body, of).dot(inwards));
    }
    return deepest - scene.crushed.displacement_of(body, sphere).dot(inwards);
}

}  // namespace

double Recess::last_depth(const Contact& c, std::size_t& at) const {
    while (at < entries_.size() && std::tie(entries_[at].a, entries_[at].b) < std::tie(c.a, c.b))
        ++at;
    const bool known = at < entries_.size() && entries_[at].a == c.a && entries_[at].b == c.b;
    return known ? entries_[at].depth : 0.0;
}

void Recess::remember(const std::vector<Contact>& contacts) {
    entries_.clear();
    for (const Contact& c : contacts) {
        if (entries_.empty() || entries_.back().a != c.a || entries_.back().b != c.b)
            entries_.push_back({c.a, c.b, 0.0});
        entries_.back().depth = std::max(entries_.back().depth, -c.gap);
    }
}

void Recess::move_spheres(Scene& scene, const ContactLaw& law, double dt,
                          std::vector<Contact>& contacts, std::vector<Constraint>& constraints) {
    ICE_ASSERT(constraints.size() == contacts.size());
    scene.crushed.recent.clear();
    if (law.is_rigid()) return;
    std::size_t at = 0;
    for (std::size_t k = 0; k < contacts.size() && started_ != 0; ++k) {
        Contact& c = contacts[k];
        const std::int32_t body = c.crushes_a ? c.a : c.b;
        const double deeper = -c.gap - last_depth(c, at);
        if (deeper <= 0.0 || scene.crushed.is_whole(body)) continue;
        const double jump = deeper - most_closed(scene, constraints[k], dt);
        if (jump <= 0.0) continue;
        const std::int32_t sphere = c.crushes_a ? c.sphere_a : c.sphere_b;
        const Vec3 inwards =
            scene.bodies.rotation[body].transpose() * (c.crushes_a ? Vec3(-c.normal) : c.normal);
        const double way = std::min(jump, depth_beside(scene, body, sphere, inwards));
        if (way <= 0.0) continue;
        const Shape& shape = scene.shapes[static_cast<std::size_t>(scene.bodies.shape[body])];
        scene.crushed.crush(body, sphere, shape.center.size(), way * inwards);
        c.gap += way;
        constraints[k].gap += way;
    }
    remember(contacts);
    started_ = 1;
}

void Recess::carry(CheckpointFile& file) {
    file.column("recess.a", entries_, &Entry::a);
    file.column("recess.b", entries_, &Entry::b);
    file.column("recess.depth", entries_, &Entry::depth);
    file.carry("recess.started", started_);
}

}  // namespace ice
