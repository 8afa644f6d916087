// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/find_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/base/parallel.hpp"
#include "solver/narrow/measure_gap.hpp"

namespace ice {

namespace {

// Normals closer than 30 degrees belong to the same face of a probe's neighbourhood.
constexpr double kSameFaceCos = 0.866;

// A pair takes about a microsecond: below this many, waking threads costs more than they save, and
// much more on a busy machine.
constexpr std::size_t kSerialPairs = 256;

// An edge that presses sideways still has some area, so that no contact is without strength.
constexpr double kLeastFacing = 0.05;

// Two bodies seen from a: b's spheres are brought into a's axes, where a's grid lies.
struct PairView {
    const Scene& scene;
    BodyPair pair;
    const Shape& shape_a;
    const Shape& shape_b;
    Mat3 turn;   // b's axes to a's
    Vec3 shift;  // b's origin in a's axes

    PairView(const Scene& s, BodyPair p)
        : scene(s),
          pair(p),
          shape_a(s.shapes[static_cast<std::size_t>(s.bodies.shape[p.a])]),
          shape_b(s.shapes[static_cast<std::size_t>(s.bodies.shape[p.b])]),
          turn(s.bodies.rotation[p.a].transpose() * s.bodies.rotation[p.b]),
          shift(s.bodies.rotation[p.a].transpose() *
                (s.bodies.position[p.b] - s.bodies.position[p.a])) {}

