// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "preprocess/fill/lattice_frame.hpp"

namespace ice {

/// One bit per lattice point, row after row (LatticeFrame::row), LatticeFrame::words() words each,
/// the lowest bit of a word first; bits past the end of a row are 0.
using LatticeBits = std::vector<std::uint64_t>;

/// The lattice points about which the surface winds, right but for points on the surface itself.
///
/// Scan conversion: each triangle is cut by the heights of the rows, the cut by the rows; between
/// the signed crossings of a row the winding number is constant. Intervals are half open along z
/// and along y, and the cut of an edge is computed from its ends in one order, so that both of its
/// triangles get the same bits: a row that grazes an edge meets exactly one of them, and the signs
/// along a row add up to zero. No exact arithmetic is needed, because a
/// rounded crossing is off by a few units in the last place and so can misplace only points that
/// near the surface, which clear_near() takes away.
///
/// @pre each edge occurs equally often in both directions (closed); shells may overlap (winding
///      number other than 0) and vertices need not be shared
/// Same bits for any thread count. Cost O(triangles + rows + crossings + words).
LatticeBits rows_inside(const TriangleMesh& mesh, const LatticeFrame& frame);

}  // namespace ice
