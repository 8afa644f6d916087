// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/narrow/feature/contact_polygon.hpp"

namespace ice {

/// What meets the face in a corner.
enum class Met : std::uint32_t { incident_corner, reference_corner, edge_over_side };

/// Of a corner that append_face_corners gave. Corners of other origin have any value.
inline Met kind_of_corner(const PolygonCorner& c) { return static_cast<Met>(c.id >> 22 & 3u); }

/// Appends the corners in which a convex piece, the incident one, meets a face of another, the
/// reference: its corners over the face, its edges where they cross a side plane of the face, and
/// the places where lines along the normal through the face's own corners enter it. Its surface
/// that is turned away from the face has none.
///
/// One face of the incident piece is not enough where crushing has rounded it: the face at its
/// deepest corner changes from step to step, the contacts with it, and the piece rocks deeper and
/// deeper.
///
/// Of a corner the point is midway between the surfaces, and the gap is along the face's normal;
/// those with a gap of more than `most` are left out. Mirror images have the same bits.
/// @param pose   of the incident piece in the reference's axes; places are in these axes
/// @param slack  the face counts as larger by this much on all sides [m]
/// @param kind   first two bits of the corners' ids
void append_face_corners(const ConvexPiece& reference, std::size_t face,
                         const ConvexPiece& incident, const RelativePose& pose, double slack,
                         double most, std::uint32_t kind, FaceCornersWork& work,
                         std::vector<PolygonCorner>& out);

}  // namespace ice
