// SPDX-License-Identifier: GPL-3.0-or-later
// What the page holds of a run, decoded again as web/src/data.js does.
//
// Tolerances: 1e-9 is rounding of half a step of a code; 0.1 % of a force is a few steps of its
// root, coded in 8191; 1e-12 is rounding of a weight.
#include "postprocess/report/pack.hpp"

#include <zlib.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <limits>
#include <random>

#include "postprocess/report/viewer_data.hpp"
#include "postprocess/statistics/thin_series.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;
using namespace ice::report;

namespace {

std::string unpack(const std::string& base64) {
    static const std::string letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string packed;
    unsigned bits = 0, held = 0;
    for (const char c : base64) {
        if (c == '=') break;
        bits = bits << 6 | static_cast<unsigned>(letters.find(c));
        held += 6;
        if (held < 8) continue;
        held -= 8;
        packed += static_cast<char>(bits >> held & 0xff);
    }
    std::string out(1 << 24, '\0');
    uLongf size = out.size();
    REQUIRE(uncompress(reinterpret_cast<Bytef*>(out.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()) == Z_OK);
    out.resize(size);
    return out;
}

std::vector<std::int16_t> read_series(const std::string& bytes, const nlohmann::json& table) {
    const std::size_t count = table["count"], offset = table["offset"], rows = table["rows"];
    std::vector<std::int16_t> values(count);
    for (std::size_t k = 0; k < count; ++k)
        values[k] =
            static_cast<std::int16_t>(static_cast<unsigned char>(bytes[offset + k]) |
                                      static_cast<unsigned char>(bytes[offset + count + k]) << 8);
    for (int pass = 0; pass < table["order"].get<int>(); ++pass)
        for (std::size_t k = 0; k < count; ++k)
            if (k % rows != 0) values[k] = static_cast<std::int16_t>(values[k] + values[k - 1]);
    return values;
}

}  // namespace

TEST_CASE("series of any numbers come back from the page, whatever the order", "[report]") {
    std::mt19937 random(5);
    std::uniform_int_distribution<int> any(-32768, 32767);
    std::vector<std::int16_t> values;
    for (int k = 0; k < 700; ++k) values.push_back(static_cast<std::int16_t>(any(random)));
    const int order = GENERATE(0, 1, 2);
    Pack pack;
    pack.add("odd", std::vector<std::uint8_t>{1, 2, 3});
    pack.add_series("values", values, 100, order);
    pack.add_series("none", {}, 1, order);
    CHECK(pack.table()["values"]["offset"].get<std::size_t>() % 4 == 0);
    CHECK(read_series(unpack(pack.text()), pack.table()["values"]) == values);
}

TEST_CASE("a quantiser is exact to half its step and has no more than 16 bits", "[report]") {
    const Quantiser q = make_quantiser(-3.0, 5.0, 1e-9);
    for (const double v : {-3.0, -0.1, 1.234, 5.0})
        CHECK(std::abs(q.code(v) * q.step + q.offset - v) <= 0.5 * q.step * (1 + tolerance(1e-9)));
    CHECK(make_quantiser(0.0, 1.0, 0.1).step == 0.1);
    CHECK(make_quantiser(2.0, 2.0, 0.0).code(2.0) == 0);
    CHECK(make_quantiser(1.0, -1.0, 0.5).step == 0.5);  // of no values
    CHECK(q.code(std::nan("")) == 0);
    CHECK(q.code(1e9) == 32767);
}

TEST_CASE("the page's poses, states and loads are those of the run to the promised digits",
          "[report]") {
    RunData run = make_run();
    run.frames[20].state[2] = FloeState::behind;
    RunFigures figures;
    figures.load = statistics::make_load_map(run, 0.0);
    const ViewerData page = make_viewer_data(run, figures, 400);
    const auto meta = nlohmann::json::parse(page.meta);
    const std::string bytes = unpack(page.arrays);
    const auto position = read_series(bytes, meta["arrays"]["position"]);
    const auto turn = read_series(bytes, meta["arrays"]["orientation"]);
    const auto load = read_series(bytes, meta["arrays"]["load"]);
    const std::size_t rows = 45 * 6;
    for (std::size_t b = 0; b < 6; ++b)
        for (std::size_t f = 0; f < 45; ++f) {
            const std::size_t k = b * 45 + f;
            for (std::size_t d = 0; d < 3; ++d) {
                const double step = meta["position"]["scale"][d];
                const double offset = meta["position"]["offset"][d];
                REQUIRE(std::abs(position[d * rows + k] * step + offset -
                                 run.frames[f].position[b][static_cast<Eigen::Index>(d)]) <=
                        0.5 * step * (1 + tolerance(1e-9)));
            }
            const Eigen::Quaterniond q(turn[k], turn[rows + k], turn[2 * rows + k],
                                       turn[3 * rows + k]);
            // half a step of 1/8191 in each of four parts, of a half angle
            REQUIRE(q.normalized().angularDistance(run.frames[f].orientation[b]) < 2.5 / 8191);
            REQUIRE((load[k] & 3) == static_cast<int>(run.frames[f].state[b]));
            const double force = f == 0 ? 0.0 : run.frames[f].contact_force[b].norm();
            const double root = (load[k] >> 2) / 8191.0;
            REQUIRE(root * root * meta["load"]["max"].get<double>() ==
                    Near(force).margin(0.001 * 317));
        }
}

TEST_CASE("parts of a sheet have one place, and corners relative to it", "[report][level_ice]") {
    RunData run = make_run({.floes = 3, .frames = 2});
    RunHeader& header = run.header;
    header.shapes.push_back(header.shapes[1]);
    header.shapes.push_back(header.shapes[1]);
    header.body_shape = {1, 2, 3};
    header.body_group = {0, 1, 1};
    header.sheet_group = 1;
    header.body_born = {0.05, std::numeric_limits<double>::infinity(),
                        std::numeric_limits<double>::infinity()};
    header.body_breaking_load = {100.0, 0.0, 0.0};
    for (RunFrame& frame : run.frames) {
        frame.position[1] = Vec3(20.0, 0.0, 0.0);
        frame.position[2] = Vec3(23.3333, 1.0, 0.0);
        frame.state[2] = FloeState::absent;
    }
    RunFigures figures;
    figures.load = statistics::make_load_map(run, 0.0);
    const ViewerData page = make_viewer_data(run, figures, 400);
    const auto meta = nlohmann::json::parse(page.meta);
    const std::string bytes = unpack(page.arrays);
    const auto position = read_series(bytes, meta["arrays"]["position"]);
    for (std::size_t d = 0; d < 3; ++d)
        CHECK(position[2 + 6 * d] == position[4 + 6 * d]);  // of bodies 2 and 3
    const auto floats = [&](const char* name) {
        std::vector<float> out(meta["arrays"][name]["count"].get<std::size_t>());
        std::memcpy(out.data(), bytes.data() + meta["arrays"][name]["offset"].get<std::size_t>(),
                    sizeof(float) * out.size());
        return out;
    };
    const auto corner = floats("shape_vertices");
    const auto first = [&](std::size_t shape) {
        return 3 * meta["shapes"][shape]["first_vertex"].get<std::size_t>();
    };
    CHECK(corner[first(3)] - corner[first(2)] == Near(3.3333).margin(1e-5));
    CHECK(floats("piece_born") == std::vector<float>{0.05F, -2.0F, -2.0F});
    CHECK((read_series(bytes, meta["arrays"]["load"])[4] & 3) == 3);
}

TEST_CASE("thinned series keep every peak and their time's ends", "[statistics][property]") {
    std::vector<double> time(1000), a(1000, 0.0), b(1000, 1.0);
    for (std::size_t k = 0; k < 1000; ++k) time[k] = 0.01 * static_cast<double>(k);
    a[123] = 50.0;
    a[124] = -30.0;
    b[777] = 9.0;
    const auto thin = statistics::thin_series(time, {a, b}, 50);
    REQUIRE(thin.time.size() == 100);
    CHECK(thin.time.front() == time.front());
    CHECK(thin.time.back() == time.back());
    CHECK(std::is_sorted(thin.time.begin(), thin.time.end()));
    CHECK(*std::max_element(thin.values[0].begin(), thin.values[0].end()) == 50.0);
    CHECK(*std::min_element(thin.values[0].begin(), thin.values[0].end()) == -30.0);
    CHECK(*std::max_element(thin.values[1].begin(), thin.values[1].end()) == 9.0);
    CHECK(statistics::thin_series(time, {a, b}, 500).values[0] == a);
}

TEST_CASE("a moving average of a straight line is that line, of one peak Hann's window",
          "[statistics][analytic]") {
    std::vector<double> x, line, peak(101, 0.0);
    for (int k = 0; k <= 100; ++k) {
        x.push_back(0.1 * k);
        line.push_back(3.0 * x.back() - 1.0);
    }
    peak[50] = 10.0;
    const auto mean = statistics::moving_average(x, line, 1.0, {2.0, 5.0});
    CHECK(mean[0] == Near(5.0));
    CHECK(mean[1] == Near(14.0));
    // weights (1 + cos(pi t)) / 2 at 0.1 s sum to 1 s / 0.1 s = 10
    const auto share = statistics::moving_average(x, peak, 1.0, {3.9, 4.5, 5.0, 5.5, 6.1});
    CHECK(share[0] == Near(0.0).margin(1e-12));
    CHECK(share[1] == Near(0.5));
    CHECK(share[2] == Near(1.0));
    CHECK(share[3] == Near(0.5));
    CHECK(share[4] == Near(0.0).margin(1e-12));
}

TEST_CASE("at the ends a moving average is that of what is there", "[statistics][degenerate]") {
    const std::vector<double> x{0.0, 0.1, 0.2}, y{4.0, 4.0, 4.0};
    for (const double mean : statistics::moving_average(x, y, 1.0, {0.0, 0.2}))
        CHECK(mean == Near(4.0));
    CHECK(statistics::moving_average(x, y, 1.0, {9.0}) == std::vector<double>{0.0});
    CHECK(statistics::moving_average({}, {}, 1.0, {0.0}) == std::vector<double>{0.0});
}