    Vec3 center_a(std::int32_t i) const {
        return shape_a.center[i] + scene.crushed.recess_of(pair.a, i);
    }
    Vec3 center_b(std::int32_t j) const {  // in a's axes
        return turn * (shape_b.center[j] + scene.crushed.recess_of(pair.b, j)) + shift;
    }
    SphereSurface sphere_a(std::int32_t i) const {
        return {center_a(i),           shape_a.radius[i],     shape_a.normal[i],
                shape_a.spread_cos[i], shape_a.spread_sin[i], shape_a.faces[i]};
    }
    SphereSurface sphere_b(std::int32_t j) const {
        return {center_b(j),           shape_b.radius[j],     turn * shape_b.normal[j],
                shape_b.spread_cos[j], shape_b.spread_sin[j], faces_b(j)};
    }
    Faces faces_b(std::int32_t j) const {
        Faces out = shape_b.faces[j];
        for (int k = 0; k < out.count; ++k) out.normal[k] = turn * out.normal[k];
        return out;
    }
};

struct Candidate {
    std::int32_t i, j;  // spheres of a and b
    Gap gap;
    std::int32_t probe() const { return gap.a_is_surface ? j : i; }
};

// Measures spheres i and j and keeps them when they are near enough to matter.
void consider(const PairView& view, NormalRule rule, double margin, std::int32_t i,
              const SphereSurface& b, std::int32_t j, std::vector<Candidate>& out) {
    const SphereSurface a = view.sphere_a(i);
    if (rule == NormalRule::centres) {
        const Gap gap = measure_gap_centres(a, b);
        if (gap.valid && gap.gap <= margin) out.push_back({i, j, gap});
        return;
    }
    const Gap gap = measure_gap_surface(a, b, view.pair.a == static_cast<std::int32_t>(kShip));
    const double reach = gap.a_is_surface ? view.shape_a.reach : view.shape_b.reach;
    if (gap.valid && gap.gap <= margin && gap.lateral_sq <= reach * reach)
        out.push_back({i, j, gap});
}

// Of a probe's candidates, the laterally nearest for each face; see the header.
void keep_one_per_face(std::vector<Candidate>& candidates) {
    const auto order = [](const Candidate& l, const Candidate& r) {
        return std::tuple(l.gap.a_is_surface, l.probe(), l.gap.lateral_sq, l.i, l.j) <
               std::tuple(r.gap.a_is_surface, r.probe(), r.gap.lateral_sq, r.i, r.j);
    };
    std::sort(candidates.begin(), candidates.end(), order);
    std::size_t kept = 0, group = 0;  // [group, kept) are the kept ones of the present probe
    for (const Candidate& now : candidates) {
        if (kept > group && (candidates[group].gap.a_is_surface != now.gap.a_is_surface ||
                             candidates[group].probe() != now.probe()))
            group = kept;
        const bool seen = std::any_of(
            candidates.begin() + static_cast<std::ptrdiff_t>(group),
            candidates.begin() + static_cast<std::ptrdiff_t>(kept), [&](const Candidate& other) {
                return other.gap.normal.dot(now.gap.normal) > kSameFaceCos;
            });
        if (!seen) candidates[kept++] = now;
    }
    candidates.resize(kept);
}

// How deep contact has crushed a sphere along its side's outward direction [m].
double crushed_depth(const Scene& scene, std::int32_t body, std::int32_t sphere,
                     const Vec3& outward) {
    return std::max(0.0, -scene.crushed.recess_of(body, sphere).dot(outward));
}

Patch patch_of(const Shape& shape, std::int32_t k, const Vec3& outward) {
    Patch patch;
    patch.share = shape.area[k];
    patch.facing = shape.normal[k].dot(outward);
    patch.spread_cos = shape.spread_cos[k];
    patch.spread_sin = shape.spread_sin[k];
    patch.wing = wing_length(shape.radius[k], patch.share, patch.spread_cos, patch.spread_sin);
    // the foot is the support itself at an edge that juts out, lower on a face that leans
    const double foot = patch.facing * corner_distance(shape.radius[k], patch.spread_cos);
    patch.foot = std::max(shape.radius[k] - foot, 0.0);
    return patch;
}

// The probe's patch. Where the hull is the probe, the ice it digs into is still what crushes.
Patch probe_patch(const PairView& view, const Candidate& c) {
    const Vec3 out_a = c.gap.normal, out_b = view.turn.transpose() * -c.gap.normal;
    const bool ship = view.pair.a == static_cast<std::int32_t>(kShip);
    Patch patch = c.gap.a_is_surface ? patch_of(view.shape_b, c.j, out_b)
                                     : patch_of(view.shape_a, c.i, out_a);
    patch.depth = -c.gap.gap + (c.gap.a_is_surface || ship
                                    ? crushed_depth(view.scene, view.pair.b, c.j, out_b)
                                    : crushed_depth(view.scene, view.pair.a, c.i, out_a));
    return patch;
}

// Surface of an ice sphere as seen along the contact normal: with the mean normal m and the
// half-angle s of the faces that meet there, cos(s) m is the sphere's vector area per area.
double facing_area(const Shape& shape, std::int32_t k, const Vec3& outward) {
    const double facing = shape.spread_cos[k] * shape.normal[k].dot(outward);
    return shape.area[k] * std::max(facing, kLeastFacing);
}

// Contacts per sphere of one side; spheres not in contact have none.
std::vector<std::int32_t> count_contacts(const std::vector<Candidate>& all,
                                         std::int32_t Candidate::*side, std::size_t spheres) {
    std::vector<std::int32_t> count(spheres, 0);
    for (const Candidate& c : all) ++count[static_cast<std::size_t>(c.*side)];
    return count;
}

// The probe decides where the bodies meet: midway between its surface and the other one's.
Vec3 meeting_point(const PairView& view, NormalRule rule, const Candidate& c) {
    const double sign = c.gap.a_is_surface ? -1.0 : 1.0;
    const Vec3 outward = sign * c.gap.normal;
    const SphereSurface probe = c.gap.a_is_surface ? view.sphere_b(c.j) : view.sphere_a(c.i);
    const Vec3 surface = rule == NormalRule::centres ? Vec3(probe.center + probe.radius * outward)
                                                     : support_point(probe, outward);
    return surface + 0.5 * c.gap.gap * outward;
}

void emit(const PairView& view, NormalRule rule, const std::vector<Candidate>& candidates,
          std::vector<Contact>& out) {
    const Bodies& bodies = view.scene.bodies;
    const Mat3& rotation = bodies.rotation[view.pair.a];
    const bool ship = view.pair.a == static_cast<std::int32_t>(kShip);
    if (candidates.empty()) return;
    std::int32_t last_probe = -1, face = 0;
    for (const Candidate& c : candidates) {
        Contact contact;
        contact.a = view.pair.a;
        contact.b = view.pair.b;
        contact.sphere_a = c.i;
        contact.sphere_b = c.j;
        contact.gap = c.gap.gap;
        contact.normal = rotation * c.gap.normal;
        // the probe decides where the bodies meet
        const Vec3 local = meeting_point(view, rule, c);
        contact.point = rotation * local + bodies.position[view.pair.a];
        contact.crushes_a = !ship && !c.gap.a_is_surface;
        contact.patch = probe_patch(view, c);
        contact.region = ship ? view.shape_a.region[c.i] : -1;
        // a probe slides over many surface spheres: the probe and its face's rank are what lasts
        const std::int32_t probe = (c.probe() << 1) | (c.gap.a_is_surface ? 1 : 0);
        face = probe == last_probe ? face + 1 : 0;
        last_probe = probe;
        contact.key = (static_cast<std::uint64_t>(probe) << 32) | static_cast<std::uint32_t>(face);
        out.push_back(contact);
    }
}

// Sphere on sphere: every pair of spheres is a contact, and shares of the surface are split.
void finish_centres(const PairView& view, const std::vector<Candidate>& candidates,
                    std::vector<Contact>& out) {
    const bool ship = view.pair.a == static_cast<std::int32_t>(kShip);
    const auto shared_b = count_contacts(candidates, &Candidate::j, view.shape_b.center.size());
    // the hull has many spheres and its shares are not asked for
    const auto shared_a = count_contacts(ship ? std::vector<Candidate>{} : candidates,
                                         &Candidate::i, ship ? 0 : view.shape_a.center.size());
    const auto first = out.end() - static_cast<std::ptrdiff_t>(candidates.size());
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const Candidate& c = candidates[k];
        Contact& contact = first[static_cast<std::ptrdiff_t>(k)];
        contact.key = (static_cast<std::uint64_t>(c.i) << 32) | static_cast<std::uint32_t>(c.j);
        double area = facing_area(view.shape_b, c.j, view.turn.transpose() * -c.gap.normal) /
                      shared_b[static_cast<std::size_t>(c.j)];
        if (!ship)
            area = std::min(area, facing_area(view.shape_a, c.i, c.gap.normal) /
                                      shared_a[static_cast<std::size_t>(c.i)]);
        contact.patch = Patch{.share = area};
    }
}

void finish_pair(const PairView& view, NormalRule rule, std::vector<Candidate>& candidates,
                 std::vector<Contact>& out) {
    if (rule == NormalRule::surface) keep_one_per_face(candidates);
    emit(view, rule, candidates, out);
    if (rule == NormalRule::centres && !candidates.empty()) finish_centres(view, candidates, out);
}

void find_pair_contacts(const Scene& scene, BodyPair pair, NormalRule rule, double margin,
                        std::vector<Candidate>& candidates, std::vector<Contact>& out) {
    const PairView view(scene, pair);
    candidates.clear();
    // only b's spheres in a's box, widened by what a contact can span, can touch
    const double reach =
        rule == NormalRule::surface ? std::max(view.shape_a.reach, view.shape_b.reach) : 0.0;
    const double span = view.shape_b.largest_support + margin;
    const Eigen::AlignedBox3d box(view.shape_a.box.min() - Vec3::Constant(span + reach),
                                  view.shape_a.box.max() + Vec3::Constant(span + reach));
    for (std::int32_t j = 0; j < static_cast<std::int32_t>(view.shape_b.center.size()); ++j) {
        const Vec3 at = view.center_b(j);
        if (!box.contains(at)) continue;
        const SphereSurface b = view.sphere_b(j);
        const double along = view.shape_a.largest_support + view.shape_b.largest_support + margin;
        const double range_sq = along * along + reach * reach;
        view.shape_a.grid.for_each_near(at, std::sqrt(range_sq), [&](std::int32_t i) {
            if ((view.shape_a.center[i] - at).squaredNorm() <= range_sq)
                consider(view, rule, margin, i, b, j, candidates);
        });
    }
    // grid order differs between poses: ascending spheres make the answer a function of the pair
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& l, const Candidate& r) {
        return std::pair(l.i, l.j) < std::pair(r.i, r.j);
    });
    finish_pair(view, rule, candidates, out);
}

