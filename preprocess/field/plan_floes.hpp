// SPDX-License-Identifier: GPL-3.0-or-later
/// The patterns: from a specification to outlines that do not overlap.
#pragma once

#include "preprocess/field/field_spec.hpp"

namespace ice {

/// Equal rectangles in rows and columns, as sawn in model tests; numbered x fastest. Brick: every
/// other column begins and ends with half a floe, so that both sides of the channel stay straight.
/// @throws Error (exit code 2) when a half floe would have no breadth
FieldPlan plan_grid(const FieldSpec& spec);

/// The channel that an icebreaker leaves: rows of cusps, one behind the other along x.
///
/// Row k ends, towards +x, in arcs of circles over chords of one breaking width that lie on
///
///     x = x0 + k l + (B / 2 - |y|) cot(a),    l breaking length, B breadth, a entrance angle
///
/// and begins where row k - 1 ends; its floes lie between the ends of its arcs. Even rows have
/// whole cusps, odd rows half ones at both sides; all inner ends are moved by up to jitter x half a
/// width, by seed, row and cusp alone.
FieldPlan plan_cusps(const FieldSpec& spec);

/// Cells of a power diagram, each shrunk about its centroid, so that none overlap.
///
/// Voronoi: as many random sites as give the mean size, relaxed (Lloyd). Power-law: as many floes
/// as the concentration takes, one drawn from each of that many equal parts of N(> d) ~ d^-a
/// between smallest and largest; then the sites' weights are solved for so that every cell has its
/// floe's share of the field (semi-discrete optimal transport: Kitagawa, Merigot, Thibert, J. Eur.
/// Math. Soc. 21, 2019): sizes are met to rounding, whatever the concentration.
///
/// @throws Error (exit code 2) when the field is too small for a floe or has over a million
FieldPlan plan_cells(const FieldSpec& spec);

/// Floes from a file: GeoJSON polygons, or CSV rows floe, x, y (a header and # comments are passed
/// over). Units times `scale`, moved by `origin`.
///
/// @param warnings  parts left out: holes
/// @throws Error (exit code 2) naming the floe: fewer than three corners, crossing itself, or lying
///         over another one by more than a thousandth of its size; or a file that is none of these
FieldPlan plan_polygons(const FieldSpec& spec, std::vector<std::string>& warnings);

/// Unbroken ice: equal rectangles along both sides of the field, the side at low y first, and then
/// across its far end from side to side, unless edges.ahead is 0. The pieces touch each other and
/// overlap nowhere; the sides go on to the end of the ice ahead at least, so that nothing leaves
/// through a corner. Behind a row that is no straight line (cusps with an entrance angle) water
/// stays between it and the end.
void add_edges(const FieldSpec& spec, FieldPlan& plan);

}  // namespace ice
