// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/formats/spheres_report.hpp"
#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Measures how far the solid that was filled lies from the mesh that was read, both ways, on the
/// whole surface and within report.belt: sets report.source and the belt's distances.
///
/// Triangles that both have, corner for corner and bit for bit, are at distance zero; all others
/// are cut into samples and the nearest point of the other surface is found. Of the source
/// only its outside counts: a place more than a radius inside the solid bounds nothing of it (a
/// deck below, a second skin). Of the solid a triangle between vertices of the source that lies
/// over none of its faces is a cap: it closes an opening, and its area is reported apart.
///
/// Parts of the source that were left out on purpose do not count, and their area is reported: open
/// sheets away from the solid (a sea plane, a stray triangle), and parts around it (the box of a
/// flow solver's domain). The search for a distance to a part goes no farther than the part's own
/// distance.
///
/// Cost O(T log T); a sample for each triangle that was changed, and four hundred thousand more at
/// most. Bits do not depend on the number of threads.
///
/// @param source  as read, in metres and ship axes; not welded
/// @param solid   closed and outward
/// @param radius  of the spheres [m]
void compare_with_source(const TriangleMesh& source, const TriangleMesh& solid, double radius,
                         SpheresReport& report);

}  // namespace ice
