// SPDX-License-Identifier: GPL-3.0-or-later
// Peaks, panels and what a known force is on them.
//
// Tolerances: 0.4 % is half the width of a class of forces, rounded up. 128 classes lie between a
// force and its double. 1e-9 is rounding of a sum over all spheres.
#include "solver/record/panel_loads.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "solver/record/divide_hull.hpp"
#include "solver/record/find_peaks.hpp"
#include "solver/record/long_series.hpp"
#include "solver/record/window_forces.hpp"
#include "solver/run/make_world.hpp"
#include "solver/run/run.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

constexpr double kStep = 0.01;    // [s]
constexpr double kImpulse = 3.0;  // [N s] per step: 300 N

// a contact of the hull's sphere `sphere` that pushes along -z on the floe
void press(std::int32_t sphere, double impulse, std::vector<Contact>& contacts,
           std::vector<Constraint>& constraints) {
    Contact contact{};
    contact.point = contact.normal = Vec3::Zero();
    contact.b = 1;
    contact.sphere_a = sphere;
    Constraint c{};
    c.arm_a = c.arm_b = Vec3::Zero();
    c.b = 1;
    c.normal = -Vec3::UnitZ();
    c.rest_normal = 0.25 * impulse;
    c.impact_normal = 0.75 * impulse;
    contacts.push_back(contact);
    constraints.push_back(c);
}

// the surface sphere nearest to a place
std::int32_t nearest(const Shape& hull, const Vec3& at) {
    const auto closer = [&](const Vec3& a, const Vec3& b) {
        return (a - at).squaredNorm() < (b - at).squaredNorm();
    };
    return static_cast<std::int32_t>(
        std::min_element(hull.center.begin(), hull.center.end(), closer) - hull.center.begin());
}

const PanelLoad& panel_of(const HullPanels& hull, std::int32_t sphere) {
    return hull.panels[static_cast<std::size_t>(hull.of_sphere[static_cast<std::size_t>(sphere)])];
}

}  // namespace

TEST_CASE("peaks are the largest values between two up-crossings of the mean",
          "[record][analytic]") {
    // mean 2: up to 5 and 3 is one peak, 6 another; what begins above the mean is none
    const std::vector<double> series{4, 1, 3, 5, 3, 0, 1, 6, 0, 0, 0, 1};
    REQUIRE(std::accumulate(series.begin(), series.end(), 0.0) == 24.0);
    const PeakStatistics peaks = find_peaks(series, 0.1);
    CHECK(peaks.mean == 2.0);
    CHECK(peaks.max == 6.0);
    CHECK(peaks.count == 2);
    // 1.2 s are 1/3000 h
    REQUIRE(peaks.exceeded.size() == 2);
    CHECK(peaks.exceeded[0].level == 6.0);
    CHECK(peaks.exceeded[0].per_hour == Near(3000.0));
    CHECK(peaks.exceeded[1].level == 5.0);
    CHECK(peaks.exceeded[1].per_hour == Near(6000.0));
}

TEST_CASE("a constant force has no peaks, nor has no force", "[record][degenerate]") {
    CHECK(find_peaks(std::vector<double>(50, 7.0), 0.1).count == 0);
    CHECK(find_peaks(std::vector<double>(50, 7.0), 0.1).p99 == 7.0);
    CHECK(find_peaks(std::vector<double>{}, 0.1).exceeded.empty());
    CHECK(quantile({}, 0.99) == 0.0);
}

TEST_CASE("exceedance of 1000 peaks of heights 1 to 1000 is a straight line with few points",
          "[record][analytic]") {
    std::vector<double> series;
    for (int k = 1; k <= 1000; ++k) {
        series.push_back(0.0);
        series.push_back(1000.0 + k);  // above the mean of 750
    }
    const PeakStatistics peaks = find_peaks(series, 0.5);
    CHECK(peaks.count == 1000);
    CHECK(peaks.exceeded.size() < 50);
    CHECK(peaks.exceeded.back().level == 1001.0);
    for (const Exceedance& e : peaks.exceeded)  // 1000 s
        CHECK(e.per_hour == Near((2001.0 - e.level) * 3.6));
    CHECK(peaks.p99 == 1980.0);  // 20 of 2000 values are larger
}

