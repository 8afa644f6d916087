// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "preprocess/repair/choose_shells.hpp"

namespace ice {

/// How far make_solid() may go.
enum class RepairMode {
    automatic,  ///< up the ladder, the first rung whose result passes all tests
    strict,     ///< closed, outward and free of crossings as it is, or refused
    wrap,       ///< shrink-wrap, whatever the mesh is
};

/// How make_solid() repairs.
struct SolidOptions {
    SolidKind kind = SolidKind::envelope;
    RepairMode mode = RepairMode::automatic;
    double radius = 0.0;  ///< of the spheres to come [m]: a contour's cells are no larger; 0: L/200
    std::string suspect;  ///< why the file seems cut off; empty: it does not
};

/// Repairs of make_solid(): step and count, steps without repairs left out.
using Repairs = std::vector<std::pair<std::string, std::int64_t>>;

/// Triangles as read -> the closed, outward surface of one solid.
///
/// The ladder: closed as it is; cracks stitched; a half hull mirrored; faces turned to agree,
/// openings capped, parts turned outwards; crossings resolved where they are (resolve_crossings);
/// contoured from the winding number; shrink-wrapped. A rung is left for the next when its result
/// does not verify (verify_solid, three axes), or, where caps matter, when the winding number of
/// the open surface gives another volume. A cap that would invent a shape is no rung at all: the
/// mesh is refused (judge_caps).
///
/// @param name     of the file, for messages
/// @param repairs  steps are appended; nothing is changed that is not counted there, but for equal
///                 vertices becoming one
/// @param warnings where given, receives doubtful places, with place and size
/// @throws Error (exit code 2) naming every fault with its count and the place of the first, or the
///         opening that is too large to guess; and the remedy
TriangleMesh make_solid(TriangleMesh mesh, const std::string& name, const SolidOptions& options,
                        Repairs& repairs, std::vector<std::string>* warnings = nullptr);

}  // namespace ice
