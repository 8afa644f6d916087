// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/formats/load_statistics.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Edge of the hull's panels [m]: the ice's thickness, over whose height a floe can press, but at
/// least two spacings of the hull's spheres, which resolve no finer load.
/// The thickness is the least edge of the box around a floe's mesh (2D: across y it does not
/// count), of the thickest floe.
double panel_size(const Scene& scene);

/// Divides the hull's surface spheres into panels of edge `size`.
///
/// The grid lies in the plane that a sphere's normal is most perpendicular to (x-z for a side, y-z
/// for a front, x-y for a bottom), separately for each direction and region. Rows are centred on
/// the waterline and on the centre line, columns begin at the bow. A panel's area is the sum of its
/// spheres' shares of the surface, its length along the waterline that area, projected on the
/// vertical (a bottom: on the horizontal) over `size`. A panel that the hull's edges cut to less
/// than half of size^2 joins the nearest larger panel of its region that faces within 60 degrees
/// and has its centre within 2 sizes; where there is none it counts as half a panel. In 2D a panel
/// is a piece of the section and its length the metre of breadth.
/// @param size      edge of a panel [m] (panel_size)
/// @param waterline height of the water in the ship frame [m]
/// Loads are zero; of a hull without spheres or a size of 0 no panels are made.
HullPanels divide_hull(const Shape& hull, double size, double waterline);

}  // namespace ice
