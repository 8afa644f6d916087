// SPDX-License-Identifier: GPL-3.0-or-later
// checkpoint.h5: what goes in comes out to the bit, or one error says why not.
#include "common/formats/checkpoint_file.hpp"

#include <bit>
#include <catch2/catch.hpp>
#include <cstring>
#include <limits>

#include "common/base/error.hpp"
#include "common/base/state_hash.hpp"
#include "common/formats/hdf5_file.hpp"
#include "tests/common/fixtures.hpp"

using namespace ice;
using namespace ice::test;

namespace {

using Direction = CheckpointFile::Direction;

struct Row {
    std::int32_t id = 0;
    double mass = 0.0;
};

struct State {
    double time = 0.0;
    std::int64_t steps = 0;
    std::uint64_t key = 0;
    std::string text;
    Vec3 point = Vec3::Zero();
    std::vector<double> series;
    std::optional<double> given, missing;
    std::vector<std::uint8_t> held;
    std::vector<Vec3> points;
    std::vector<Eigen::Quaterniond> turns;
    std::vector<Row> rows;
};

void carry(CheckpointFile& file, State& s) {
    file.carry("time", s.time);
    file.carry("steps", s.steps);
    file.carry("key", s.key);
    file.carry("text", s.text);
    file.carry("point", s.point);
    file.carry("series", s.series);
    file.carry("held", s.held);
    file.carry("given", s.given);
    file.carry("missing", s.missing);
    file.carry("points", s.points);
    file.carry("turns", s.turns);
    file.column("rows.id", s.rows, &Row::id);
    file.column("rows.mass", s.rows, &Row::mass);
}

void write(const std::filesystem::path& path, State s) {
    CheckpointFile file(path, Direction::write);
    carry(file, s);
    file.finish();
}

State read(const std::filesystem::path& path) {
    State s;
    CheckpointFile file(path, Direction::read);
    carry(file, s);
    return s;
}

State sample() {
    State s;
    s.time = 0.1 + 0.2;
    s.steps = (std::int64_t{1} << 53) + 1;  // more than a double holds
    s.key = ~std::uint64_t{0};
    s.text = "[ice]\ndensity = 900.0\n\"q\"";
    s.point = Vec3(1.0, -0.0, 5e-324);
    s.series = {std::nan(""), std::numeric_limits<double>::infinity(), -0.0};
    s.held = {1, 0, 255};
    s.given = 0.25;
    s.points = {Vec3(1, 2, 3), Vec3(4, 5, 6)};
    s.turns = {Eigen::Quaterniond(0.1, 0.2, 0.3, 0.4)};
    s.rows = {{7, 1.5}, {8, 2.5}};
    return s;
}

// The seal as the header states it: the hash of length and content in words, as 16 hex digits.
std::string sealed(const std::string& content) {
    StateHash hash;
    hash.add(std::uint64_t{content.size()});
    for (std::size_t k = 0; k < content.size(); k += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, content.data() + k, std::min<std::size_t>(8, content.size() - k));
        hash.add(word);
    }
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash.value()));
    return content + text;
}

}  // namespace

TEST_CASE("a checkpoint gives back every field to the bit", "[formats][checkpoint]") {
    const TempFolder folder;
    const State in = sample();
    write(folder / "c.h5", in);
    const State out = read(folder / "c.h5");
    CHECK(out.time == in.time);
    CHECK(out.steps == in.steps);
    CHECK(out.key == in.key);
    CHECK(out.text == in.text);
    CHECK(out.point == in.point);
    CHECK(std::signbit(out.point.y()));
    REQUIRE(out.series.size() == 3);
    for (std::size_t k = 0; k < 3; ++k)
        CHECK(std::bit_cast<std::uint64_t>(out.series[k]) ==
              std::bit_cast<std::uint64_t>(in.series[k]));
    CHECK(out.held == in.held);
    CHECK(out.given == 0.25);
    CHECK(out.missing == std::nullopt);
    CHECK(out.points == in.points);
    REQUIRE(out.turns.size() == 1);
    CHECK(out.turns[0].coeffs() == in.turns[0].coeffs());
    REQUIRE(out.rows.size() == 2);
    CHECK(out.rows[1].id == 8);
    CHECK(out.rows[1].mass == 2.5);
    CHECK(folder.file_count() == 1);
}

