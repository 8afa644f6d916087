// SPDX-License-Identifier: GPL-3.0-or-later
/// `pieces.h5`: the pieces into which level ice broke during a run, beside run.h5.
///
/// The bodies of run.h5 are slots then: each represents several pieces, one after the other. Layout
/// (K rows of a group; /pieces: floes by number, /rest: the remaining sheet at the end, /sheet: its
/// other parts, so that /rest and /sheet are the sheet at the start):
///
///     / format, format_version, first_body, piece_group, rest_group
///     /drift [3] m/s            of all the ice: a piece in the sheet is at `at` + drift times time
///     /pieces/number, body [K]  born, gone [K] s (gone: inf while it is there)
///     /pieces/load [K] N, radius [K] m   that broke it off, of its crack
///     /sheet/gone [K] s                 when this part broke off or was crushed
///     and in all groups: at [K,3] m  centre of mass as it lay   mass [K] kg
///     vertex_offset [K+1], vertices [V,3] m about that centre, triangle_offset [K+1], triangles
#pragma once

#include <filesystem>
#include <vector>

#include "common/formats/run_file.hpp"

namespace ice {

constexpr const char* kPiecesName = "pieces.h5";

/// A piece of level ice. Of the rest only the first three members count, of other parts of the
/// sheet `gone`, too.
struct PieceRow {
    TriangleMesh mesh;  ///< about the centre of mass, axes of the world as it lay [m]
    Vec3 at;            ///< centre of mass as it lay, less the drift until then [m]
    double mass;        ///< [kg]
    std::int32_t number = 0, body = 0;  ///< floe's number; id of the slot, from 1
    double born = 0.0, gone = 0.0;      ///< [s]
    double load = 0.0;                  ///< downwards, that broke it off [N]
    double radius = 0.0;                ///< of its crack [m]
};

/// All pieces of a run, by number.
struct PiecesFile {
    std::int32_t first_body = 0;                   ///< id of the first slot
    std::int32_t piece_group = 0, rest_group = 0;  ///< rows of the case's groups
    Vec3 drift = Vec3::Zero();                     ///< [m/s]
    std::vector<PieceRow> pieces, rest;
    std::vector<PieceRow> sheet;  ///< none in files of before
};

/// @throws Error (exit code 1) naming the file when it cannot be written
void write_pieces(const std::filesystem::path& path, const PiecesFile& pieces);

/// @throws Error (exit code 2) naming file and dataset
PiecesFile read_pieces(const std::filesystem::path& path);

/// Puts pieces, rest and other parts of the sheet in the place of the slots, as floes of the run.
///
/// Parts of the sheet are there, held, until they are gone, and pieces from then on: before, they
/// are FloeState::absent, in files without /sheet held in its place. After it was taken out of the
/// scene, a piece drifts on from where it was last seen, behind. The header gets the sheet's group,
/// time and load of the break. Hull contacts with the sheet's edge go to the first row of the rest.
void show_pieces(const PiecesFile& file, RunData& run);

}  // namespace ice
