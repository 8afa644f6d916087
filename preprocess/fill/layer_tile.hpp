// SPDX-License-Identifier: GPL-3.0-or-later
/// The surface layer within one cube of space ("tile"): tiles of one colour touch nothing of each
/// other, so they can be filled at the same time with the same result.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <set>
#include <vector>

#include "preprocess/fill/make_layer.hpp"
#include "preprocess/fill/seat_grid.hpp"

namespace ice {

/// Where a sphere might sit under a surface sample.
struct Seed {
    Vec3 seat;              ///< the sample moved inwards by R [m]
    std::int32_t triangle;  ///< row of the mesh
};

/// The solid as a whole, seen once for all tiles.
struct LayerSolid {
    /// @param whole  kept by reference
    explicit LayerSolid(const SurfaceTree& whole);

    const SurfaceTree& tree;
    Eigen::AlignedBox3d box;  ///< of its vertices [m]
    bool convex;              ///< all vertices lie behind all faces; not tested in large meshes
};

/// Seats are placed in `box` (by the front) or up to 1.2 spacings around it (to close gaps).
class LayerTile {
public:
    /// @param solid  its tree is kept by reference
    LayerTile(const LayerSolid& solid, const LayerOptions& options, const Eigen::AlignedBox3d& box);

    /// Takes a seat that already is there, if it is near enough to matter.
    void take_seat(const Seat& seat);

    /// Advancing front over faces: round every seat the free places of a hexagon are tried, then
    /// round those, and so on; seeds that no front reached start their own. Of the seeds of a fine
    /// mesh in one small cube that face the same way the first free one is tried.
    void advance_front(const std::vector<Seed>& seeds);

    /// Places a sphere in every gap: at the corners of the seats' Voronoi cells, in the plane of
    /// the surface, that are farther away than 0.635 spacings.
    void close_gaps();

    /// Places a sphere at every seed that has none within 0.62 spacings: places that neither fronts
    /// nor Voronoi cells reached.
    void cover(const std::vector<Seed>& seeds);

    /// Spheres placed since the tile was made.
    const std::vector<Seat>& placed() const { return placed_; }

private:
    struct Neighbour {
        double u, v;      // in the tangent plane [m]
        double distance;  // in space [m]
        double angle;     // in the plane [rad]; set where a front needs it
    };
    struct Plane {
        Vec3 centre, normal, e1, e2;
        Vec3 at(double u, double v) const { return centre + u * e1 + v * e2; }
    };

    void add(const Seat& seat);
    bool tried_near(const Seed& seed);
    bool place(const Vec3& start, std::int32_t hint, double separation, double mirror_gap,
               bool outside_too);
    const std::vector<Plane>& planes_at(const Seat& seat);
    bool is_outside(const Vec3& start) const;
    void neighbours_in(const Plane& plane, double range);
    void surround(const Seat& seat);
    void surround_in(const Plane& plane, std::int32_t hint);
    void close_gaps_in(const Plane& plane, std::int32_t hint);

    const SurfaceTree& tree_;
    bool convex_;
    bool fine_;  // the mesh, beside the radius
    LayerOptions o_;
    Eigen::AlignedBox3d box_;
    SeatGrid grid_;
    std::vector<Seat> placed_;
    std::set<std::array<std::int32_t, 4>> tried_;        // cubes and directions of seeds
    std::vector<Vec3> found_;                            // scratch: normals
    std::vector<Plane> planes_;                          // of the seat whose places are tried
    std::vector<Neighbour> neighbours_;                  // scratch
    std::vector<std::array<double, 2>> cell_, clipped_;  // scratch: a Voronoi cell's corners
};

}  // namespace ice
