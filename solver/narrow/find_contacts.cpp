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

    SphereSurface sphere_a(std::int32_t i) const {
        return {shape_a.center[i], shape_a.radius[i], shape_a.normal[i], shape_a.spread_cos[i],
                shape_a.spread_sin[i]};
    }
    SphereSurface sphere_b(std::int32_t j) const {
        return {turn * shape_b.center[j] + shift, shape_b.radius[j], turn * shape_b.normal[j],
                shape_b.spread_cos[j], shape_b.spread_sin[j]};
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

// What a sphere has in common with its mirror image about y = 0 in the body's axes. Decisions and
// orders that look at this before any index make mirror-image states go on as mirror images, bit
// for bit.
std::tuple<double, double, double> mirrored_place(const Shape& shape, std::int32_t k) {
    const Vec3& c = shape.center[static_cast<std::size_t>(k)];
    return {c.x(), std::abs(c.y()), c.z()};
}

// Of a probe's candidates, the laterally nearest for each face; see the header.
void keep_one_per_face(const PairView& view, std::vector<Candidate>& candidates) {
    const auto order = [&](const Candidate& l, const Candidate& r) {
        const auto first = [](const Candidate& c) {
            return std::tuple(c.gap.a_is_surface, c.probe(), c.gap.lateral_sq);
        };
        if (first(l) != first(r)) return first(l) < first(r);
        const auto tie = [&](const Candidate& c) {
            return std::tuple(mirrored_place(view.shape_a, c.i), mirrored_place(view.shape_b, c.j),
                              c.i, c.j);
        };
        return tie(l) < tie(r);
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

void emit(const PairView& view, const std::vector<Candidate>& candidates,
          std::vector<Contact>& out) {
    const Bodies& bodies = view.scene.bodies;
    const Mat3& rotation = bodies.rotation[view.pair.a];
    const bool ship = view.pair.a == static_cast<std::int32_t>(kShip);
    if (candidates.empty()) return;
    const auto shared_b = count_contacts(candidates, &Candidate::j, view.shape_b.center.size());
    // the hull has many spheres and its shares are not asked for
    const auto shared_a = count_contacts(ship ? std::vector<Candidate>{} : candidates,
                                         &Candidate::i, ship ? 0 : view.shape_a.center.size());
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
        const Vec3 local = c.gap.a_is_surface
                               ? Vec3(view.turn * view.shape_b.center[c.j] + view.shift -
                                      c.gap.normal * (view.shape_b.radius[c.j] + 0.5 * c.gap.gap))
                               : Vec3(view.shape_a.center[c.i] +
                                      c.gap.normal * (view.shape_a.radius[c.i] + 0.5 * c.gap.gap));
        contact.point = rotation * local + bodies.position[view.pair.a];
        const Vec3 normal_b = view.turn.transpose() * c.gap.normal;
        contact.area =
            facing_area(view.shape_b, c.j, -normal_b) / shared_b[static_cast<std::size_t>(c.j)];
        if (!ship)
            contact.area = std::min(contact.area, facing_area(view.shape_a, c.i, c.gap.normal) /
                                                      shared_a[static_cast<std::size_t>(c.i)]);
        contact.region = ship ? view.shape_a.region[c.i] : -1;
        // a probe slides over many surface spheres: the probe and its face's rank are what lasts
        const std::int32_t probe = (c.probe() << 1) | (c.gap.a_is_surface ? 1 : 0);
        face = probe == last_probe ? face + 1 : 0;
        last_probe = probe;
        contact.key = (static_cast<std::uint64_t>(probe) << 32) | static_cast<std::uint32_t>(face);
        out.push_back(contact);
    }
}

void finish_pair(const PairView& view, NormalRule rule, std::vector<Candidate>& candidates,
                 std::vector<Contact>& out) {
    const auto before = static_cast<std::ptrdiff_t>(out.size());
    if (rule == NormalRule::surface) keep_one_per_face(view, candidates);
    emit(view, candidates, out);
    if (rule == NormalRule::centres)
        for (std::size_t k = 0; k < candidates.size(); ++k)
            out[out.size() - candidates.size() + k].key =
                (static_cast<std::uint64_t>(candidates[k].i) << 32) |
                static_cast<std::uint32_t>(candidates[k].j);
    // the solver takes contacts in this order, and its answer depends on it
    const auto order = [&](const Contact& c) {
        return std::tuple(mirrored_place(view.shape_a, c.sphere_a),
                          mirrored_place(view.shape_b, c.sphere_b), c.gap, c.key);
    };
    std::sort(out.begin() + before, out.end(),
              [&](const Contact& l, const Contact& r) { return order(l) < order(r); });
}

void find_pair_contacts(const Scene& scene, BodyPair pair, NormalRule rule, double margin,
                        std::vector<Candidate>& candidates, std::vector<Contact>& out) {
    const PairView view(scene, pair);
    candidates.clear();
    // only b's spheres in a's box, widened by what a contact can span, can touch
    const double reach =
        rule == NormalRule::surface ? std::max(view.shape_a.reach, view.shape_b.reach) : 0.0;
    const double span = view.shape_b.largest_radius + margin;
    const Eigen::AlignedBox3d box(view.shape_a.box.min() - Vec3::Constant(span + reach),
                                  view.shape_a.box.max() + Vec3::Constant(span + reach));
    for (std::int32_t j = 0; j < static_cast<std::int32_t>(view.shape_b.center.size()); ++j) {
        const Vec3 at = view.turn * view.shape_b.center[j] + view.shift;
        if (!box.contains(at)) continue;
        const SphereSurface b = view.sphere_b(j);
        const double along = view.shape_a.largest_radius + b.radius + margin;
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
