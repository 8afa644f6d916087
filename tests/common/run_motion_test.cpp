// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "common/formats/run_file.hpp"
#include "tests/common/fixtures.hpp"

using namespace ice;
using namespace ice::test;

TEST_CASE("the motion of a free ship comes back, row by row and frame by frame", "[formats]") {
    const TempFolder folder;
    RunData run = make_run({.frames = 3});
    run.header.ship_is_free = true;
    for (std::size_t k = 0; k < run.history.size(); ++k) {
        const double t = run.history[k].time;
        run.history[k].ship_velocity = Vec3(1.0 + t, 0.25, -t);
        run.history[k].ship_angles = Vec3(0.5 * t, -0.125, t);
        run.history[k].thrust = 1e5 * (1.0 + t);
        run.history[k].tow_force = Vec3(-3.0, 2.0 * t, 7.0);
        run.history[k].ship_orientation = Eigen::AngleAxisd(0.1 * t, Vec3::UnitY());
    }
    // about an axis of its own in each frame, so that no component is always zero
    for (std::size_t f = 0; f < 3; ++f)
        run.frames[f].ship_orientation =
            Eigen::AngleAxisd(0.3, Vec3(1.0, static_cast<double>(f), -2.0).normalized());
    write_run(folder / "run.h5", run);

    const RunData back = read_run(folder / "run.h5");
    CHECK(back.header.ship_is_free);
    REQUIRE(back.history.size() == run.history.size());
    constexpr double kAngle = 1e-6;  // of floats, as stored in frames [rad]
    for (std::size_t k = 0; k < run.history.size(); ++k) {
        const HistoryRow &a = run.history[k], &b = back.history[k];
        CHECK(a.ship_velocity == b.ship_velocity);
        CHECK(a.ship_angles == b.ship_angles);
        CHECK(a.thrust == b.thrust);
        CHECK(a.tow_force == b.tow_force);
        CHECK(a.ship_orientation.angularDistance(b.ship_orientation) < kAngle);
    }
    REQUIRE(back.frames.size() == 3);
    for (std::size_t f = 0; f < 3; ++f)
        CHECK(run.frames[f].ship_orientation.angularDistance(back.frames[f].ship_orientation) <
              kAngle);
}
