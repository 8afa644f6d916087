// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "preprocess/repair/judge_caps.hpp"
#include "preprocess/repair/make_solid.hpp"

namespace ice {

/// A surface without boundary, and the caps that it took.
struct ClosedSurface {
    TriangleMesh mesh;             ///< each edge has two triangles that agree; parts face outwards
    TriangleMesh open;             ///< the surface without its caps
    TriangleMesh unsure;           ///< the surface without the caps that are a guess
    std::vector<CapVerdict> caps;  ///< one per opening
    double surface = 0.0;          ///< area without caps [m2]
    double widest = 0.0;           ///< of caps that are a guess: 4 area / perimeter [m]
    double volume = 0.0;           ///< of all parts [m3]
    double doubt = 0.0;            ///< volume that depends on the caps, over the whole [-]
};

/// Welded triangles -> a surface without boundary: copies and walls without thickness dropped, an
/// open half hull mirrored, faces turned to agree, openings capped, sheets separated, parts turned
/// outwards, scraps without volume dropped. Its repairs are appended to `repairs`; the caps are
/// judged but not refused here.
ClosedSurface close_surface(TriangleMesh mesh, const SolidOptions& options, Repairs& repairs);

/// Turns over the parts whose volume is negative. @return parts turned. @pre closed
std::int64_t turn_parts_outward(TriangleMesh& mesh);

}  // namespace ice
