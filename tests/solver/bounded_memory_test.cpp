// SPDX-License-Identifier: GPL-3.0-or-later
// What a run keeps in memory does not grow with its length, in bytes of the heap.
#include <malloc.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <limits>
#include <random>
#include <vector>

#include "common/base/error.hpp"
#include "solver/live_edge/gone_pieces.hpp"
#include "solver/record/long_series.hpp"
#include "solver/record/window_forces.hpp"
#include "tests/common/fixtures.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// Bytes in use, of all threads; large blocks lie beside the arenas.
double heap() {
    const auto info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
}

// Sanitizers have an allocator of their own, which these counters do not see: then there is nothing
// to measure.
bool is_counted() {
    const double before = heap();
    const std::vector<double> block(1 << 16, 1.0);
    const volatile std::size_t any = 7;  // so that the block is not optimised away
    return heap() - before >= static_cast<double>(sizeof(double) * block.size()) &&
           block[any] == 1.0;
}

void check_growth(double before, double most) {
    const double growth = heap() - before;
    if (is_counted())
        CHECK(growth <= most);
    else
        SUCCEED("the heap is not counted here");
}

IcePiece some_piece(std::int64_t number) {
    const auto x = static_cast<double>(number);
    IcePiece piece{number,
                   static_cast<std::int32_t>(number % 300),
                   0.1 * x,
                   0.3 * x,
                   1e5 / x,
                   4.0 + 1.0 / x,
                   Vec2(2.0 / x, -x),
                   {}};
    for (std::int64_t k = 0; k < 3 + number % 20; ++k)
        piece.outline.emplace_back(1.0 / (x + static_cast<double>(k)),
                                   0.1 * static_cast<double>(k));
    return piece;
}

}  // namespace

TEST_CASE("two million steps of a run take no more memory than 65 536",
          "[record][memory][level_ice]") {
    const double before = heap();
    LongSeries series, most(LongSeries::Join::largest);
    for (int k = 0; k < 2000000; ++k) {
        series.add(k % 17);
        most.add(k % 17);
    }
    CHECK(series.blocks().size() <= LongSeries::kMost);
    // a vector has up to twice the room of what it holds
    check_growth(before, 2.0 * 2.0 * sizeof(double) * LongSeries::kMost + 4096.0);
}

TEST_CASE("the forces of a panel take at most 128 kB", "[record][memory][level_ice]") {
    std::mt19937 random(3);
    std::lognormal_distribution<double> draw(10.0, 2.0);
    const double before = heap();
    WindowForces forces;
    for (int k = 0; k < 300000; ++k) forces.add(draw(random));
    check_growth(before, 128e3);
}

TEST_CASE("pieces that are gone take no memory, and come back as they were",
          "[level_ice][edge][memory]") {
    const TempFolder folder;
    constexpr std::int64_t kPieces = 9000;  // of an hour of cases/level-ice-icebreaker
    GonePieces gone;
    REQUIRE_FALSE(gone.is_open());
    const auto run = folder / "run";
    std::filesystem::create_directories(run);
    gone.open(run);
    REQUIRE(gone.is_open());
    CHECK(std::filesystem::is_empty(run));  // the file has no name
    const double before = heap();
    for (std::int64_t k = 1; k <= kPieces; ++k) gone.add(some_piece(k));
    check_growth(before, 64e3);
    for (int time = 0; time < 2; ++time) {
        std::vector<IcePiece> all;
        gone.read(all);
        REQUIRE(all.size() == kPieces);
        for (std::int64_t k = 1; k <= kPieces; ++k) {
            const IcePiece &got = all[static_cast<std::size_t>(k - 1)], wanted = some_piece(k);
            REQUIRE(got.number == wanted.number);
            REQUIRE(got.body == wanted.body);
            REQUIRE(got.born == wanted.born);
            REQUIRE(got.gone == wanted.gone);
            REQUIRE(got.load == wanted.load);
            REQUIRE(got.radius == wanted.radius);
            REQUIRE(got.at == wanted.at);
            REQUIRE(got.outline == wanted.outline);
        }
    }
    GonePieces copy = gone;
    copy.add(some_piece(kPieces + 1));
    std::vector<IcePiece> of_copy, of_first;
    copy.read(of_copy);
    gone.read(of_first);
    CHECK(of_copy.size() == kPieces + 1);
    CHECK(of_first.size() == kPieces);
    CHECK(of_copy[777].outline == some_piece(778).outline);
    CHECK_THROWS_AS(GonePieces().open(folder / "nowhere"), Error);
}
