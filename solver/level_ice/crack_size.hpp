// SPDX-License-Identifier: GPL-3.0-or-later
/// Size and outline of a crack at the edge of level ice.
#pragma once

#include <cstdint>

#include "common/geometry/loop_area.hpp"

namespace ice {

/// How far from a load the ice cracks.
///
///     R = C_l l (1 + C_v v_n) (1 + scatter u),    u uniform in [-1, 1) by seed and crack
///
/// (equation (30)) with l the characteristic length [m] and v_n the normal speed of hull and ice
/// [m/s]. Source of form and constants: Wang 2001 as used by Su, Riska, Moan, Cold Regions Science
/// and Technology, 2010; unverified: neither was read.
struct CrackLaw {
    double length_factor = 0.32;   ///< C_l [-]: more gives larger pieces, and fewer
    double speed_factor = -0.144;  ///< C_v [s/m]: below 0, a faster hull breaks smaller pieces
    double scatter = 0.0;          ///< largest relative deviation [-], 0 to < 1
    std::uint64_t seed = 0;        ///< of u: another seed gives other radii of the same law
};

/// R of a law [m], for the crack of a number. The factor 1 + C_v v_n is at least a fifth, which
/// bounds it above 5.6 m/s with the usual C_v; the scatter comes on top, so R is at least
/// C_l l (1 - scatter) / 5, which is above 0.
/// @param length        characteristic length l [m], > 0
/// @param normal_speed  v_n of hull and ice along the hull's horizontal normal [m/s]
/// @param crack_number  each has its own u, the same on every machine
double crack_size(const CrackLaw& law, double length, double normal_speed,
                  std::uint64_t crack_number);

/// The region that a crack cuts out: a half disc about the load, and seawards of its straight side
/// a strip of half a radius, for ice that stands out beside the load.
///
/// @param at       where the load acts [m]
/// @param inwards  unit vector into the ice
/// @param radius   of the half disc [m], > 0
/// @return anticlockwise, 21 corners: one every 10 degrees of the arc, two of the strip
Loop crack_outline(const Vec2& at, const Vec2& inwards, double radius);

}  // namespace ice
