// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/live_edge/edge_record.hpp"

#include "preprocess/field/make_prism.hpp"
#include "preprocess/field/polygon_checks.hpp"

namespace ice {

namespace {

PieceRow row_of(const LiveEdge& edge, const Loop& outline) {
    // a prism about its own centroid, afloat: where it was when the crack opened
    const Vec2 centre = centroid_of(outline);
    Loop centred;
    for (const Vec2& p : outline) centred.push_back(p - centre);
    PieceRow row;
    row.mesh = make_prism(centred, edge.thickness(), 0.0);
    row.at = Vec3(centre.x(), centre.y(), edge.height());
    row.mass = edge.density() * edge.thickness() * area_of(outline);
    return row;
}

}  // namespace

PiecesFile record_edge(const LiveEdge& edge) {
    PiecesFile out;
    out.drift = Vec3(edge.drift().x(), edge.drift().y(), 0.0);
    out.first_body = static_cast<std::int32_t>(edge.first_body());
    out.piece_group = edge.piece_group();
    out.rest_group = edge.tile_group();
    for (const IcePiece& piece : edge.pieces()) {
        // The outline is in the ice's axes, as the crack cut it: the pose in later frames is that
        // of the piece's body in run.h5.
        PieceRow row = row_of(edge, piece.outline);
        row.number = static_cast<std::int32_t>(piece.number);
        row.body = piece.body;
        row.born = piece.born;
        row.gone = piece.gone;
        row.load = piece.load;
        row.radius = piece.radius;
        out.pieces.push_back(std::move(row));
    }
    // The sheet is for pictures: no outline of it may end a run.
    for (const Loop& loop : edge.rest())
        if (is_simple(loop)) out.rest.push_back(row_of(edge, loop));
    for (const IcePiece& part : edge.lost()) {
        // where the hull was at the start there never was ice
        if (part.gone < 0.0 || !is_simple(part.outline)) continue;
        out.sheet.push_back(row_of(edge, part.outline));
        out.sheet.back().gone = part.gone;
    }
    return out;
}

}  // namespace ice
