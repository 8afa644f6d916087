// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/contact/recess.hpp"

#include <algorithm>
#include <tuple>

#include "common/base/assert.hpp"
#include "common/formats/checkpoint_file.hpp"
#include "solver/contact/overlaps.hpp"

namespace ice {

namespace {

// Spheres whose centres are this near [patch radii] are neighbours: one and a half spacings. More
// lets single deep spheres take whole ice far away, and contacts are lost; less finds no crushed
// neighbour of a sphere beside a notch, which is then crushed a second time.
constexpr double kNeighbours = 2.0;

// By how much a contact may have become deeper within the last step [m]: bodies came to their poses
// with the velocities that they have.
double most_closed(const Scene& scene, const Constraint& c, double dt) {
    return dt * std::max(0.0, -c.approach) + kToleratedOverlap * smaller_radius(scene, c);
}

// From the other body into the ice of the contact's sphere, world axes.
Vec3 inwards_of(const Contact& c) { return c.crushes_a ? Vec3(-c.normal) : c.normal; }

// How much deeper than a sphere its neighbours have been crushed, at most [m].
double depth_beside(const Scene& scene, std::int32_t body, std::int32_t sphere,
                    const Vec3& inwards) {
    const Shape& shape = scene.shapes[static_cast<std::size_t>(scene.bodies.shape[body])];
    // in body axes: crushing of neighbours counts along this contact's inward direction only
    const double range = kNeighbours * shape.patch_radius;
    double deepest = 0.0;
    for (std::size_t k = 0; k < shape.center.size(); ++k) {
        if ((shape.center[k] - shape.center[sphere]).squaredNorm() > range * range) continue;
        const auto of = static_cast<std::int32_t>(k);
        deepest = std::max(deepest, scene.crushed.displacement_of(body, of).dot(inwards));
    }
    return deepest - scene.crushed.displacement_of(body, sphere).dot(inwards);
}

}  // namespace

Recess::Place Recess::place_of(const Contact& c) {
    return c.crushes_a ? Place{c.a, c.sphere_a} : Place{c.b, c.sphere_b};
}

double Recess::last_depth(const Contact& c, std::size_t& at) const {
    // entries and contacts are both sorted by pair: the caller's `at` walks along
    while (at < entries_.size() && std::tie(entries_[at].a, entries_[at].b) < std::tie(c.a, c.b))
        ++at;
    const bool known = at < entries_.size() && entries_[at].a == c.a && entries_[at].b == c.b;
    return known ? entries_[at].depth : 0.0;
}

void Recess::forget(const std::vector<std::int32_t>& bodies) {
    ICE_ASSERT(std::is_sorted(bodies.begin(), bodies.end()));
    unknown_ = bodies;
}

bool Recess::has_past(const Contact& c) const {
    return !std::binary_search(unknown_.begin(), unknown_.end(), c.a) &&
           !std::binary_search(unknown_.begin(), unknown_.end(), c.b);
}

void Recess::remember(const std::vector<Contact>& contacts) {
    entries_.clear();
    for (const Contact& c : contacts) {
        if (entries_.empty() || entries_.back().a != c.a || entries_.back().b != c.b)
            entries_.push_back({c.a, c.b, 0.0});
        entries_.back().depth = std::max(entries_.back().depth, -c.gap);
    }
}

void Recess::find_moves(const Scene& scene, double dt, const std::vector<Contact>& contacts,
                        const std::vector<Constraint>& constraints) {
    moves_.clear();
    std::size_t at = 0;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        // (13a): the increase of depth since the last step, less the part that the motion
        // explains, at most down to the deepest neighbour. Whole ice has no recess.
        const Contact& c = contacts[k];
        if (c.is_of_solids()) continue;  // a cut takes a face as a whole: no recess
        const Place place = place_of(c);
        const double deeper = -c.gap - last_depth(c, at);
        if (deeper <= 0.0 || scene.crushed.is_whole(place.body) || !has_past(c)) continue;
        const double jump = deeper - most_closed(scene, constraints[k], dt);
        if (jump <= 0.0) continue;
        const Vec3 inwards = scene.bodies.rotation[place.body].transpose() * inwards_of(c);
        const double depth = std::min(jump, depth_beside(scene, place.body, place.sphere, inwards));
        if (depth > 0.0) moves_.push_back({place, k, depth * inwards});
    }
    // by sphere: several contacts may need the shift of one sphere, which moves once
    std::sort(moves_.begin(), moves_.end(), [](const Move& l, const Move& r) {
        return std::tie(l.place.body, l.place.sphere, l.contact) <
               std::tie(r.place.body, r.place.sphere, r.contact);
    });
    std::size_t kept = 0;
    // A second contact extends the move only where the first is shorter along its direction.
    for (const Move& m : moves_) {
        if (kept > 0 && moves_[kept - 1].place == m.place) {
            add_along(m.shift.norm(), m.shift.normalized(), moves_[kept - 1].shift);
        } else {
            moves_[kept++] = m;
        }
    }
    moves_.resize(kept);
}

void Recess::move_spheres(Scene& scene, const ContactLaw& law, double dt,
                          std::vector<Contact>& contacts, std::vector<Constraint>& constraints) {
    ICE_ASSERT(constraints.size() == contacts.size());
    scene.crushed.recent.clear();
    if (law.is_rigid()) return;
    moves_.clear();
    // the first step has no depths of an earlier step
    if (started_ != 0) find_moves(scene, dt, contacts, constraints);
    for (const Move& m : moves_) {
        const auto shape = static_cast<std::size_t>(scene.bodies.shape[m.place.body]);
        scene.crushed.crush(m.place.body, m.place.sphere, scene.shapes[shape].center.size(),
                            m.shift);
    }
    // The contacts were found before their spheres moved: without this the step would push at an
    // overlap that no longer exists.
    for (std::size_t k = 0; k < contacts.size() && !moves_.empty(); ++k) {
        if (contacts[k].is_of_solids()) continue;
        const Place place = place_of(contacts[k]);
        const auto move =
            std::lower_bound(moves_.begin(), moves_.end(), place,
                             [](const Move& m, const Place& p) { return m.place < p; });
        if (move == moves_.end() || !(move->place == place)) continue;
        const Vec3 shift = scene.bodies.rotation[place.body] * move->shift;
        const double opened = std::max(0.0, shift.dot(inwards_of(contacts[k])));
        contacts[k].gap += opened;
        constraints[k].gap += opened;
    }
    remember(contacts);
    unknown_.clear();
    started_ = 1;
}

void Recess::carry(CheckpointFile& file) {
    file.column("recess.a", entries_, &Entry::a);
    file.column("recess.b", entries_, &Entry::b);
    file.column("recess.depth", entries_, &Entry::depth);
    file.carry("recess.started", started_);
}

}  // namespace ice
