// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <span>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// The faces that meet in an edge (2) or a vertex (3), by their outward normals, and the cone of
/// all outward normals there (docs/method.md, section 3).
struct NormalCone {
    int count = 0;  ///< 0: faces not known, as on a face, a round part or a knife edge
    /// Outward, unit; the first `count` of them.
    std::array<Vec3, 3> normal{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    double apex_distance =
        0.0;  ///< from the sphere's centre along its normal to where they meet [m]
    double tangent_extent = 0.0;  ///< largest extent of its patch across a contact normal [m]

    /// None, or the 2 or 3 faces with these unit normals; `apex_distance` and `tangent_extent` are
    /// left 0.
    static NormalCone meeting(std::span<const Vec3> normals);

    /// The cone in other axes.
    NormalCone turned(const Mat3& turn) const;

    /// Is n, a unit vector, in the cone: are its components along the faces' normals positive, to
    /// 0.3 degrees where these are square?
    /// Outside the cone another sphere has the body's foremost point; so it has where n leans along
    /// the edge, by more than `most_along` (cosine).
    /// @param slack  widens all bounds [rad]; negative: narrows them
    /// @pre count > 0
    bool contains(const Vec3& n, double most_along, double slack = 0.0) const {
        return contains_either_sign(n, most_along, slack).forth;
    }
    /// Is n in the cone (forth), and is -n (back)?
    struct Signs {
        bool forth, back;
    };
    Signs contains_either_sign(const Vec3& n, double most_along, double slack = 0.0) const {
        const double least = kBelongs * size - slack;  // no `part` is longer than 1
        const double first = n.dot(part[0]), second = n.dot(part[1]), last = n.dot(part[2]);
        Signs out{first >= least && second >= least, -first >= least && -second >= least};
        if (count == 2) {
            const bool across = std::abs(last) <= most_along + slack;
            return {out.forth && across, out.back && across};
        }
        return {out.forth && last >= least, out.back && -last >= least};
    }

    /// Least of n . (p - apex) [m] for the points p of the solid that the faces bound: at a
    /// corner those within the parallelepiped of its edges, each `around` [m] long; at an edge
    /// those so far along it either way and into both faces. At most 0. @pre count > 0
    double least_along(const Vec3& n, double around) const;

    /// Number of edges: 3 end at a vertex, 1 passes between two faces, else none.
    int edges() const { return count == 3 ? 3 : count / 2; }
    /// Unit vector along edge k, 0 <= k < edges(): of a vertex from there into the solid, else of
    /// either sign.
    Vec3 edge(int k) const {
        const auto n = static_cast<std::size_t>(k);
        return count == 2 ? part[2] : Vec3(-per_length[n] * part[n]);
    }
    /// Sine of the angle between the two faces that meet in edge k: faces 0 and 1 of an edge, all
    /// but face k of a vertex. 0 where they are parallel.
    double sine(int k) const {
        if (count == 2) return std::sqrt(size);
        const double inverse = per_length[static_cast<std::size_t>(k)];
        return inverse > 0.0 ? 1.0 / inverse : 0.0;
    }
    /// Sine squared of an edge, volume of a vertex' three unit normals; 0: the faces are parallel.
    double openness() const { return size; }
    /// Do the edges end there, as at a vertex?
    bool ends() const { return count == 3; }

private:
    // A part this negative [-] still belongs to the cone: 0.3 degrees beyond it where the faces are
    // square, more than the rounding of normals stored as floats. With 3 degrees overlaps of 3 to
    // 6 mm remained in the bench scenes (docs/design-notes.md); with 0 flush faces lose contacts.
    static constexpr double kBelongs = -0.005;

    // n . part[k] is n's part along normal[k], times `size` (positive); of two faces part[2] is the
    // edge's direction
    std::array<Vec3, 3> part{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    std::array<double, 3> per_length{};  // 1 / |part[k]|
    double size = 0.0;
};

}  // namespace ice
