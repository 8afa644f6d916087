// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/histories.hpp"

#include <catch2/catch.hpp>

#include "tests/common/fixtures.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::report;
using namespace ice::test;

TEST_CASE("averages are over a thirtieth of the run, whatever time it begins at",
          "[report][analytic]") {
    std::vector<HistoryRow> history(601);
    for (std::size_t k = 0; k < history.size(); ++k)
        history[k].time = 100.0 + 0.1 * static_cast<double>(k);  // for 60 s
    CHECK(average_window(history) == Near(2.0));
    for (HistoryRow& row : history) row.time = 100.0 + 0.01 * (row.time - 100.0);
    CHECK(average_window(history) == Near(0.02));
    // five rows at least: of 60 s in 12 rows
    history.resize(13);
    for (std::size_t k = 0; k < history.size(); ++k) history[k].time = 5.0 * static_cast<double>(k);
    CHECK(average_window(history) == Near(20.0));
}

TEST_CASE("regions of a small model have charts, too", "[report]") {
    RunData run = make_run();
    for (RegionHistory& region : run.regions)
        for (auto& force : region.contact) force *= 1e-9f;
    const auto charts = region_histories(run, 0.0, ForceUnit{});
    CHECK(charts.size() == 3);
    // none where no force is
    for (RegionHistory& region : run.regions)
        for (auto& force : region.contact) force.setZero();
    CHECK(region_histories(run, 0.0, ForceUnit{}).empty());
}
