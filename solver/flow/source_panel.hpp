// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangles that give off water evenly: docs/method.md, section 6.
#pragma once

#include <array>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// From this many radii on [-] a panel is a point source, which differs from the triangle by less
/// than 1 % of its own velocity there; that is itself small. Fewer are faster and less exact; more
/// cost the logarithms and the angle for panels that hardly count.
constexpr double kFarRadii = 6.0;

/// A source panel, prepared for many points.
struct SourcePanel {
    std::array<Vec3, 3> corner;    ///< counter-clockwise seen from the water [m]
    std::array<Vec3, 3> outward;   ///< unit, in the plane, away from edge k (corner k to k + 1)
    std::array<double, 3> length;  ///< of the edges [m]
    Vec3 normal;                   ///< unit, into the water
    Vec3 centre;                   ///< centroid [m]
    double area;                   ///< [m2]
    double far_squared;            ///< of kFarRadii: from there on it is a point source [m2]
};

/// Prepares a triangle. @param a, b, c  corners, counter-clockwise seen from the water [m]
/// @pre the triangle has an area
SourcePanel make_panel(const Vec3& a, const Vec3& b, const Vec3& c);

/// Strength of images in z = 0, as a share of the panel's own [-]: a flat surface that nothing
/// passes (slow motions), one that is free (potential 0, fast motions), and no surface (deep
/// water). Other values have no meaning.
constexpr double kLid = 1.0, kFreeSurface = -1.0, kDeep = 0.0;

/// Panels and their mirror images: in the water's surface z = 0, and where the body is symmetric
/// also in y = 0.
struct PanelBody {
    std::vector<SourcePanel> panels;  ///< z <= 0 but for kDeep, of a symmetric body also y >= 0
    bool symmetric = false;
    double image = kLid;  ///< strength of the images in z = 0, as a share of the panels' own [-]
};

/// A step off the panels into the water, in their size [-]: there the panel's own share of the
/// normal velocity has its outer limit 1/2 (to 1e-6), without a case of its own in the kernel. A
/// larger step takes that much off the limit; a smaller one comes near the rounding of the place.
constexpr double kOffPanel = 1e-6;

/// Three points [m], in barycentric coordinates (2/3, 1/6, 1/6), off the panel by kOffPanel. The
/// mean over these three points equals the mean over the panel for quadratic functions.
std::array<Vec3, 3> flux_points(const SourcePanel& panel);

/// Where the flow can be checked: three other points [m], (1/2, 1/4, 1/4).
std::array<Vec3, 3> check_points(const SourcePanel& panel);

}  // namespace ice
