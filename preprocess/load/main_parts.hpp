// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Least extent of a part over its diagonal [-] up to which it is a flat sheet: far above rounding,
/// far below the thickness of a plate. A larger value takes plates for sheets, a smaller one sheets
/// and boxes with rounded corners for bodies.
constexpr double kFlatSheet = 1e-6;

/// The part of a mesh from which units and axes are guessed: the largest part and its surroundings.
///
/// Parts are triangles that share corners (equal coordinates). Left out are parts farther from the
/// largest than its own length (a stray triangle, an island), boxes around another part (a flow
/// solver's domain) and flat sheets that reach beyond the rest (a sea plane). The largest part is
/// that with the most surface, boxes and flat sheets apart.
///
/// @param left_out  takes how many parts these are
/// @return the mesh without them; nothing where none is left out
std::optional<TriangleMesh> main_parts(const TriangleMesh& mesh, std::int64_t& left_out);

}  // namespace ice
