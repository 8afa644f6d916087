// SPDX-License-Identifier: GPL-3.0-or-later
// Attainable speeds against their closed forms.
//
// Tolerances: 1e-12 and 1e-10 are rounding of a straight line through two points, and of its
// inverse; 1e-6 N is that of a difference of forces of 1e5 N; 1e-9 is rounding of a mean.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "common/base/error.hpp"
#include "common/formulas/spencer.hpp"
#include "postprocess/attain/hv_curves.hpp"
#include "tests/postprocess/write_runs.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::attain;
using namespace ice::test;

namespace {

// R = 1e5 h (2 + 3 u), half width 5 % of it, at two speeds and two thicknesses
void write_grid_of_thickness(const TempFolder& folder, double half_share = 0.05) {
    for (const double h : {0.5, 1.0})
        for (const double u : {1.0, 3.0}) {
            const auto run = folder / fmt::format("h{}u{}", h, u);
            write_run(run, u, 0.1, 1, 1e5 * h * (2.0 + 3.0 * u),
                      fmt::format("[field.ice]\nthickness = {}\n", h));
            Summary s = read_summary(run / "summary.json");
            s.resistance.ci95 = half_share * s.resistance.mean;
            s.ship.speed_mean = u;
            s.ice.thickness = h;
            write_bytes(run / "summary.json", summary_text(s));
        }
}

// what formulas ask for
void give_particulars(const std::filesystem::path& run) {
    Summary s = read_summary(run / "summary.json");
    s.ship.length = 95.0;
    s.ship.breadth = 22.0;
    s.ship.draught = 8.0;
    s.ice.water_density = 1025.0;
    s.ice.gravity = 9.81;
    write_bytes(run / "summary.json", summary_text(s));
}

// a ship that was free in surge in ice of h [m]
void write_free_run(const std::filesystem::path& run, double h, double speed) {
    write_run(run, 2.5, 0.1, 1, 1.0,
              fmt::format("[field.ice]\nthickness = {}\n[ship]\nfree = [\"surge\"]\n"
                          "[propulsion]\npower = 5e6\n",
                          h));
    Summary s = read_summary(run / "summary.json");
    s.ice.thickness = h;
    s.ship.speed_mean = speed;
    write_bytes(run / "summary.json", summary_text(s));
    give_particulars(run);
    std::string text = summary_text(read_summary(run / "summary.json"));
    const std::string key = "\"speed_mean\":";
    text.replace(text.find(key), key.size(), "\"speed_ci95\": 0.1, \"speed_mean\":");
    write_bytes(run / "summary.json", text);
}

Thrust constant(double newtons) { return {"constant", newtons, 0.0, {}}; }

// the first curve of ships on a prescribed course
const HvCurve& computed(const HvStudy& study) {
    for (const HvCurve& curve : study.curves)
        if (curve.source == Source::prescribed_course) return curve;
    throw std::logic_error("no curve");
}

}  // namespace

TEST_CASE("R = a + b V meets a constant thrust at (T - a) / b, a net curve at its quadratic's root",
          "[attain][hv][analytic]") {
    const double a = 2e5, b = 3e5;
    const std::vector<SpeedPoint> points{{1.0, a + b, 1e4}, {3.0, a + 3.0 * b, 1e4}};
    const ResistanceFit fit = fit_resistance(points);
    CHECK(fit.at(2.0) == Near(a + 2.0 * b).epsilon(1e-12));
    CHECK(attained_speed(fit, constant(8e5)).speed == Near((8e5 - a) / b).epsilon(1e-10));
    // T_B (1 - x/3 - 2/3 x^2) = a + b U_ow x
    const Thrust net{"net", 1.5e6, 8.0, {}};
    const double p = net.bollard_pull / 3.0 + b * 8.0, q = 2.0 / 3.0 * net.bollard_pull;
    const double x = (-p + std::sqrt(p * p + 4.0 * q * (net.bollard_pull - a))) / (2.0 * q);
    const AttainedSpeed met = attained_speed(fit, net);
    CHECK(met.speed == Near(8.0 * x).epsilon(1e-10));
    CHECK(met.reach == Reach::outside);  // 3.2 m/s, the runs end at 3
    // the mean of two points has half the variance: 1e4 / sqrt(2) at 2 m/s
    CHECK(fit.half(2.0) == Near(1e4 / std::sqrt(2.0)).epsilon(1e-10));
    CHECK(fit.half(1.0) == Near(1e4).epsilon(1e-10));
    const AttainedSpeed middle = attained_speed(fit, constant(a + 2.0 * b));
    // to first order half / b; the interval's own growth with speed is second order in 0.024
    CHECK(0.5 * (middle.high - middle.low) == Near(1e4 / std::sqrt(2.0) / b).epsilon(1e-3));
}

