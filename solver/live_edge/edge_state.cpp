// SPDX-License-Identifier: GPL-3.0-or-later
// All state of the edge. carry() writes a field or sets it, by the file's direction.
#include <string>
#include <utility>

#include "common/formats/checkpoint_file.hpp"
#include "solver/live_edge/live_edge.hpp"

namespace ice {

namespace {

// Loops one after the other: how many corners each has, and all corners (z = 0).
void carry_loops(CheckpointFile& file, const std::string& name, std::vector<Loop>& loops) {
    std::vector<std::int64_t> counts;
    std::vector<Vec3> corners;
    for (const Loop& loop : loops) {
        counts.push_back(static_cast<std::int64_t>(loop.size()));
        for (const Vec2& p : loop) corners.emplace_back(p.x(), p.y(), 0.0);
    }
    file.carry(name + ".counts", counts);
    file.carry(name + ".corners", corners);
    loops.assign(counts.size(), {});
    std::size_t next = 0;
    for (std::size_t k = 0; k < counts.size(); ++k)
        for (std::int64_t n = 0; n < counts[k] && next < corners.size(); ++n)
            loops[k].push_back(corners[next++].head<2>());
}

// A checkpoint has vectors of three: z is 0, and is dropped again.
void carry_point(CheckpointFile& file, const std::string& name, Vec2& p) {
    Vec3 point(p.x(), p.y(), 0.0);
    file.carry(name, point);
    p = point.head<2>();
}

// A member of every row of a table, as a point. The rows are there before, in both directions.
template <class Row>
void carry_points(CheckpointFile& file, const std::string& name, std::vector<Row>& rows,
                  Vec2 Row::*member) {
    std::vector<Vec3> points;
    for (const Row& row : rows) points.emplace_back((row.*member).x(), (row.*member).y(), 0.0);
    file.carry_each(name, points);
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k].*member = points[k].template head<2>();
}

template <class Row>
void carry_outlines(CheckpointFile& file, const std::string& name, std::vector<Row>& rows) {
    std::vector<Loop> loops;
    for (const Row& row : rows) loops.push_back(row.outline);
    carry_loops(file, name, loops);
    loops.resize(rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k].outline = std::move(loops[k]);
}

}  // namespace

void LiveEdge::carry_pieces(CheckpointFile& file) {
    // Pieces that are gone lie in a file of their own: both kinds go through the checkpoint,
    // and reading sets them as if all were still there.
    std::vector<IcePiece> all = pieces(), parts = lost();
    all.insert(all.end(), parts.begin(), parts.end());
    if (file.reading()) all.clear();
    file.column("edge.piece_number", all, &IcePiece::number);
    file.column("edge.piece_body", all, &IcePiece::body);
    file.column("edge.piece_born", all, &IcePiece::born);
    file.column("edge.piece_gone", all, &IcePiece::gone);
    file.column("edge.piece_load", all, &IcePiece::load);
    file.column("edge.piece_radius", all, &IcePiece::radius);
    carry_points(file, "edge.piece_at", all, &IcePiece::at);
    carry_outlines(file, "edge.piece_outline", all);
    if (!file.reading()) return;
    gone_pieces_ = {};
    pieces_.clear();
    lost_.clear();
    for (IcePiece& row : all) (row.number > 0 ? pieces_ : lost_).push_back(std::move(row));
    broken_ = static_cast<std::int64_t>(pieces_.size());
}

void LiveEdge::carry(CheckpointFile& file) {
    if (!has_sheet()) return;
    // the sheet, then the ice of each slot, then the cracks that open with the next step
    std::vector<Loop> sheet = sheet_.loops();
    carry_loops(file, "edge.sheet", sheet);
    sheet_.restore(std::move(sheet));
    std::vector<std::uint8_t> use;
    for (const Slot& slot : slots_) use.push_back(static_cast<std::uint8_t>(slot.use));
    file.carry_each("edge.slot_use", use);
    for (std::size_t k = 0; k < use.size(); ++k) slots_[k].use = static_cast<Use>(use[k]);
    file.column("edge.slot_piece", slots_, &Slot::piece);
    carry_outlines(file, "edge.slot_outline", slots_);
    file.column("edge.crack_radius", cracks_, &Crack::radius);
    file.column("edge.crack_load", cracks_, &Crack::load);
    carry_points(file, "edge.crack_at", cracks_, &Crack::at);
    carry_points(file, "edge.crack_inwards", cracks_, &Crack::inwards);
    carry_pieces(file);
    file.carry("edge.cusp", crack_number_);  // the name that files have had
    file.carry("edge.pieces_area", gone_.pieces);
    file.carry("edge.crushed_area", gone_.crushed);
    file.carry("edge.brash_area", gone_.brash);
    file.carry("edge.astern_area", gone_.astern);
    carry_point(file, "edge.laid_at", laid_at_);
    carry_point(file, "edge.looked_at", looked_at_);
}

}  // namespace ice