TEST_CASE("empty lists and texts come back empty", "[formats][checkpoint]") {
    const TempFolder folder;
    write(folder / "c.h5", {});
    const State out = read(folder / "c.h5");
    CHECK(out.text.empty());
    CHECK(out.series.empty());
    CHECK(out.points.empty());
    CHECK(out.rows.empty());
}

TEST_CASE("a program that ends while it writes leaves the older checkpoint whole",
          "[formats][checkpoint]") {
    const TempFolder folder;
    write(folder / "c.h5", sample());
    const std::string before = read_bytes(folder / "c.h5");
    {
        CheckpointFile file(folder / "c.h5", Direction::write);
        State s;
        carry(file, s);
        CHECK(read_bytes(folder / "c.h5") == before);
    }
    CHECK(read_bytes(folder / "c.h5") == before);
    CHECK(folder.file_count() == 1);
}

TEST_CASE("every flipped bit and every shortened checkpoint is an error with exit code 2",
          "[formats][checkpoint][errors]") {
    const TempFolder folder;
    write(folder / "c.h5", sample());
    const std::string good = read_bytes(folder / "c.h5");
    const auto code_of = [&](const std::string& text) {
        write_bytes(folder / "d.h5", text);
        try {
            read(folder / "d.h5");
        } catch (const Error& error) {
            CHECK_THAT(error.what(), Catch::Contains("d.h5") && Catch::Contains("damaged"));
            return static_cast<int>(error.code());
        }
        return 0;
    };
    CHECK(code_of(good + " ") == 2);
    CHECK(code_of("") == 2);
    CHECK(code_of("no HDF5 at all, but longer than a seal") == 2);
    // steps that share no factor with 8: all places within a word occur
    for (std::size_t k = 0; k < good.size(); k += 37) {
        std::string bad = good;
        bad[k] = static_cast<char>(bad[k] ^ (1 << (k % 8)));
        if (code_of(bad) != 2) FAIL("byte " << k << " flipped");
        if (code_of(good.substr(0, k)) != 2) FAIL("cut to " << k << " bytes");
    }
}

TEST_CASE("a newer format and another kind of file are told apart from damage",
          "[formats][checkpoint][errors]") {
    const TempFolder folder;
    const auto message_of = [&](const std::string& format, std::int64_t version) {
        {
            Hdf5File file(folder / "raw.h5", Hdf5File::Mode::create);
            file.write_attribute("/", "format", format);
            file.write_attribute("/", "format_version", version);
            file.write_attribute("/", "created_by", std::string("icesolve 9.9.9"));
        }
        write_bytes(folder / "c.h5", sealed(read_bytes(folder / "raw.h5")));
        try {
            read(folder / "c.h5");
        } catch (const Error& error) {
            CHECK(static_cast<int>(error.code()) == 2);
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK_THAT(message_of("icesolve-checkpoint", 3),
               Catch::Contains("format_version 3") && Catch::Contains("icesolve 9.9.9"));
    CHECK_THAT(message_of("icesolve-spheres", 1), Catch::Contains("not a checkpoint"));
    // a field that this program carries and the other did not
    CHECK_THAT(message_of("icesolve-checkpoint", 2),
               Catch::Contains("has no field time") && Catch::Contains("icesolve 9.9.9"));
}

TEST_CASE("a list with another length than the program's is refused",
          "[formats][checkpoint][errors]") {
    const TempFolder folder;
    {
        CheckpointFile file(folder / "c.h5", Direction::write);
        std::vector<double> mass{1, 2, 3};
        file.carry("mass", mass);
        file.finish();
    }
    CheckpointFile file(folder / "c.h5", Direction::read);
    std::vector<double> mass(2);
    CHECK_THROWS_WITH(file.carry_each("mass", mass),
                      Catch::Contains("mass has 3 values where 2 belong"));
}