TEST_CASE("a ship is stuck, beyond its curve, or not held by the ice", "[hv][degenerate]") {
    const ResistanceFit fit = fit_resistance({{1.0, 5e5, 1e4}, {3.0, 11e5, 1e4}});
    CHECK(attained_speed(fit, constant(1e5)).reach == Reach::stuck);
    CHECK(attained_speed(fit, constant(1e5)).speed == 0.0);
    CHECK(attained_speed(fit, constant(3e5)).reach == Reach::outside);
    CHECK(attained_speed(fit, constant(20e5)).reach == Reach::outside);
    const ResistanceFit flat = fit_resistance({{1.0, 5e5, 1e4}, {3.0, 5e5, 1e4}});
    CHECK(attained_speed(flat, constant(6e5)).reach == Reach::beyond);
    CHECK(std::isnan(attained_speed(flat, constant(6e5)).speed));
    const ResistanceFit unknown = fit_resistance({{1.0, 5e5, std::nan("")}, {3.0, 8e5, 1e4}});
    CHECK(std::isnan(attained_speed(unknown, constant(6e5)).low));
    CHECK(attained_speed(unknown, constant(6e5)).speed == Near(1.0 + 2.0 / 3.0));
}

TEST_CASE("four speeds on a parabola are fitted by it, scattered ones by a line", "[hv]") {
    std::vector<SpeedPoint> curved, scattered;
    int sign = 1;
    for (const double u : {0.5, 1.0, 2.0, 3.0, 4.0}) {
        curved.push_back({u, 1e5 + 2e4 * u + 5e4 * u * u, 1e3});
        scattered.push_back({u, 1e5 + 2e4 * u + 900.0 * (sign = -sign), 1e3});
    }
    CHECK(fit_resistance(curved).coefficient.size() == 3);
    CHECK(fit_resistance(curved).at(2.5) == Near(1e5 + 5e4 + 5e4 * 6.25));
    CHECK(fit_resistance(scattered).coefficient.size() == 2);
    const ResistanceFit unordered =
        fit_resistance({{2.0, 6e5, 1e4}, {1.0, 5e5, 1e4}, {3.0, 7e5, 1e4}});
    CHECK(unordered.slowest == 1.0);
    CHECK(unordered.fastest == 3.0);
}

TEST_CASE("thrust curves: the bollard's end, the open-water end, power, a table",
          "[attain][hv][analytic]") {
    const Thrust net{"net", 1.2e6, 8.0, {}};
    CHECK(net.at(0.0) == 1.2e6);
    CHECK(net.at(8.0) == Near(0.0).margin(1e-6));
    CHECK(net.at(4.0) == Near(1.2e6 * (1.0 - 1.0 / 6.0 - 1.0 / 6.0)));
    // 1000 kW on 8 m: (8000)^(2/3) = 400, times 0.98 kN
    CHECK(bollard_pull(1e6, 8.0, 2) == Near(392e3));
    const Thrust table{"table", 0.0, 0.0, {{1.0, 10.0}, {3.0, 4.0}}};
    CHECK(table.at(0.0) == 10.0);
    CHECK(table.at(2.0) == Near(7.0));
    CHECK(table.at(9.0) == 4.0);
}

TEST_CASE("a file of thrust curves, and what is wrong with one", "[hv]") {
    const TempFolder folder;
    const auto file = folder / "thrust.toml";
    write_bytes(file,
                "[[thrust]]\nname = \"both\"\nbollard_pull = 1.2e6\nopen_water_speed = \"16 kn\"\n"
                "[[thrust]]\nconstant = 5e5\n"
                "[[thrust]]\npower = 1e6\npropeller_diameter = \"8 m\"\npropellers = 2\n"
                "open_water_speed = 8\n[[thrust]]\ntable = [[0, 10.0], [2, 4.0]]\n");
    const auto thrusts = read_thrusts(file);
    REQUIRE(thrusts.size() == 4);
    CHECK(thrusts[0].name == "both");
    CHECK(thrusts[0].open_water_speed == Near(16.0 * 1852.0 / 3600.0));
    CHECK(thrusts[1].name == "thrust 2");
    CHECK(thrusts[1].at(7.0) == 5e5);
    CHECK(thrusts[2].at(0.0) == Near(392e3));
    CHECK(thrusts[3].at(1.0) == Near(7.0));
    for (const auto& [text, fault] : std::vector<std::pair<std::string, std::string>>{
             {"", "has no [[thrust]]"},
             {"[[thrust]]\nname = \"x\"\n", "give one of constant"},
             {"[[thrust]]\nconstant = 1\npower = 2\n", "give one of constant"},
             {"[[thrust]]\nbollard_pull = 1e6\n", "open_water_speed is missing"},
             {"[[thrust]]\npower = 1e6\nopen_water_speed = 8\n", "needs propeller_diameter"},
             {"[[thrust]]\ntable = [[2, 1], [1, 2]]\n", "above the row before"},
             {"[[thrust]]\nconstnat = 1\n", "did you mean 'thrust.constant'"}}) {
        write_bytes(file, text);
        CAPTURE(text);
        CHECK_THROWS_WITH(read_thrusts(file), Catch::Contains(fault));
    }
}

