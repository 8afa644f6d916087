// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "solver/scene/bodies.hpp"
#include "solver/shape/shape.hpp"

namespace ice {

/// How a point inside a solid comes out of its ice; body axes.
struct WayOut {
    std::int32_t sphere;  ///< which represents the ice there
    double depth;         ///< [m]; negative where that ice has been crushed already
    Vec3 outward;         ///< unit
    Vec3 foot;            ///< where the ice ends: of whole ice its mesh, of a notch its bottom [m]
};

/// The shortest way out of a solid that may have notches.
///
/// It leads to the nearest point of the mesh, less the depth to which the sphere there has been
/// crushed against it, or to the bottom of a notch where that is nearer. A crushed sphere has taken
/// the surface within its patch radius along with it; the point is in reach of that notch where it
/// lies beside the sphere's path by no more.
/// @param point  inside the solid of the body [m]
/// @param foot   of the point on the mesh, at a distance above 0
WayOut way_out(const Scene& scene, std::int32_t body, const Vec3& point, const Foot& foot);

/// Is the seat of a surface sphere gone with the ice around it? True where the sphere itself was
/// not crushed and its seat lies in the notch of another sphere of its body.
bool lies_in_notch(const Scene& scene, std::int32_t body, std::int32_t sphere);

}  // namespace ice
