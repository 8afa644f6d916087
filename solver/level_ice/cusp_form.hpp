// SPDX-License-Identifier: GPL-3.0-or-later
/// Size and outline of the piece that breaks off the edge of level ice.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "common/geometry/loop_area.hpp"

namespace ice {

using Vec2 = Eigen::Vector2d;

/// Corners in order, anticlockwise around ice, without repeating the first [m].
using Loop = std::vector<Vec2>;

/// How far from a load the ice cracks.
///
///     R = C_l l (1 + C_v v_n) (1 + scatter u),    u uniform in [-1, 1) by seed and cusp
///
/// with l the characteristic length and v_n the normal speed of hull and ice. Source of form and
/// constants: Wang 2001 as used by Su, Riska, Moan, Cold Regions Science and Technology, 2010;
/// unverified: neither was read.
struct CrackLaw {
    double length_factor = 0.32;   ///< C_l
    double speed_factor = -0.144;  ///< C_v [s/m]
    double scatter = 0.0;          ///< largest relative deviation, 0 to < 1
    std::uint64_t seed = 0;
};

/// R of a law [m], for the cusp of a number; at least a fifth of its value at rest, which the
/// fitted speeds do not go below. @pre length > 0
double crack_size(const CrackLaw& law, double length, double normal_speed, std::uint64_t cusp);

/// The region that a crack cuts out: a half disc about the load, and seawards of its straight side
/// a strip of half a radius, for ice that stands out beside the load.
///
/// @param at       where the load acts [m]
/// @param inwards  unit vector into the ice
/// @return anticlockwise; a corner every 10 degrees of the arc
Loop crack_outline(const Vec2& at, const Vec2& inwards, double radius);

/// Length all around [m].
double length_of(const Loop& loop);

}  // namespace ice
