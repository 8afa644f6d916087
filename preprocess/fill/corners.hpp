// SPDX-License-Identifier: GPL-3.0-or-later
/// Corners: places where a sphere inside the solid touches three faces at once.
#pragma once

#include <optional>
#include <vector>

#include "common/formats/sphere_set.hpp"
#include "preprocess/fill/offset_surface.hpp"

namespace ice {

/// Corners nearer than this [spacings] that have the same faces are one. The ends of a short edge
/// have other faces: both stay.
constexpr double kSameCorner = 1e-3;

/// True where a settled sphere touches three faces whose normals span a volume of at least 0.1 [-].
/// Less is an edge: sides that turn by 6 degrees, with a top, have 0.1.
bool is_corner(const Seat& seat);

/// True where two settled spheres touch the same faces, three at most, to 0.014 rad.
bool touch_the_same(const Seat& one, const Seat& other);

/// A seat on an edge moved along it, not farther than `most` [m], until it touches a third face.
/// @param along  the edge's direction, unit
/// @return nothing where there is no corner before, or the edge is not straight
std::optional<Seat> slide_to_corner(const SurfaceTree& tree, double radius, Seat seat,
                                    const Vec3& along, double most);

/// The corners at both ends of the edge that a seat is in, as far as `most` [m] from it; none
/// unless the seat touches two faces. `out` is replaced.
void find_corners_beside(const SurfaceTree& tree, double radius, const Seat& seat, double most,
                         std::vector<Seat>& out);

/// Corners of a solid in which a sphere of the set's radius has room, and those among them that no
/// sphere of the set sits in: contacts there are found late or not at all.
struct CornerCount {
    std::int64_t all = 0;     ///< count
    std::vector<Vec3> blind;  ///< centres of the spheres that are missing, with their images [m]
};

/// Follows the edges from every sphere in an edge to the corners at both ends, a spacing at most,
/// and searches there for a sphere that has the three faces.
/// @param half  solid and set are their own mirror images: follows those with y >= 0 only
/// @pre set.centers, surface_count and creases are set; 3D
CornerCount count_corners(const SurfaceTree& tree, const SphereSet& set, bool half);

}  // namespace ice
