// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "preprocess/field/outline.hpp"

namespace ice {

/// True when no two edges meet but neighbours in their corner (CGAL, exact).
bool is_simple(const Outline& outline);

/// How deep two outlines reach into each other [m]: the largest, over their triangles, of the
/// shortest moves that part two. 0 where they only touch or keep clear.
/// @pre both are simple and anticlockwise
double overlap_depth(const Outline& a, const Outline& b);

}  // namespace ice
