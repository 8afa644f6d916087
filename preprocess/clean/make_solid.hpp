// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "preprocess/clean/choose_shells.hpp"

namespace ice {

struct SolidOptions {
    SolidKind kind = SolidKind::envelope;
    bool strict = false;  ///< refuse surfaces that face inwards instead of turning them over
};

/// What make_solid() did to the mesh: step and count, steps that did nothing left out.
using Repairs = std::vector<std::pair<std::string, std::int64_t>>;

/// Triangles as read -> the closed, outward surface of one solid: weld, check, choose shells.
///
/// @param name     of the file, for messages
/// @param repairs  steps are appended; nothing is changed that is not counted there, but for equal
///                 vertices becoming one
/// @throws Error (exit code 2) naming every fault with its count and the place of the first: open
///         edges, edges of three or more triangles, triangles facing opposite ways, triangles that
///         cross, surfaces inside out (strict only), no volume
TriangleMesh make_solid(TriangleMesh mesh, const std::string& name, const SolidOptions& options,
                        Repairs& repairs);

}  // namespace ice
