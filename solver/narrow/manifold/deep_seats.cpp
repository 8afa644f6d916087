// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/manifold/deep_seats.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "solver/narrow/feature/deep_pair.hpp"
#include "solver/narrow/feature/way_out.hpp"
#include "solver/narrow/manifold/make_contacts.hpp"

namespace ice {

namespace {

// cos 60 degrees [-]: a seat whose direction out of the solid differs more from the deepest one's
// leads to another face. Larger drops seats of curved faces; without it seats near a floe's rim,
// nearer to its upper face than to its side, pushed the other floe down.
constexpr double kSameExit = 0.5;

// One body's seats, seen from the other's solid.
struct Side {
    const Shape& of;           // whose seats
    const Shape& in;           // whose solid
    std::int32_t body, other;  // of both
    Mat3 rotation;             // from the seats' axes to the solid's
    Vec3 translation;          // [m]
};

Side side_of_b(const PairView& v) {
    return {v.shape_b, v.shape_a, v.pair.b, v.pair.a, v.rotation_ab, v.translation_ab};
}

Side side_of_a(const PairView& v) {
    const Mat3 back = v.rotation_ab.transpose();
    return {v.shape_a, v.shape_b, v.pair.a, v.pair.b, back, Vec3(-(back * v.translation_ab))};
}

// The box of the solid in the seats' axes, where the groups of spheres lie.
Eigen::AlignedBox3d box_of_solid(const Side& side) {
    const Mat3 back = side.rotation.transpose();
    const Vec3 middle = back * (side.in.box.center() - side.translation);
    const Vec3 half = back.cwiseAbs() * (0.5 * side.in.box.sizes());
    return {Vec3(middle - half), Vec3(middle + half)};
}

bool group_meets(const SphereBlocks& blocks, std::size_t g, const Eigen::AlignedBox3d& box,
                 double grow) {
    for (int d = 0; d < 3; ++d)
        if (static_cast<double>(blocks.groups.low[d][g]) - grow > box.max()[d] ||
            static_cast<double>(blocks.groups.high[d][g]) + grow < box.min()[d])
            return false;
    return true;
}

// Points around which no seat can be deep: a seat is as deep as another one plus their distance at
// most, so one that lies outside, or less deep, has a clearance.
class Clearings {
public:
    // @param clearance  the radius in which no seat is of use [m]
    void add(const Vec3& at, double clearance) {
        if (clearance <= 0.0) return;
        places_[next_] = {at, clearance * clearance};
        next_ = (next_ + 1) % places_.size();
    }
    bool contain(const Vec3& p) const {
        return std::any_of(places_.begin(), places_.end(), [&](const Place& place) {
            return (p - place.at).squaredNorm() < place.clearance_sq;
        });
    }

private:
    struct Place {
        Vec3 at = Vec3::Zero();
        double clearance_sq = 0.0;
    };
    std::array<Place, 4> places_;
    std::size_t next_ = 0;
};

// Calls visit(sphere, seat) for a sphere's seat if it lies in the other's box, grown by `reach`
// [m]; the solid's axes.
template <class Visit>
void visit_seat(const PairView& view, const Side& side, std::int32_t sphere, double reach,
                const Visit& visit) {
    Vec3 at = side.of.center[sphere];
    if (!view.scene.crushed.is_whole(side.body)) {
        at += view.scene.crushed.displacement_of(side.body, sphere);
        if (!side.of.box.contains(at)) return;  // driven right through its body
    }
    at += side.of.radius[sphere] * side.of.normal[sphere];
    const Vec3 seat = side.rotation * at + side.translation;
    const Vec3 beyond = (side.in.box.min() - seat).cwiseMax(seat - side.in.box.max());
    if (beyond.maxCoeff() <= reach) visit(sphere, seat);
}

// Calls visit(sphere, seat) for all seats that may lie in the other's box, grown by `reach` [m].
template <class Visit>
void for_each_seat(const PairView& view, const Side& side, double reach, const Visit& visit) {
    const SphereBlocks& blocks = side.of.blocks;
    const Eigen::AlignedBox3d box = box_of_solid(side);
    // The groups' boxes hold centres of spheres, as floats and before any crushing. The growth adds
    // the radius, at which a seat lies, the crushed depth and the rounding.
    const double grow = reach + side.of.largest_radius + view.scene.crushed.deepest_of(side.body) +
                        static_cast<double>(SphereBlocks::kFloatShare * blocks.size);
    for (std::size_t g = 0; g < blocks.group_count; ++g) {
        if (!group_meets(blocks, g, box, grow)) continue;
        for (std::size_t lane = 0; lane < SphereBlocks::kGroup; ++lane) {
            const std::int32_t k = blocks.id[g * SphereBlocks::kGroup + lane];
            if (k >= 0) visit_seat(view, side, k, reach, visit);
        }
    }
}

// How deep the deepest contact is whose sphere, on either body, lies within a patch radius of the
// seat; 0 without one [m]. A face's spheres share its contacts: most seats have none of their own.
// @param seat  a's axes
double depth_known(const PairView& view, std::span<const Candidate> found, const Vec3& seat) {
    const double radius = std::max(view.shape_a.patch_radius, view.shape_b.patch_radius);
    double depth = 0.0;
    for (const Candidate& c : found)
        if (-c.gap.gap > depth && ((view.center_a(c.i) - seat).norm() <= radius ||
                                   (view.center_b(c.j) - seat).norm() <= radius))
            depth = -c.gap.gap;
    return depth;
}

DeepSeat seat_of(const PairView& view, const Side& side, std::int32_t sphere, const Vec3& seat,
                 const Foot& foot) {
    DeepSeat out;
    out.sphere = sphere;
    out.of_b = side.body == view.pair.b;
    // the sphere on the way out; a seat of the hull crushes it
    const WayOut way = way_out(view.scene, side.other, seat, foot);
    out.facing = way.sphere;
    out.gap = -way.depth;
    const auto in_a = [&](const Vec3& p) {
        return out.of_b ? p : Vec3(view.rotation_ab * p + view.translation_ab);
    };
    out.seat = in_a(seat);
    out.foot = in_a(way.foot);
    out.normal = out.of_b ? way.outward : Vec3(view.rotation_ab * -way.outward);
    return out;
}

// Calls visit(sphere, seat, foot) for the seats that are deeper in the solid than `from` [m].
// @param seats  calls its argument with sphere and seat
// @returns the depth of the deepest seat, or `from` where none is deeper [m]
template <class Seats, class Visit>
double for_each_deeper(const Side& side, double from, const Seats& seats, const Visit& visit) {
    double deepest = from;
    Clearings clear;
    seats([&](std::int32_t sphere, const Vec3& seat) {
        // Depth changes by at most the distance of two seats: most seats of a side that lies
        // outside are ruled out by the last few nearest points.
        if (clear.contain(seat)) return;
        const Foot foot = side.in.surface->closest(seat);
        const double depth = foot.inside ? foot.distance : -foot.distance;
        clear.add(seat, from - depth);
        deepest = std::max(deepest, depth);
        if (depth > from) visit(sphere, seat, foot);
    });
    return deepest;
}

// Appends the deep seats of one side.
void add_side(const PairView& view, const Side& side, std::span<const SpherePair> near,
              std::span<const Candidate> found, std::vector<DeepSeat>& out) {
    const double slack = deep_slack(view);
    const auto seats = [&](const auto& visit) {
        for (const SpherePair& seat : near)
            if (const std::int32_t k = side.body == view.pair.b ? seat.b : seat.a; k >= 0)
                visit_seat(view, side, k, 0.0, visit);
    };
    for_each_deeper(side, slack, seats,
                    [&](std::int32_t sphere, const Vec3& seat, const Foot& foot) {
                        if (lies_in_notch(view.scene, side.body, sphere)) return;
                        const DeepSeat deep = seat_of(view, side, sphere, seat, foot);
                        // the spheres' contacts nearby explain the depth up to the slack
                        if (deep.gap < -slack - depth_known(view, found, deep.seat))
                            out.push_back(deep);
                    });
}

// Keeps the seats that are pushed in the direction of the deepest one, to 60 degrees. A seat beside
// the rim of the other's face may be nearer to the next face than to the one that it came through;
// the deepest is not.
void keep_one_direction(std::vector<DeepSeat>& seats) {
    if (seats.empty()) return;
    const auto deepest = std::min_element(
        seats.begin(), seats.end(), [](const auto& l, const auto& r) { return l.gap < r.gap; });
    const Vec3 direction = deepest->normal;
    std::erase_if(seats, [&](const DeepSeat& s) { return s.normal.dot(direction) < kSameExit; });
}

// Appends the seats of one side that are deeper than `from` [m]; returns the depth of the deepest,
// at least `from`.
double list_side(const PairView& view, const Side& side, double from,
                 std::vector<SpherePair>& out) {
    // a seat that lies outside may lie beyond the solid's box by as much
    const double reach = std::max(0.0, -from);
    const auto seats = [&](const auto& visit) { for_each_seat(view, side, reach, visit); };
    const bool of_b = side.body == view.pair.b;
    return for_each_deeper(side, from, seats, [&](std::int32_t sphere, const Vec3&, const Foot&) {
        out.push_back(of_b ? SpherePair{-1, sphere} : SpherePair{sphere, -1});
    });
}

}  // namespace

double list_near_seats(const PairView& view, double apart, double skin,
                       std::vector<SpherePair>& out) {
    // a seat's depth grows by no more than the bodies' relative motion
    const double slack = deep_slack(view), from = slack - skin;
    if (view.shape_a.dimension == 2 || is_convex_pair(view) || apart > -from) return skin;
    const double deepest_b = list_side(view, side_of_b(view), from, out),
                 deepest_a = list_side(view, side_of_a(view), from, out);
    return slack - std::max(deepest_b, deepest_a);
}

void find_deep_seats(const PairView& view, std::span<const SpherePair> near,
                     std::span<const Candidate> found, std::vector<DeepSeat>& out) {
    out.clear();
    add_side(view, side_of_b(view), near, found, out);
    add_side(view, side_of_a(view), near, found, out);
    // By place with y and -y alike: mirror images are solved in the same order.
    std::sort(out.begin(), out.end(), [](const DeepSeat& l, const DeepSeat& r) {
        const auto key = [](const DeepSeat& s) {
            return std::tuple(s.seat.x(), std::abs(s.seat.y()), s.seat.z(), s.of_b, s.sphere);
        };
        return key(l) < key(r);
    });
    keep_one_direction(out);
}

void make_seat_contacts(const PairView& view, const ContactRule& rule,
                        std::span<const DeepSeat> seats, Contact* out) {
    const Mat3& rotation = view.scene.bodies.rotation[view.pair.a];
    const bool ship = view.pair.a == static_cast<std::int32_t>(kShip);
    for (const DeepSeat& s : seats) {
        Contact& contact = *out++;
        contact.a = view.pair.a;
        contact.b = view.pair.b;
        contact.sphere_a = s.of_b ? s.facing : s.sphere;
        contact.sphere_b = s.of_b ? s.sphere : s.facing;
        // bits that no sphere's contact and no polygon's corner have
        contact.key = std::uint64_t{3} << 62 | std::uint64_t{s.of_b} << 32 |
                      static_cast<std::uint64_t>(s.sphere);
        contact.point =
            rotation * Vec3(0.5 * (s.seat + s.foot)) + view.scene.bodies.position[view.pair.a];
        contact.normal = rotation * s.normal;
        contact.gap = s.gap;
        contact.region = ship ? view.shape_a.region.at(contact.sphere_a, s.normal) : -1;
        contact.crushes_a = !ship && !s.of_b;
        contact.patch = Patch{};
        contact.patch.depth = -s.gap;
        // between floes that cannot be crushed no patch is needed: the bound is infinite
        if (ship || rule.crushes)
            contact.patch = contact.crushes_a ? patch_of_a(view, s.sphere, s.normal, s.gap)
                                              : ice_patch(view, contact.sphere_b, s.normal, s.gap);
    }
}

}  // namespace ice
