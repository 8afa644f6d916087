// SPDX-License-Identifier: GPL-3.0-or-later
/// Contact manifold of two bodies in convex parts: the polygons in which the parts meet.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "solver/narrow/feature/contact_polygon.hpp"
#include "solver/shape/solid_part.hpp"

namespace ice {

/// A corner of a polygon in which two bodies meet.
struct MetCorner {
    PolygonCorner corner;
    Vec3 normal;  ///< of its polygon: unit, from a to b, a's axes
    /// Its share of the section on which the bodies press [m2]; infinite where no ice is crushed.
    double section = std::numeric_limits<double>::infinity();
    bool crushes_a = false;  ///< the ice that is crushed is a's; else b's
};

/// Two overlapping parts without a corner.
struct LostParts {
    const SolidPart *a, *b;
    SeparatingAxes axes;   ///< without the cuts
    std::uint64_t number;  ///< of the pair of parts
};

/// Work memory of find_part_polygons, which keeps its capacity between pairs.
struct PartsWork {
    ClippingWork clipping;
    ContactPolygon polygon;          ///< of two parts, then of all with one normal
    std::vector<MetCorner> corners;  ///< of all parts
    std::vector<LostParts> lost;     ///< overlapping parts without a corner
};

/// Finds the corners of the polygons in which two bodies meet. Each convex part of a meets each
/// part of b (make_contact_polygon). Corners with a gap of more than `most` [m] are left out. At
/// most four corners with the same normal are kept.
///
/// At a hollow corner two edges may cross beyond the end of one of them. That end is then a corner
/// if the parts overlap deeper than all others. Corners deeper than `most` count only if the parts,
/// with their cuts as planes, overlap by half that depth; else the neighbouring part has them.
///
/// Parts that meet in one face of a body carry no more than the whole face does; a cut between two
/// parts has no corners. Bodies without parts have none.
/// Where cuts lie decides which corners there are: mirror images may have others.
/// @param pose  of b in a's axes
/// @param out   appended to, by place
void find_part_polygons(std::span<const SolidPart> a, std::span<const SolidPart> b,
                        const RelativePose& pose, double most, PartsWork& work,
                        std::vector<MetCorner>& out);

}  // namespace ice
