// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/offset_surface.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "preprocess/fill/narrowest_cone.hpp"

namespace ice {

namespace {

// Newton steps at most [-]. Where more are needed, faces alternate and no sphere fits. Fewer lose
// seats in narrow creases, more take longer where none is.
constexpr int kMostSteps = 40;
// Distance beyond the radius, over the radius [-], within which a face is touched. Far above
// kExact, so that all faces of a settled crease count; a larger value adds faces that only pass
// near.
constexpr double kTouch = 1e-5;
// The same for a start in a crease, whose point is known to 2 % of the radius only; the start is
// pushed towards the edge by as much. Smaller misses faces that meet there, larger adds faces that
// only pass near.
constexpr double kNearCrease = 0.02;
// Steps along the foot's direction, before creases are searched for: enough on smooth surfaces.
// With more, a seat that they lead into a crease is taken for one of a smooth surface; with fewer,
// the conditions of smooth surfaces are solved, too, which takes longer.
constexpr int kSmoothSteps = 3;
// Difference from the radius, over the radius [-], at which a distance counts as reached. A larger
// value lets spheres reach out by as much, a smaller one takes more Newton steps.
constexpr double kExact = 1e-10;
// The same over the coordinates [-], some units in the last place: far from the origin no step can
// do better. A smaller value loses seats there, a larger one places them less exactly.
constexpr double kCoordinateRounding = 8.0 * std::numeric_limits<double>::epsilon();
// Conditions that are compared [-]: the worst of them decide, and in a fine mesh thousands are
// near. Fewer may miss a face that a seat then reaches into, more take longer.
constexpr std::size_t kMostConditions = 200;
// Radius over the mesh's mean edge [-] from which the mesh is fine beside the radius: seeds that
// are alike are then tried once, and conditions are searched for near the closest triangle first. A
// larger value takes longer on fine meshes, a smaller one tries fewer seeds on coarse ones.
constexpr double kFine = 8.0;
// Directions kept of a sphere that fits a round solid exactly and touches it everywhere [-]. Fewer
// make its normal cone narrower, more take time.
constexpr std::size_t kMostDirections = 500;
// Cosine of 1e-3 rad: conditions with nearer directions are one, as those of one face's triangles.
// With a smaller angle these fill the list; with a larger one, faces that turn by less than it are
// one condition.
constexpr double kSameDirection = 0.9999995;
// Distance of a foot over the range of its search [-] up to which it has no direction: the centre
// lies on the surface, and the difference has no digits left. Larger takes the face's normal for
// exact directions, smaller takes directions of rounding.
constexpr double kNoDistance = 1e-12;
// Two and three conditions are solved in closed form where their determinant [-] is more: square of
// the sine of the angle between two, volume of three. Below, walls are nearly parallel, and an
// inverse would throw the centre far away. Smaller does so, larger takes least squares, which
// gives the same in more time.
constexpr double kLeastDeterminant2 = 1e-10, kLeastDeterminant3 = 1e-7;
// Distance by which a condition is missed [m] up to which it counts as met: rounding of lengths of
// about 1 m. Larger leaves faces out that a sphere reaches into, smaller solves for rounding.
constexpr double kMet = 1e-14;
// Distance to the foot over the radius [-] below which a start is too near to the surface for a
// step along the foot's direction. Larger solves more conditions, smaller makes steps along
// directions of few digits.
constexpr double kDeepEnough = 0.1;
// Longest move of a step over the radius [-]: a longer one shows a wedge too sharp to fit in.
// Larger follows it far away, smaller loses seats in narrow creases.
constexpr double kLongestMove = 4.0;
// Sum of the directions near a crease [-] below which they cancel: a thin part, without an edge to
// push the start to. Smaller pushes along rounding, larger leaves starts in shallow creases.
constexpr double kCancel = 1e-6;

// g . move >= need
struct Condition {
    Vec3 g;
    double need;
};

// The nearest first, equals by triangle.
void sort_by_distance(std::vector<Foot>& feet) {
    std::sort(feet.begin(), feet.end(), [](const Foot& l, const Foot& r) {
        return l.distance < r.distance || (l.distance == r.distance && l.triangle < r.triangle);
    });
}

// Conditions of the feet, which are sorted, equal directions once.
void add_conditions(const SurfaceTree& tree, const Vec3& c, double radius,
                    const std::vector<Foot>& feet, std::vector<Condition>& out) {
    out.clear();
    for (const Foot& foot : feet) {
        // a centre on the surface itself has no direction but the face's
        const Vec3 g = foot.distance > kNoDistance * radius ? Vec3((c - foot.point) / foot.distance)
                                                            : Vec3(-tree.normal(foot.triangle));
        const bool seen = std::any_of(out.begin(), out.end(), [&](const Condition& other) {
            return other.g.dot(g) > kSameDirection;
        });
        if (!seen) out.push_back({g, radius - foot.distance});
        if (out.size() == kMostConditions) return;
    }
}

// Conditions of all faces nearer than the radius, the worst first. In a mesh that is fine beside
// the radius, where thousands of triangles are that near, the range grows from the nearest one's
// distance until it holds as many conditions as may decide: the same ones.
void collect(const SurfaceTree& tree, const Vec3& c, double radius, double nearest,
             std::vector<Foot>& feet, std::vector<Condition>& out) {
    const double edge = tree.mean_edge();
    // over a plane at this distance there are as many triangles within this much more
    double width = is_fine_for(tree, radius)
                       ? kMostConditions * edge * edge / (4.0 * std::max(nearest, edge))
                       : radius;
    for (;; width *= 2.0) {
        const double range = std::min(nearest + width, radius);
        tree.within(c, range, feet);
        sort_by_distance(feet);
        add_conditions(tree, c, radius, feet, out);
        if (range == radius || out.size() == kMostConditions) return;
    }
}

// The smallest move with g . move = need for each of the conditions, which are independent or
// nearly so: normal equations, least squares where they do not have full rank.
Vec3 meet(const Condition* const* active, int count) {
    Eigen::Matrix3d g = Eigen::Matrix3d::Zero();
    Vec3 need = Vec3::Zero();
    for (int k = 0; k < count; ++k) {
        g.row(k) = active[k]->g.transpose();
        need[k] = active[k]->need;
    }
    // One and two conditions in closed form, as they are by far the most frequent; g is a unit
    // vector.
    if (count == 1) return need[0] * active[0]->g;
    if (count == 2) {
        const double mixed = active[0]->g.dot(active[1]->g), det = 1.0 - mixed * mixed;
        if (det > kLeastDeterminant2)
            return ((need[0] - mixed * need[1]) * active[0]->g +
                    (need[1] - mixed * need[0]) * active[1]->g) /
                   det;
    } else if (const double det = g.determinant(); std::abs(det) > kLeastDeterminant3) {
        return g.inverse() * need;
    }
    return g.completeOrthogonalDecomposition().solve(need);
}

// Smallest move that meets up to three of the conditions exactly: the worst, then those it leaves.
Vec3 smallest_move(const std::vector<Condition>& conditions) {
    const Condition* active[3] = {&conditions.front(), nullptr, nullptr};
    Vec3 move = meet(active, 1);
    for (int count = 1; count < 3;) {
        const Condition* worst = nullptr;
        double lack = kMet;
        for (const Condition& c : conditions) {
            const double now = c.need - c.g.dot(move);
            if (now <= lack) continue;
            lack = now;
            worst = &c;
        }
        if (worst == nullptr) break;
        active[count++] = worst;
        move = meet(active, count);
    }
    return move;
}

// Directions of the feet nearer than a range, each direction counted once.
// @param nearest  becomes the nearest foot's triangle where there is one
std::vector<Vec3> near_directions(const SurfaceTree& tree, const Vec3& center, double range,
                                  std::int32_t& nearest) {
    std::vector<Foot> feet;
    tree.within(center, range, feet);
    // the nearest first: the other triangles of a face have their feet a little aside
    sort_by_distance(feet);
    if (!feet.empty()) nearest = feet.front().triangle;
    std::vector<Vec3> directions;
    directions.reserve(4);
    for (const Foot& foot : feet) {
        if (!(foot.distance > kNoDistance * range)) continue;
        const Vec3 u = (foot.point - center) / foot.distance;
        const bool seen = std::any_of(directions.begin(), directions.end(),
                                      [&](const Vec3& d) { return d.dot(u) > kSameTouch; });
        if (!seen) directions.push_back(u);
        if (directions.size() == kMostDirections) break;
    }
    return directions;
}

// The first steps, as many as `smooth_steps`, go along the direction to the foot.
std::optional<Seat> settle_from(const SurfaceTree& tree, const Vec3& start, double radius,
                                std::int32_t hint, int smooth_steps) {
    Vec3 c = start;
    // take memory in creases only
    std::vector<Foot> feet;
    std::vector<Condition> conditions;
    for (int step = 0; step < kMostSteps; ++step) {
        const Foot foot = tree.closest(c, hint);
        hint = foot.triangle;
        if (!foot.inside) return std::nullopt;
        const bool smooth = step <= smooth_steps;
        if (std::abs(foot.distance - radius) <= exact_distance(c, radius)) {
            Seat seat{c, (foot.point - c) / foot.distance, foot.triangle};
            if (!smooth) find_crease(tree, radius, seat);
            return seat;
        }
        // the first steps, and any from too far inside: along the foot's direction to the
        // distance of a radius
        const bool direct = smooth && foot.distance > kDeepEnough * radius;
        if (direct || foot.distance > radius) {
            c += (foot.distance - radius) / foot.distance * (foot.point - c);
            continue;
        }
        // in a crease: the smallest move that brings up to three faces to the distance of a
        // radius
        collect(tree, c, radius, foot.distance, feet, conditions);
        const Vec3 move = smallest_move(conditions);
        if (!(move.norm() < kLongestMove * radius)) return std::nullopt;
        c += move;
    }
    return std::nullopt;
}

}  // namespace

bool is_fine_for(const SurfaceTree& tree, double radius) {
    return radius > kFine * tree.mean_edge();
}

double exact_distance(const Vec3& center, double radius) {
    return std::max(kExact * radius, kCoordinateRounding * center.cwiseAbs().maxCoeff());
}

std::optional<Seat> settle(const SurfaceTree& tree, const Vec3& start, double radius,
                           std::int32_t hint) {
    return settle_from(tree, start, radius, hint, kSmoothSteps);
}

std::optional<Seat> settle_in_crease(const SurfaceTree& tree, const Vec3& start, double radius) {
    // pushed a little towards the edge, so that all faces that meet there are conditions
    Vec3 pushed = start, sum = Vec3::Zero();
    std::int32_t nearest = -1;
    for (const Vec3& direction :
         near_directions(tree, start, radius * (1.0 + kNearCrease), nearest))
        sum += direction;
    if (sum.norm() > kCancel) pushed += kNearCrease * radius * sum.normalized();
    return settle_from(tree, pushed, radius, nearest, -1);
}

std::vector<Vec3> touch_directions(const SurfaceTree& tree, const Vec3& center, double radius) {
    std::int32_t unused = -1;
    return near_directions(tree, center, radius * (1.0 + kTouch), unused);
}

std::span<const Vec3> normals_at(const SurfaceTree& tree, double radius, const Seat& seat,
                                 std::vector<Vec3>& found) {
    if (!seat.in_crease) return {&seat.normal, 1};
    if (seat.touches > 0) return {seat.touch.data(), static_cast<std::size_t>(seat.touches)};
    found = touch_directions(tree, seat.center, radius);
    return found;
}

void find_crease(const SurfaceTree& tree, double radius, Seat& seat) {
    const std::vector<Vec3> directions = touch_directions(tree, seat.center, radius);
    seat.in_crease = directions.size() > 1;
    if (!seat.in_crease) return;
    seat.touches = directions.size() > seat.touch.size() ? 0 : static_cast<int>(directions.size());
    std::copy_n(directions.begin(), seat.touches, seat.touch.begin());
    const Cone cone = narrowest_cone(directions);
    seat.normal = cone.axis;
    // a crease's sphere agrees with normals of its whole cone
    seat.agree = std::cos(std::min(cone.half_angle + kFaceTurn, std::numbers::pi));
}

}  // namespace ice
