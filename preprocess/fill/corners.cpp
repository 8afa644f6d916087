// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/corners.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "common/base/assert.hpp"
#include "common/base/parallel.hpp"
#include "preprocess/fill/point_grid.hpp"

namespace ice {

namespace {

// Length of an edge [spacings] that is searched from a sphere: an edge has a sphere in every
// spacing, and a hundredth is for rounding. A smaller value misses corners, a larger one takes
// longer.
constexpr double kEdgeReach = 1.01;

// How far a settled sphere may go along a unit vector until it touches one more face [m]; `most`
// where there is none before.
// @param feet  work memory
double distance_to_next_face(const SurfaceTree& tree, const Vec3& center, const Vec3& along,
                             double radius, double most, std::vector<Foot>& feet) {
    // Sine between `along` and the face [-]: a flatter face is one that the sphere slides along. A
    // larger value misses blunt corners, a smaller one takes the edge's own faces for new ones.
    constexpr double kLeastRise = 0.1;
    // The distance to a face shrinks by the cosine of the angle between `along` and the face's
    // direction: the face is touched after (distance - radius) / cosine.
    tree.within(center, radius + most, feet);
    for (const Foot& foot : feet) {
        const double rise = (foot.point - center).dot(along);
        if (rise > kLeastRise * foot.distance)
            most = std::min(most, (foot.distance - radius) * foot.distance / rise);
    }
    return most;
}

// Cosine of 0.014 rad [-]: touches nearer than that are of one face. A smaller angle makes two
// corners of one that is reached from two edges, a larger one makes faces one that turn by as
// little.
constexpr double kSameNormal = 0.9999;

// The spheres that touch several faces: few of a ship's, and the only ones that can have a corner.
class CreasedSpheres {
public:
    explicit CreasedSpheres(const SphereSet& set) : set_(set), grid_(set.spacing) {
        const auto& creases = set.creases;
        for (std::size_t k = 0; k < creases.size(); ++k) {
            if (k > 0 && creases[k].sphere == creases[k - 1].sphere) continue;
            first_.push_back(k);
            grid_.add(set.centers[static_cast<std::size_t>(creases[k].sphere)]);
        }
        first_.push_back(creases.size());
    }

    // Whether one of them lies in this corner and has its faces.
    bool contain(const Seat& corner) const {
        return grid_.any_within(
            corner.center, kSameCorner * set_.spacing, [&](std::int32_t sphere) {
                // creases are in order of their spheres: those of one are a range
                const auto at = static_cast<std::size_t>(sphere);
                const auto normals =
                    std::span(set_.creases).subspan(first_[at], first_[at + 1] - first_[at]);
                return std::all_of(corner.touch.begin(), corner.touch.end(), [&](const Vec3& n) {
                    return std::any_of(normals.begin(), normals.end(), [&](const auto& crease) {
                        return crease.normal.dot(n) > kSameNormal;
                    });
                });
            });
    }

private:
    const SphereSet& set_;
    PointGrid grid_;
    std::vector<std::size_t> first_;  // of each one's normals in set.creases, and the end
};

}  // namespace

bool is_corner(const Seat& seat) {
    // Triple product of the three faces' normals [-]: of less, they lie almost in a plane, and the
    // place is an edge. Smaller takes places of a curved edge for corners, larger misses blunt
    // corners.
    constexpr double kLeastVolume = 0.1;
    const auto& t = seat.touch;
    return seat.touches == 3 && std::abs(t[0].cross(t[1]).dot(t[2])) >= kLeastVolume;
}

bool touch_the_same(const Seat& one, const Seat& other) {
    const auto end = one.touch.begin() + one.touches;
    return one.touches == other.touches && std::all_of(one.touch.begin(), end, [&](const Vec3& n) {
               return std::any_of(other.touch.begin(), other.touch.begin() + other.touches,
                                  [&](const Vec3& m) { return n.dot(m) > kSameNormal; });
           });
}

std::optional<Seat> slide_to_corner(const SurfaceTree& tree, double radius, Seat seat,
                                    const Vec3& along, double most) {
    // Steps at most [-]: several where the third face is cut into triangles or curved. Fewer miss
    // corners in such faces, more only take time.
    constexpr int kMostSteps = 8;
    std::vector<Foot> feet;
    for (int step = 0; step < kMostSteps; ++step) {
        const double distance = distance_to_next_face(tree, seat.center, along, radius, most, feet);
        if (distance == most) return std::nullopt;
        if (distance < exact_distance(seat.center, radius)) break;
        seat.center += distance * along;
        most -= distance;
    }
    find_crease(tree, radius, seat);
    if (!is_corner(seat) ||
        !tree.is_clear(seat.center, radius - 2.0 * exact_distance(seat.center, radius)))
        return std::nullopt;
    return seat;
}

void find_corners_beside(const SurfaceTree& tree, double radius, const Seat& seat, double most,
                         std::vector<Seat>& out) {
    out.clear();
    if (seat.touches != 2) return;
    const Vec3 along = seat.touch[0].cross(seat.touch[1]).normalized();
    for (const Vec3& direction : {along, Vec3(-along)})
        if (const auto corner = slide_to_corner(tree, radius, seat, direction, most))
            out.push_back(*corner);
}

CornerCount count_corners(const SurfaceTree& tree, const SphereSet& set, bool half) {
    ICE_ASSERT(set.dimension == 3 && set.surface_count <= set.centers.size());
    std::vector<std::vector<Seat>> found(set.surface_count);
    parallel_for(set.surface_count, 64, [&](std::size_t k) {
        // The search for a corner starts from the edges that end in it: spheres on faces do not
        // lead there.
        const bool on_face = set.normal_spread[k] == 0.0;
        if (on_face || (half && set.centers[k].y() < 0.0)) return;
        Seat seat{set.centers[k], set.normals[k], -1};
        find_crease(tree, set.radius, seat);
        if (is_corner(seat))
            found[k].push_back(seat);
        else
            find_corners_beside(tree, set.radius, seat, kEdgeReach * set.spacing, found[k]);
    });
    CornerCount out;
    if (set.surface_count == 0) return out;
    const CreasedSpheres creased(set);
    PointGrid counted(set.spacing);
    std::vector<Seat> all;
    for (const auto& corners : found)
        for (const Seat& corner : corners) {
            if (half && corner.center.y() < -kSameCorner * set.spacing) continue;
            // The three edges of a corner each lead to it: counted once.
            if (counted.any_within(corner.center, kSameCorner * set.spacing, [&](std::int32_t k) {
                    return touch_the_same(all[static_cast<std::size_t>(k)], corner);
                }))
                continue;
            counted.add(corner.center);
            all.push_back(corner);
            // Of half a solid each corner off the plane of symmetry counts twice.
            const bool has_image = half && corner.center.y() > kSameCorner * set.spacing;
            out.all += has_image ? 2 : 1;
            if (creased.contain(corner)) continue;
            const Vec3& c = corner.center;
            out.blind.push_back(c);
            if (has_image) out.blind.emplace_back(c.x(), -c.y(), c.z());
        }
    return out;
}

}  // namespace ice
