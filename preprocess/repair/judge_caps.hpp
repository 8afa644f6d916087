// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "preprocess/repair/cap_openings.hpp"

namespace ice {

/// Volume that may depend on how openings are closed, over the whole [-]: all caps together. Larger
/// accepts solids of uncertain mass, smaller refuses hulls with many small openings.
inline constexpr double kMostDoubt = 0.02;

/// Kinds of caps.
enum class CapKind {
    small,      ///< whatever its shape, the volume does not depend on it
    continued,  ///< flat, in the plane of a face next to it
    hidden,     ///< inside another part
    deck,       ///< faces up and closes the top of its part from side to side
    guess,      ///< none of these: refused
};

/// A cap for the report.
struct CapVerdict {
    CapKind kind = CapKind::small;
    Vec3 at = Vec3::Zero();  ///< its middle [m]
    double area = 0.0;       ///< [m2]
    double doubt = 0.0;      ///< volume that depends on the guess [m3]
};

/// Decides whether each cap is accepted.
///
/// A cap of area A and perimeter P, at whose rim the surface turns by the angle a, leaves a
/// doubt of A (2 A / P) tan(a) / 2 in the volume: the wedge or cone that continues straight from
/// its rim has half to two thirds of that, the lens of a sphere less. Triangles that go on in
/// the plane of a neighbour leave none. Caps are accepted while none leaves more than 0.5 % of the
/// volume in doubt, and all together not more than kMostDoubt. Beyond that a cap is accepted where
/// other parts cover it (a superstructure without a bottom, standing in the deck), or as a deck: it
/// faces up, the walls at its rim are upright (they lean inwards by less than 17 degrees, outwards
/// by less than 37), its edge has no steps, it reaches over 60 % of the length and the breadth of
/// its part, and nothing of the part is above it. However small, a cap of guessed shape may not
/// make an end of the solid's length if it is more than 0.05 % of the surface and has more than
/// eight edges: a stem may be missing there.
///
/// @param mesh    closed by `caps`, each part facing outwards
/// @param suspect the file seems cut off: no cap of more than 0.5 % of the surface is accepted
std::vector<CapVerdict> judge_caps(const TriangleMesh& mesh, const std::vector<Cap>& caps,
                                   bool suspect);

}  // namespace ice
