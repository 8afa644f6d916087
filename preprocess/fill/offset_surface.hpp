// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "common/geometry/surface_tree.hpp"

namespace ice {

/// Normals that differ by less than this [rad], 65 degrees, count as those of one face: spheres of
/// opposite faces may be in the same place without representing each other's face. Beyond 90
/// degrees they would; far below, curved sides would need more spheres.
constexpr double kFaceTurn = 1.134;

/// Cosine of 0.01 rad [-]: directions of touches that are nearer count once. With a smaller angle
/// the triangles of one face count as several, with a larger one faces that turn by less than it
/// are one.
constexpr double kSameTouch = 0.99995;

/// Centre of a sphere that touches the surface from inside.
struct Seat {
    Vec3 center;             ///< [m]
    Vec3 normal;             ///< outward, from the centre to the touch; unit
    std::int32_t triangle;   ///< that it touches there
    bool in_crease = false;  ///< it touches several faces; `normal` is the axis of the cone round
                             ///< their normals
    double agree = 0.4226;   ///< cosine of kFaceTurn plus the cone's half angle
    int touches = 0;         ///< in a crease: how many of `touch` are known; 0: they are not
    std::array<Vec3, 3> touch{};  ///< touch_directions(), found once and kept

    /// True where the seat represents a surface with this normal.
    bool agrees(const Vec3& surface_normal) const { return normal.dot(surface_normal) >= agree; }
    bool agrees(std::span<const Vec3> surface_normals) const {
        return std::all_of(surface_normals.begin(), surface_normals.end(),
                           [&](const Vec3& n) { return agrees(n); });
    }
};

/// True where the mesh is fine beside the radius [m]: thousands of triangles are near a sphere.
bool is_fine_for(const SurfaceTree& tree, double radius);

/// The distance from `radius` [m] at which a centre counts as settled: 1e-10 of the radius, or far
/// from the origin the rounding error of coordinates.
double exact_distance(const Vec3& center, double radius);

/// Moves a point to the nearest place where a sphere of `radius` touches the surface from inside:
/// a point of the offset surface {d = radius}, in its edges and corners where faces meet.
///
/// On a smooth surface two or three steps along the direction to the foot are enough. Where faces
/// meet: Newton on the distances, every face nearer than the radius being a condition
/// g . move >= radius - d (g away from the foot); the smallest move that satisfies the worst of
/// them, three directions at most, is taken until all hold.
///
/// @param hint  a triangle thought to be near, as in SurfaceTree::closest
/// @return nothing when the start lies outside the solid or no sphere fits there (thin parts).
///         Otherwise the distance to the surface is `radius` within 1e-9 of it.
std::optional<Seat> settle(const SurfaceTree& tree, const Vec3& start, double radius,
                           std::int32_t hint = -1);

/// Settles a start at a sharp edge or corner, within 2 % of the radius of where its sphere touches
/// all faces met there: it ends up touching them all.
std::optional<Seat> settle_in_crease(const SurfaceTree& tree, const Vec3& start, double radius);

/// The surface normals that a seat represents: its own, or all that meet in its crease. They are
/// in the seat or in `found`, whose old content is dropped.
std::span<const Vec3> normals_at(const SurfaceTree& tree, double radius, const Seat& seat,
                                 std::vector<Vec3>& found);

/// Sets normal, in_crease, agree and touches of a seat that may touch several faces.
void find_crease(const SurfaceTree& tree, double radius, Seat& seat);

/// The directions, from a settled centre, of the places where its sphere touches the surface;
/// directions within 0.01 rad of each other count once, at most the nearest 500. Unit vectors,
/// pointing outwards.
std::vector<Vec3> touch_directions(const SurfaceTree& tree, const Vec3& center, double radius);

}  // namespace ice