TEST_CASE("a quantile of many windows is within 0.4 % of the exact one", "[record][property]") {
    std::mt19937 random(8);
    std::lognormal_distribution<double> draw(10.0, 1.5);
    WindowForces forces;
    std::vector<double> all;
    double sum = 0.0;
    for (std::size_t k = 1; k <= 5 * WindowForces::kExact; ++k) {
        const double force = draw(random);
        forces.add(force);
        all.push_back(force);
        sum += force;
        if (k % 1000 != 0) continue;
        const std::size_t windows = k + k / 3;  // a quarter without a load
        std::vector<double> with_zeros = all;
        with_zeros.resize(windows, 0.0);
        for (const double share : {0.1, 0.3, 0.9, 0.99, 1.0}) {
            const double exact = quantile(with_zeros, share);
            const double got = forces.quantile(share, static_cast<std::int64_t>(windows));
            CAPTURE(k, share);
            if (k < WindowForces::kExact) REQUIRE(got == exact);
            REQUIRE(std::abs(got - exact) <= tolerance(0.004) * exact);
        }
    }
    CHECK(forces.sum() == sum);
    CHECK(forces.largest() == *std::max_element(all.begin(), all.end()));
}

TEST_CASE("peaks of a long series are those of its windows, where they are blocks apart",
          "[record][analytic]") {
    LongSeries series(LongSeries::Join::largest);
    std::vector<double> all;
    for (std::size_t k = 0; k < 3 * LongSeries::kMost; ++k) {
        all.push_back(k % 40 == 39 ? 10.0 + static_cast<double>(k % 7) : 0.5);
        series.add(all.back());
    }
    REQUIRE(series.block_length() == 4);
    const PeakStatistics exact = find_peaks(all, 0.1), got = find_peaks(series, 0.1);
    CHECK(got.mean == exact.mean);
    CHECK(got.max == exact.max);
    CHECK(got.count == exact.count);
    REQUIRE(got.exceeded.size() == exact.exceeded.size());
    for (std::size_t k = 0; k < got.exceeded.size(); ++k) {
        CHECK(got.exceeded[k].level == exact.exceeded[k].level);
        CHECK(got.exceeded[k].per_hour == Near(exact.exceeded[k].per_hour));
    }
    // the largest of all, in a block that is not full
    series.add(99.0);
    CHECK(find_peaks(series, 0.1).max == 99.0);
}

TEST_CASE("panels share all of the hull, and whole ones have the size that was asked for",
          "[record][property]") {
    const Shape hull = build_shape(make_box_set(Vec3(4.0, 2.0, 1.5), 0.025, 0.05), false);
    const HullPanels panels = divide_hull(hull, 0.5, 0.0);
    REQUIRE(panels.of_sphere.size() == hull.center.size());
    const double area = std::accumulate(hull.area.begin(), hull.area.end(), 0.0);
    double sum = 0.0;
    for (const PanelLoad& p : panels.panels) {
        sum += p.area;
        CHECK(p.area >= 0.5 * 0.25);  // the smaller ones joined others
        CHECK(p.area < 0.5);
        CHECK(p.normal.cwiseAbs().maxCoeff() > 0.85);
    }
    CHECK(sum == Near(area).epsilon(1e-9));
    // a whole panel on the side and one on the bottom: 0.5 x 0.5 m of spheres 0.05 m apart
    for (const Vec3& at : {Vec3(0.25, 1.0, 0.0), Vec3(0.25, 0.0, -0.75)}) {
        const PanelLoad& p = panel_of(panels, nearest(hull, at));
        CHECK(p.area == Near(0.25).epsilon(0.12));  // a row of spheres more or less
        CHECK(p.length == Near(0.5).epsilon(0.12));
        CHECK((p.center - at).norm() < 0.25);
    }
}

