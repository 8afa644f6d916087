// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// The axes of a mesh that looks like a hull, by its extents and its one plane of symmetry.
struct HullAxes {
    int length = 0;      ///< longest extent
    int breadth = 1;     ///< normal of the centre plane
    int vertical = 2;    ///< the one that is left
    bool prism = false;  ///< every face lies along the breadth or square to it
};

/// True where every face, but for 1 % of the surface, lies along an axis or square to it (to 1
/// degree).
bool is_prism(const TriangleMesh& mesh, int axis);

/// Nothing when the longest extent is less than 1.5 times the next, when no plane along it is one
/// of symmetry, both are, or one may be (kSymmetric, kLopsided). Cost O(T).
std::optional<HullAxes> find_hull_axes(const TriangleMesh& mesh);

/// Breadth of the sections near the lower end of the length over that near the upper end [-]: the
/// mean over stations at 2, 5, 8, 11 and 14 % of the length from each. Below 1 the lower end is
/// finer. 1 where nothing is cut.
double fineness_ratio(const TriangleMesh& mesh, const HullAxes& axes);

/// The same of the sections at 0.5 % of the length from each end: a stem against a transom.
double tip_ratio(const TriangleMesh& mesh, const HullAxes& axes);

/// Whether a hull seems to be upside down. Length times breadth of its level sections falls by 1 %
/// or more from each to the next at 10, 30, 50, 70 and 90 % of the depth, counted from the lower
/// end of `vertical` (the upper one where `upwards` is false), and by more than a tenth in all. Of
/// an upright hull they grow up to the deck, whatever is built on it; those of a box or a pontoon
/// with a house on it are equal below. An upside-down hull with vertical sides at the deck is not
/// seen.
bool narrows_upwards(const TriangleMesh& mesh, const HullAxes& axes, bool upwards);

}  // namespace ice
