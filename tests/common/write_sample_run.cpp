// SPDX-License-Identifier: GPL-3.0-or-later
// write_sample_run FILE [--killed | --summary | --pieces]: writes a made-up run for open_run.py.
// --killed leaves FILE.part; --summary writes a summary.json, too, of numbers wide on a page;
// --pieces a pieces.h5, in which the last two floes are pieces of level ice.
#include <filesystem>
#include <string>

#include "common/base/part_file.hpp"
#include "common/formats/pieces_file.hpp"
#include "common/formats/summary_file.hpp"
#include "tests/common/fixtures.hpp"

namespace {

ice::Summary make_summary(const ice::RunData& run) {
    ice::Summary s;
    s.title = run.header.title;
    s.steps = 450;
    s.simulated_s = 4.5;
    s.wall_s = 0.9;
    s.floes_total = 6;
    s.floes_moved = 5;
    s.average_from = 1.5;
    s.resistance = {4078.25, 3006.5, 1071.75, 14300.0, 965000.0, 2500.5};
    s.lateral = {-300.0, -200.0, -100.0, 3600.0, 55000.0, 400.0};
    s.vertical = {44100.0, 40200.0, 3900.0, 700.0, 48000.0, 200.0};
    for (const char* region : {"bow", "side", "bottom"})
        s.regions[region] = {37, 8.25, {-777.0, 5.0, 333.0}, {-700.0, 4.0, 300.0}, {-77, 1, 33}};
    s.energy = {{"ship_work_J", 8400.0}, {"drag_J", 1470.0}, {"residual_J", -6.0}};
    s.lindqvist_submersion = 1421.0;
    s.warnings = {{.text = "a made-up warning with a_word_too_long_for_any_telephone_screen"}};
    return s;
}

// The last two floes get shapes of their own, as slots have.
ice::PiecesFile make_pieces(ice::RunData& run) {
    ice::PiecesFile file;
    file.first_body = 5;
    file.piece_group = 1;
    file.rest_group = 2;
    for (std::size_t k = 0; k < 2; ++k) {
        run.header.shapes.push_back(run.header.shapes[1]);
        run.header.body_shape[4 + k] = static_cast<std::int32_t>(2 + k);
        ice::PieceRow row{run.header.shapes[1].mesh, run.frames[0].position[4 + k], 144.0};
        row.number = static_cast<std::int32_t>(k) + 1;
        row.body = static_cast<std::int32_t>(5 + k);
        row.born = 1.0 + static_cast<double>(k);
        row.gone = 100.0;
        row.load = 1e4 + 1e4 * static_cast<double>(k);
        file.pieces.push_back(row);
    }
    file.sheet = file.pieces;
    for (ice::PieceRow& part : file.sheet) part.gone = part.born;
    file.rest = {{run.header.shapes[1].mesh, ice::Vec3(13.0, 0.0, -0.08), 144.0}};
    return file;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) return 2;
    ice::RunData run = ice::test::make_run();
    const std::string option = argc > 2 ? argv[2] : "";
    if (option == "--killed") {
        ice::RunWriter writer(argv[1], run.header);
        ice::test::add_frames(writer, run, 45);
        _exit(0);
    }
    const std::filesystem::path folder = std::filesystem::path(argv[1]).parent_path();
    if (option == "--pieces") ice::write_pieces(folder / ice::kPiecesName, make_pieces(run));
    ice::test::write_run(argv[1], run);
    if (option == "--summary")
        ice::write_text_file(folder / "summary.json", ice::summary_text(make_summary(run)));
    return 0;
}