TEST_CASE("panels are as large as the ice is thick, or as two spacings of the hull's spheres",
          "[record]") {
    World w = plate_world(empty_space(kStep), Vec3(4, 4, 0.4), 0.1, 0.1, 0.0);
    CHECK(panel_size(w.scene) == Near(0.2));
    add_shape(w, make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    CHECK(panel_size(w.scene) == Near(0.3));
    CHECK(divide_hull(w.scene.shapes[0], 0.0, 0.0).panels.empty());
}

TEST_CASE("300 N on one panel for a second are 300 N over its length and area",
          "[record][analytic]") {
    const Shape hull = build_shape(make_box_set(Vec3(4.0, 2.0, 1.0), 0.05, 0.1), false);
    PanelLoads loads(divide_hull(hull, 0.5, 0.0), hull.region_names, 0.5, kStep);
    const std::int32_t sphere = nearest(hull, Vec3(1.0, 0.0, -0.5));
    std::vector<Contact> contacts;
    std::vector<Constraint> constraints;
    press(sphere, kImpulse, contacts, constraints);
    // a floe's contact with a floe is none of the hull's
    press(sphere, 100.0, contacts, constraints);
    constraints.back().a = 2;
    // 0.5 s before the statistics begin with ten times the force, then 0.55 s: 5 whole windows
    std::vector<Constraint> before = constraints;
    before[0].rest_normal *= 10.0;
    for (int k = 1; k < 50; ++k) loads.add(contacts, before, k * kStep);
    for (int k = 50; k < 105; ++k) loads.add(contacts, constraints, k * kStep);

    const HullPanels panels = loads.panels();
    CHECK(panels.window == Near(0.1));
    const PanelLoad& p = panel_of(panels, sphere);
    CHECK(p.mean == Near(300.0));
    CHECK(p.max == Near(300.0));
    CHECK(p.p99 == Near(300.0));
    double all = 0.0;
    for (const PanelLoad& other : panels.panels) all += other.mean;
    CHECK(all == Near(300.0));

    Summary summary;
    loads.fill(summary);
    REQUIRE(summary.panels.hardest.size() == 1);
    CHECK(summary.panels.touched == 1);
    const auto& [region, hardest] = summary.panels.hardest[0];
    CHECK(region == hull.region_names[0]);
    CHECK(hardest.max / hardest.length == Near(300.0 / p.length));
    CHECK(hardest.max / hardest.area == Near(300.0 / p.area));
    REQUIRE(summary.regions[region].force_peaks);
    CHECK(summary.regions[region].force_peaks->mean == Near(300.0));
    CHECK(summary.regions[region].force_peaks->count == 0);  // a constant force
}

TEST_CASE("a hit of one step counts with its impulse over the window, whatever the step",
          "[record][analytic]") {
    const Shape hull = build_shape(make_box_set(Vec3(4.0, 2.0, 1.0), 0.05, 0.1), false);
    const double dt = GENERATE(0.01, 0.005, 0.001);
    const int per_window = static_cast<int>(std::lround(0.1 / dt));
    PanelLoads loads(divide_hull(hull, 0.5, 0.0), hull.region_names, 0.0, dt);
    std::vector<Contact> contacts;
    std::vector<Constraint> constraints, idle;
    press(nearest(hull, Vec3(1.0, 0.0, -0.5)), 12.0, contacts, constraints);
    idle = constraints;
    idle[0].rest_normal = idle[0].impact_normal = 0.0;
    for (int window = 0; window < 100; ++window)
        for (int k = 0; k < per_window; ++k)
            loads.add(contacts, window % 10 == 5 && k == 3 ? constraints : idle,
                      (window * per_window + k + 1) * dt);
    Summary summary;
    loads.fill(summary);
    const PeakStatistics& peaks = *summary.regions.begin()->second.force_peaks;
    CHECK(peaks.max == Near(120.0));
    CHECK(peaks.mean == Near(12.0));
    CHECK(peaks.count == 10);
    CHECK(peaks.exceeded.back().per_hour == Near(3600.0));
    CHECK(summary.panels.hardest[0].second.p99 == Near(120.0));  // 10 windows of 100
}

TEST_CASE("in 2D a panel is a piece of the section and its line load the force per metre",
          "[record][analytic]") {
    const Shape hull = build_shape(make_box_set(Vec3(4.0, 1.0, 1.0), 0.05, 0.1, 2), false);
    PanelLoads loads(divide_hull(hull, 0.5, 0.0), hull.region_names, 0.0, kStep);
    const std::int32_t sphere = nearest(hull, Vec3(1.0, 0.0, -0.5));
    std::vector<Contact> contacts;
    std::vector<Constraint> constraints;
    press(sphere, kImpulse, contacts, constraints);
    for (int k = 1; k <= 20; ++k) loads.add(contacts, constraints, k * kStep);
    const HullPanels panels = loads.panels();
    const PanelLoad& p = panel_of(panels, sphere);
    CHECK(p.length == 1.0);
    CHECK(p.mean == Near(300.0));
    CHECK(p.area == Near(0.5).epsilon(0.2));  // a piece of half a metre, one sphere more or less
}

TEST_CASE("forces on the regions, row by row, are together the force on the ship", "[record]") {
    Case p;
    p.time_step = kStep;
    p.duration = 0.5;
    p.average_from = 0.1;
    p.speed_table = {{0.0, 1.0}};
    p.history_every = 0.05;
    p.floes.resize(1);
    p.floes[0].hold = Hold::never;
    World w = plate_world(p, Vec3(3, 2, 0.4), 0.1, 0.2, -0.5);
    const auto box = add_shape(w, make_box_set(Vec3(0.5, 0.4, 0.2), 0.05, 0.1));
    add_floe(w.scene, box, 900.0, Vec3(0.0, 0.05, -0.601), Quaternion::Identity(), 0, false);
    const TempFolder folder;
    const Summary summary = run(w, {folder / "run", "command"});
    const RunData data = read_run(folder / "run" / "run.h5");
    CHECK(data.header.average_from == 0.1);
    REQUIRE(data.regions.size() == 1);
    double rubbed = 0.0;
    for (std::size_t k = 0; k < data.history.size(); ++k) {
        const HistoryRow& row = data.history[k];
        // stored in single precision
        CHECK((data.regions[0].contact[k].cast<double>() - row.contact_force).norm() <=
              tolerance(1e-6) * row.contact_force.norm());
        CHECK((data.regions[0].friction[k].cast<double>() - row.friction_force).norm() <=
              tolerance(1e-6) * row.friction_force.norm());
        rubbed += row.friction_force.norm();
    }
    CHECK(rubbed > 0.0);
    // the floe under the flat bottom: the panels bear what the ship bears
    double on_panels = 0.0;
    for (const PanelLoad& panel : data.panels.panels) on_panels += panel.mean;
    CHECK(on_panels == Near(summary.vertical.contact_mean).epsilon(0.02));  // 4 windows of 41 steps
    CHECK(read_summary(folder / "run" / "summary.json").panels.hardest.size() ==
          summary.panels.hardest.size());
}

TEST_CASE("a hull placed by its draught has the same panels as one placed by z",
          "[record][invariant]") {
    const SphereSet hull = make_box_set(Vec3(3, 2, 1.0), 0.1, 0.2);  // z from -0.5 to 0.5
    const double draught = 0.65;
    Case by_draught = empty_space(kStep);
    by_draught.duration = 2 * kStep;
    by_draught.hull_position = Vec3(0, 0, std::nan(""));  // as a case file leaves it
    by_draught.hull_draught = draught;
    Case by_z = by_draught;
    by_z.hull_draught = std::nan("");
    by_z.hull_position.z() = 0.5 - draught;
    const auto panels_of = [&](const Case& p) {
        World w = make_world(p, hull);
        CHECK(w.scene.bodies.position[kShip].z() == Near(0.5 - draught));
        add_floe_shape(w, make_box_set(Vec3(0.5, 0.4, 0.2), 0.05, 0.1));
        add_floe(w, 1, {.position = Vec3(9, 0, 0)});
        const TempFolder folder;
        run(w, {folder / "run", "command"});
        return read_run(folder / "run" / "run.h5").panels;
    };
    const HullPanels a = panels_of(by_draught), b = panels_of(by_z);
    CHECK(a.of_sphere == b.of_sphere);
    REQUIRE(a.panels.size() == b.panels.size());
    // more than one row over the height: panels of 0.2 m on a side 1 m high
    double top = -9.0, low = 9.0;
    for (std::size_t k = 0; k < a.panels.size(); ++k) {
        CHECK(a.panels[k].area == Near(b.panels[k].area));
        CHECK(a.panels[k].center.isApprox(b.panels[k].center));
        top = std::max(top, a.panels[k].center.z());
        low = std::min(low, a.panels[k].center.z());
    }
    CHECK(top - low > 0.5);
}