TEST_CASE("the h-v curve of a sweep is that of its resistances, formulas beside it",
          "[attain][hv][analytic]") {
    const TempFolder folder;
    write_grid_of_thickness(folder);
    const auto sweep = sweep::read_sweep(folder.path());
    const HvStudy study = make_hv(sweep, {constant(8e5), {"weak", 1.5e5, 0.0, {}}}, {});
    CHECK_FALSE(study.level_ice);
    const HvCurve& curve = computed(study);
    REQUIRE(curve.points.size() == 2);
    // h 0.5: 1e5 + 1.5e5 u = 8e5; h 1: 2e5 + 3e5 u = 8e5
    CHECK(curve.points[0].thickness == 0.5);
    CHECK(curve.points[0].attained.speed == Near(7.0 / 1.5));
    CHECK(curve.points[0].attained.reach == Reach::outside);
    CHECK(curve.points[1].attained.speed == Near(2.0));
    CHECK(curve.points[1].attained.low < 2.0);
    CHECK(curve.points[1].attained.high > 2.0);
    CHECK_FALSE(study.warnings.empty());  // one speed outside the runs
    const std::string csv = hv_csv(study);
    CHECK_THAT(csv, Catch::StartsWith("source,curve,thrust,thickness_m,speed"));
    CHECK_THAT(csv, Catch::Contains(",weak,1,0,") && Catch::Contains(",stuck\r\n"));
    const std::string page = make_hv_page(sweep, study);
    CHECK(tag_fault(markup_of(page)).empty());
    CHECK_THAT(page, Catch::Contains("broken already"));
    CHECK_THROWS_WITH(make_hv(sweep, {}, {}), Catch::Contains("--thrust"));
}

TEST_CASE("free ships have their mean speeds, on one chart with prescribed courses", "[hv]") {
    const TempFolder folder;
    write_grid_of_thickness(folder);
    for (const double h : {0.5, 1.0})
        write_free_run(folder / fmt::format("free{}", h), h, h < 0.7 ? 3.0 : 0.02);
    const auto sweep = sweep::read_sweep(folder.path());
    const HvStudy study = make_hv(sweep, {constant(8e5)}, {});
    std::size_t free = 0;
    for (const HvCurve& curve : study.curves) {
        if (curve.source != Source::free_ship) continue;
        ++free;
        CHECK(curve.name == "free ship");  // its power is no axis of its own
        REQUIRE(curve.points.size() == 2);
        CHECK(curve.points[0].attained.high == Near(3.1));
        CHECK(curve.points[1].attained.reach == Reach::stuck);
    }
    CHECK(free == 1);
    CHECK(computed(study).points.size() == 2);
    CHECK_NOTHROW(make_hv(sweep, {}, {}));  // no thrust is needed then
}

TEST_CASE("a formula's h-v curve is where its own resistance meets the thrust",
          "[attain][hv][analytic]") {
    const TempFolder folder;
    write_grid_of_thickness(folder);
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        give_particulars(entry.path());
    const auto sweep = sweep::read_sweep(folder.path());
    const HvStudy study = make_hv(sweep, {constant(3e5)}, {});
    const HvCurve* jeong = nullptr;
    for (const HvCurve& curve : study.curves)
        if (curve.source == Source::formula && curve.name.starts_with("Jeong")) jeong = &curve;
    REQUIRE(jeong);
    CHECK(jeong->points.size() > 10);
    for (const HvPoint& p : jeong->points) {
        const IceConditions ice{p.thickness, 0.1, 900.0, 1025.0, 9.81, p.attained.speed};
        CHECK(spencer_resistance({95.0, 22.0, 8.0, 0.0, 0.0}, ice).broken_ice() ==
              Near(3e5).epsilon(1e-9));
    }
}

TEST_CASE("a formula that is no number at rest has no h-v curve", "[hv][degenerate]") {
    const TempFolder folder;
    write_grid_of_thickness(folder);
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        give_particulars(entry.path());
        Summary s = read_summary(entry.path() / "summary.json");
        s.ice.gravity = 0.0;  // the Froude number of Jeong's clearing is 0 / 0 at rest
        write_bytes(entry.path() / "summary.json", summary_text(s));
    }
    const HvStudy study = make_hv(sweep::read_sweep(folder.path()), {constant(5e5)}, {});
    CHECK(std::none_of(study.curves.begin(), study.curves.end(),
                       [](const HvCurve& c) { return c.source == Source::formula; }));
    CHECK(computed(study).points.size() == 2);
}

TEST_CASE("free ships alone have the formulas beside them once their thrust is given", "[hv]") {
    const TempFolder folder;
    for (const double h : {0.5, 1.0}) write_free_run(folder / fmt::format("free{}", h), h, 3.0 / h);
    const auto sweep = sweep::read_sweep(folder.path());
    const auto formulas = [&](const std::vector<Thrust>& thrusts) {
        const HvStudy study = make_hv(sweep, thrusts, {});
        return std::count_if(study.curves.begin(), study.curves.end(),
                             [](const HvCurve& c) { return c.source == Source::formula; });
    };
    CHECK(formulas({}) == 0);
    CHECK(formulas({constant(3e5)}) == 1);  // the others ask for the angles of the bow
    for (const HvCurve& curve : make_hv(sweep, {constant(3e5)}, {}).curves)
        CHECK(curve.source != Source::prescribed_course);
}
