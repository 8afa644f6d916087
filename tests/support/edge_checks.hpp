// SPDX-License-Identifier: GPL-3.0-or-later
/// Loads on the edge of level ice without a run, and what must hold after each.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "solver/live_edge/live_edge.hpp"

namespace ice::test {

inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Do two edges cross, other than at their ends?
inline bool cross_inside(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    const double tiny = 1e-6;  // [m2]: rounding puts corners beside edges by 1 nm
    const double c_side = cross(b - a, c - a), d_side = cross(b - a, d - a);
    const double a_side = cross(d - c, a - c), b_side = cross(d - c, b - c);
    return std::min(c_side, d_side) < -tiny && std::max(c_side, d_side) > tiny &&
           std::min(a_side, b_side) < -tiny && std::max(a_side, b_side) > tiny;
}

/// Tells whether the edges of the loops are free of crossings.
inline bool is_simple(const std::vector<Loop>& loops) {
    std::vector<std::pair<Vec2, Vec2>> edges;
    for (const Loop& loop : loops)
        for (std::size_t k = 0; k < loop.size(); ++k)
            edges.emplace_back(loop[k], loop[(k + 1) % loop.size()]);
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t j = i + 1; j < edges.size(); ++j)
            if (cross_inside(edges[i].first, edges[i].second, edges[j].first, edges[j].second))
                return false;
    return true;
}

/// Level ice 0.3 m thick and weak, so that small loads break it.
inline void lay_weak_ice(Case& p, const std::array<double, 4>& extent, double spacing) {
    p.level_ice.thickness = 0.3;
    p.level_ice.extent = extent;
    p.level_ice.spacing = spacing;
    p.level_ice.gap = 0.02;
    p.bending.elastic_modulus = 3.7e8;
    p.bending.flexural_strength = 3e5;
}

/// The tiles of an edge.
inline std::vector<std::int32_t> tiles_of(const LiveEdge& edge, const Bodies& b) {
    std::vector<std::int32_t> tiles;
    for (std::size_t i = edge.first_body(); i < b.size(); ++i)
        if (b.is_unbent(i)) tiles.push_back(static_cast<std::int32_t>(i));
    return tiles;
}

/// A load that no ice bears, on a corner of a tile, in the level direction `turn` [rad]: what
/// find() makes of the contact and its impulse.
inline void press_edge(LiveEdge& edge, const Scene& scene, const Case& parameters,
                       std::int32_t tile, std::size_t corner, double turn) {
    const Bodies& b = scene.bodies;
    const auto i = static_cast<std::size_t>(tile);
    const auto& corners = scene.shapes[static_cast<std::size_t>(b.shape[i])].mesh.vertices;
    Contact contact{};
    contact.a = 0;
    contact.b = tile;
    contact.point = b.position[i] + corners[corner % corners.size()];
    Constraint load{};
    load.a = 0;
    load.b = tile;
    load.normal = Vec3(std::cos(turn), std::sin(turn), -0.5).normalized();
    load.approach = -0.5;
    load.arm_a = load.arm_b = Vec3::Zero();
    contact.normal = load.normal;
    load.impact_normal = 1e9;
    edge.find(parameters, {contact}, {load});
}

inline double sum_of(const IceAreas& a) {
    return a.sheet + a.pieces + a.crushed + a.brash + a.astern;
}

/// The first fault of an edge whose sheet had the area `whole` [m2]; "" for a valid edge. Pieces
/// below number `seen` are taken as checked.
/// @param crossings  look for crossings in the sheet, which takes the square of its corners
inline std::string edge_fault(const LiveEdge& edge, double whole, std::size_t seen,
                              bool crossings) {
    const IceAreas areas = edge.areas();
    if (!(std::abs(sum_of(areas) - whole) <= 1e-9 * whole)) return "area is lost or made";
    if (std::min({areas.sheet, areas.pieces, areas.crushed, areas.brash, areas.astern}) < -1e-9)
        return "an area is negative";
    for (const Loop& loop : edge.sheet().loops())
        if (loop.size() < 3) return "a loop of the sheet has less than three corners";
    if (crossings && !is_simple(edge.sheet().loops())) return "the sheet's edges cross";
    const double least = 0.5 * edge.thickness();
    const std::vector<IcePiece> pieces = edge.pieces();
    for (; seen < pieces.size(); ++seen) {
        const Loop& outline = pieces[seen].outline;
        if (!(area_of(outline) >= least * least)) return "a piece is too small";
        if (!is_simple({outline})) return "a piece's edges cross";
        if (common_part(outline, outline).size() != 1) return "a piece is not one";
        if (!(edge.sheet().area_in(outline) <= 1e-6)) return "a piece lies in the sheet";
    }
    return "";
}

}  // namespace ice::test