// Upper bound of the speed at which surface points of the two bodies approach [m/s].
double closing_speed(const Scene& scene, BodyPair pair) {
    const Bodies& b = scene.bodies;
    const auto turning = [&](std::int32_t i) {
        return b.angular_velocity[i].norm() *
               scene.shapes[static_cast<std::size_t>(b.shape[i])].bounding_radius;
    };
    return (b.velocity[pair.b] - b.velocity[pair.a]).norm() + turning(pair.a) + turning(pair.b);
}

}  // namespace

void ContactFinder::find(const Scene& scene, const std::vector<BodyPair>& pairs, NormalRule rule,
                         double dt, double margin, std::vector<Contact>& out) {
    if (per_pair_.size() < pairs.size()) per_pair_.resize(pairs.size());
    parallel_for(pairs.size(), kSerialPairs, [&](std::size_t k) {
        thread_local std::vector<Candidate> candidates;
        per_pair_[k].clear();
        find_pair_contacts(scene, pairs[k], rule, dt * closing_speed(scene, pairs[k]) + margin,
                           candidates, per_pair_[k]);
    });
    out.clear();
    for (std::size_t k = 0; k < pairs.size(); ++k)
        out.insert(out.end(), per_pair_[k].begin(), per_pair_[k].end());
}

namespace reference {

void find_contacts(const Scene& scene, BodyPair pair, NormalRule rule, double margin,
                   std::vector<Contact>& out) {
    const PairView view(scene, pair);
    std::vector<Candidate> candidates;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(view.shape_a.center.size()); ++i)
        for (std::int32_t j = 0; j < static_cast<std::int32_t>(view.shape_b.center.size()); ++j)
            consider(view, rule, margin, i, view.sphere_b(j), j, candidates);
    finish_pair(view, rule, candidates, out);
}

}  // namespace reference

}  // namespace ice
