// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/summary_file.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "common/base/version.hpp"
#include "common/formats/spheres_report.hpp"
#include "tests/common/fixtures.hpp"

using namespace ice;
using namespace ice::test;

namespace {

Summary make_summary() {
    Summary s;
    s.title = "Pre-sawn channel";
    s.simd = "avx2";
    s.steps = 3000;
    s.simulated_s = 30.0;
    s.wall_s = 7.5;
    s.threads = 2;
    s.state_hash = 0x00ab12cd34ef5678ull;
    s.hull_spheres = 1200;
    s.ice_spheres = 43200;
    s.floes_total = 180;
    s.floes_moved = 90;
    s.floes_behind = 12;
    s.average_from = 10.0;
    s.resistance = {1100.5, 1000.25, 100.25, 220.0, 3100.0, 12.5};
    s.lateral = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
    s.vertical = {0.1, 0.2, 0.3, 0.4, 0.5, 1.0 / 3.0};
    s.regions["bow"] = {
        17, 42.5, {-900.0, 1.0, 200.0}, {-800.0, 0.75, 250.0}, {-100.0, 0.25, -50.0}};
    s.contacts_mean = 12.5;
    s.contacts_max = 40.0;
    s.max_overlap = 0.001;
    s.unconverged_steps = 3;
    s.energy["kinetic_J"] = 55.0;
    s.stage_seconds["narrow"] = 2.5;
    s.lindqvist_submersion = 950.0;
    s.ship = {100.0, 20.5, 8.0, 9.5e6, 25.0, 30.0, 2.5, kUnknown, kUnknown, {}, {}};
    s.ice = {1.0, 140, 2.5, 6.25, 12.0, 0.8, 900.0, 0.1, 0.3, 1e6, {"never", "always"}};
    s.travel = {150.0, 1.5, 1.0};
    s.formulas = {{"Lindqvist 1989", "submersion", 950.0, false}};
    s.warnings = {{"floe 3 fell off", true, 0.125}, {"a picture is wrong", false}, {"who knows"}};
    s.case_file = "channel.cfg";
    return s;
}

Summary written_and_read(const Summary& summary) {
    const TempFolder folder;
    write_bytes(folder / "summary.json", summary_text(summary));
    return read_summary(folder / "summary.json");
}

// The keys that the summary of make_summary() has, in their order.
constexpr const char* kKeys[] = {"schema",
                                 "status",
                                 "title",
                                 "steps",
                                 "simulated_s",
                                 "wall_s",
                                 "realtime_factor",
                                 "threads",
                                 "simd",
                                 "state_hash",
                                 "spheres",
                                 "hull",
                                 "ice",
                                 "floes",
                                 "total",
                                 "moved",
                                 "behind",
                                 "ship",
                                 "length_m",
                                 "breadth_m",
                                 "draught_m",
                                 "displacement_kg",
                                 "stem_angle_deg",
                                 "entrance_angle_deg",
                                 "speed_mean",
                                 "ice",
                                 "thickness_m",
                                 "floes",
                                 "floe_size_min_m",
                                 "floe_size_mean_m",
                                 "floe_size_max_m",
                                 "concentration",
                                 "density_kg_per_m3",
                                 "friction_ship_ice",
                                 "friction_ice_ice",
                                 "crushing_pressure_Pa",
                                 "hold",
                                 "travel",
                                 "distance_m",
                                 "lengths",
                                 "averaged_lengths",
                                 "resistance",
                                 "mean_N",
                                 "contact_mean_N",
                                 "friction_mean_N",
                                 "std_N",
                                 "max_N",
                                 "ci95_N",
                                 "lateral",
                                 "vertical",
                                 "regions",
                                 "hits",
                                 "max_impulse_Ns",
                                 "mean_N",
                                 "contact_mean_N",
                                 "friction_mean_N",
                                 "contacts",
                                 "mean",
                                 "max",
                                 "max_overlap_m",
                                 "unseen_overlap_m",
                                 "unconverged_steps",
                                 "energy",
                                 "lindqvist_submersion_N",
                                 "formulas",
                                 "name",
                                 "part",
                                 "value_N",
                                 "verified",
                                 "warnings",
                                 "version",
                                 "git_commit",
                                 "compiler"};

}  // namespace

TEST_CASE("a summary comes back with all digits", "[formats]") {
    const Summary s = make_summary(), back = written_and_read(s);
    CHECK(back.status == "completed");
    CHECK(back.title == s.title);
    CHECK(back.steps == 3000);
    CHECK(back.state_hash == s.state_hash);
    CHECK(back.ice_spheres == 43200);
    CHECK(back.floes_behind == 12);
    CHECK(back.average_from == 10.0);
    CHECK(back.resistance.mean == 1100.5);
    CHECK(back.resistance.ci95 == 12.5);
    CHECK(back.vertical.ci95 == 1.0 / 3.0);
    CHECK(back.regions.at("bow").hits == 17);
    CHECK(back.regions.at("bow").mean == s.regions.at("bow").mean);
    CHECK(back.regions.at("bow").contact_mean == s.regions.at("bow").contact_mean);
    CHECK(back.regions.at("bow").friction_mean == s.regions.at("bow").friction_mean);
    CHECK(back.unconverged_steps == 3);
    CHECK(back.energy == s.energy);
    CHECK(back.stage_seconds == s.stage_seconds);
    CHECK(back.lindqvist_submersion == s.lindqvist_submersion);
    CHECK(back.warnings == s.warnings);
    CHECK(back.case_file == "channel.cfg");
    CHECK(summary_text(back) == summary_text(s));
}

TEST_CASE("warnings that are plain texts, as version 0.1 wrote them, are read", "[formats]") {
    Summary s = make_summary();
    s.warnings.clear();
    std::string text = summary_text(s);
    const std::string none = "\"warnings\": []";
    text.replace(text.find(none), none.size(), "\"warnings\": [\"floe 3 fell off\", \"jam\"]");
    const TempFolder folder;
    write_bytes(folder / "summary.json", text);
    const Summary back = read_summary(folder / "summary.json");
    REQUIRE(back.warnings.size() == 2);
    CHECK(back.warnings[0] == Warning{"floe 3 fell off"});
    CHECK(with_verdict(back.warnings[1]) == "jam (effect on the mean resistance: not measured)");
}

TEST_CASE("a warning says behind its text what it does to the mean", "[formats]") {
    CHECK(with_verdict({"jam", true, 0.125}) ==
          "jam (affects the mean resistance: about 12 % of it)");
    CHECK(with_verdict({"jam", true, 0.99}) ==
          "jam (affects the mean resistance: about 99 % of it)");
    // a share of the whole, as of a mean of 0, and more than the whole are no parts of the mean
    for (const double share : {0.996, 1.0, 7.11})
        CHECK(with_verdict({"jam", true, share}) == "jam (the mean cannot be trusted)");
    CHECK(with_verdict({"jam", true}) == "jam (affects the mean resistance)");
    CHECK(with_verdict({"jam", false, 0.003}) ==
          "jam (hardly affects the mean resistance: about 0.3 % of it)");
    CHECK(with_verdict({"jam", false}) == "jam (does not affect the mean resistance)");
}

TEST_CASE("the share of the mean that warnings affect is the largest of those that affect it",
          "[formats]") {
    CHECK(affected_share({}) == 0.0);
    CHECK(affected_share({{"overlap", false, 0.01}, {"flow", false}}) == 0.0);
    CHECK(affected_share({{"overlap", false, 0.01}, {"jam", true, 0.125}, {"trend", true, 0.2}}) ==
          0.2);
    // no part of a mean is larger than the mean
    CHECK(affected_share({{"jam", true, 7.11}}) == 1.0);
    // without a number nothing is known, unless another warning has one
    CHECK_FALSE(affected_share({{"nothing touched anything", true}}));
    CHECK_FALSE(affected_share({{"of an older program"}}));
    CHECK(affected_share({{"nothing touched anything", true}, {"jam", true, 0.3}}) == 0.3);
}

TEST_CASE("an ensemble and the figures of its interval come back", "[formats]") {
    Summary s = make_summary();
    s.resistance.correlation_time = 0.75;
    s.resistance.effective_samples = 26.5;
    s.resistance.trend = -12.0;
    s.resistance.trend_significant = false;
    s.ensemble = {
        1100.0, 25.5, {1090.0, 1110.0, std::numeric_limits<double>::quiet_NaN()}, {1, 2, 7}};
    const Summary back = written_and_read(s);
    CHECK(back.resistance.correlation_time == 0.75);
    CHECK(back.resistance.effective_samples == 26.5);
    CHECK(back.resistance.trend == -12.0);
    CHECK(back.resistance.trend_significant == false);
    CHECK_FALSE(back.lateral.trend_significant);
    REQUIRE(back.ensemble);
    CHECK(back.ensemble->mean == 1100.0);
    CHECK(back.ensemble->ci95 == 25.5);
    CHECK(back.ensemble->means[1] == 1110.0);
    CHECK(std::isnan(back.ensemble->means[2]));
    CHECK(back.ensemble->seeds == s.ensemble->seeds);
    CHECK(summary_text(back) == summary_text(s));
    CHECK_THAT(summary_text(s), Catch::Contains("\"members\": 3"));
}

TEST_CASE("in 2D forces have a second name that says they are per metre", "[formats]") {
    Summary s = make_summary();
    s.ensemble = {1100.0, 25.5, {1090.0, 1110.0}, {1, 2}};
    const TempFolder folder;
    write_bytes(folder / "three.json", summary_text(s));
    for (const auto& [key, value] : read_json_numbers(folder / "three.json"))
        CHECK_FALSE(key.ends_with("_per_m"));
    s.dimension = 2;
    write_bytes(folder / "two.json", summary_text(s));
    const auto numbers = read_json_numbers(folder / "two.json");
    for (const char* key : {"resistance.mean_N", "resistance.ci95_N", "lateral.std_N",
                            "regions.bow.max_impulse_Ns", "energy.kinetic_J", "ensemble.mean_N"}) {
        CAPTURE(key);
        CHECK(numbers.at(key) == numbers.at(std::string(key) + "_per_m"));
    }
    CHECK(numbers.at("regions.bow.mean_N_per_m.2") == 200.0);
    CHECK(read_summary(folder / "two.json").energy == s.energy);
}

TEST_CASE("ship, ice, travel and formulas come back, rigid ice and unknowns as null", "[formats]") {
    Summary s = make_summary();
    const Summary back = written_and_read(s);
    CHECK(back.ship.length == 100.0);
    CHECK(back.ship.entrance_angle_deg == 30.0);
    CHECK(back.ship.speed_mean == 2.5);
    CHECK(back.ship.motion.empty());
    CHECK_FALSE(back.ship.stuck.has_value());
    CHECK(back.ice.floes == 140);
    CHECK(back.ice.floe_size_mean == 6.25);
    CHECK(back.ice.crushing_pressure == 1e6);
    CHECK(back.ice.hold == s.ice.hold);
    CHECK(back.ice.bending_model.empty());
    CHECK(std::isnan(back.ice.bending_factor));
    CHECK_FALSE(back.cracks);
    CHECK(back.travel.averaged_lengths == 1.0);
    REQUIRE(back.formulas.size() == 1);
    CHECK(back.formulas[0].name == "Lindqvist 1989");
    CHECK(back.formulas[0].value == 950.0);

    s.ice.bending_model = "kashtelyan";
    s.ice.bending_factor = 3.1;
    s.cracks = CrackParticulars{.pieces = 12.0,
                                .radius = 2.5,
                                .characteristic_length = 10.0,
                                .thickness = 0.5,
                                .opening_deg = 120.0,
                                .load = 1e5,
                                .channel_breadth = 16.0};
    CHECK_THAT(summary_text(s), Catch::Contains("\"crack_radius_per_length\": 0.25") &&
                                    Catch::Contains("\"crack_radius_per_thickness\": 5.0"));
    const Summary bent = written_and_read(s);
    CHECK(bent.ice.bending_model == "kashtelyan");
    CHECK(bent.ice.bending_factor == 3.1);
    REQUIRE(bent.cracks);
    CHECK(bent.cracks->pieces == 12.0);
    CHECK(bent.cracks->per_length() == 0.25);
    CHECK(bent.cracks->per_thickness() == 5.0);
    CHECK(bent.cracks->opening_deg == 120.0);
    CHECK(bent.cracks->load == 1e5);
    CHECK(bent.cracks->channel_breadth == 16.0);

    s.ice.crushing_pressure = std::numeric_limits<double>::infinity();
    s.ice.concentration = s.ship.breadth = kUnknown;
    CHECK_THAT(summary_text(s), Catch::Contains("\"crushing_pressure_Pa\": null"));
    const Summary unknown = written_and_read(s);
    CHECK(std::isinf(unknown.ice.crushing_pressure));
    CHECK(std::isnan(unknown.ice.concentration));
    CHECK(std::isnan(unknown.ship.breadth));

    s.ship.motion = {{"heave_mean_m", -0.02}, {"speed_ci95", kUnknown}};
    s.ship.stuck = true;
    const Summary moved = written_and_read(s);
    REQUIRE(moved.ship.motion.size() == 2);
    CHECK(moved.ship.motion[0] == s.ship.motion[0]);
    CHECK(std::isnan(moved.ship.motion[1].second));
    CHECK(moved.ship.stuck == true);
}

TEST_CASE("summary.json holds the contract's keys in the contract's order", "[formats]") {
    const std::string text = summary_text(make_summary());
    std::size_t at = 0;
    for (const char* key : kKeys) {
        CAPTURE(key);
        const std::size_t found = text.find("\"" + std::string(key) + "\":", at);
        REQUIRE(found != std::string::npos);
        at = found;
    }
    CHECK_THAT(text, Catch::Contains("\"schema\": \"icesolve-summary/1\""));
    CHECK_THAT(text, Catch::Contains("\"state_hash\": \"00ab12cd34ef5678\""));
    CHECK_THAT(text, Catch::Contains("\"realtime_factor\": 4.0"));
    CHECK_THAT(text, Catch::Contains(std::string("\"version\": \"") + version()));
}

TEST_CASE("numbers that are not finite become null and read back as NaN", "[formats]") {
    Summary s = make_summary();
    s.resistance.ci95 = std::numeric_limits<double>::quiet_NaN();
    s.wall_s = 0.0;  // then the real-time factor is infinite
    s.lindqvist_submersion.reset();
    CHECK_THAT(summary_text(s), Catch::Contains("\"ci95_N\": null"));
    CHECK_THAT(summary_text(s), Catch::Contains("\"realtime_factor\": null"));
    CHECK_THAT(summary_text(s), Catch::Contains("\"lindqvist_submersion_N\": null"));
    const Summary back = written_and_read(s);
    CHECK(std::isnan(back.resistance.ci95));
    CHECK_FALSE(back.lindqvist_submersion);
}

TEST_CASE("all numbers of a JSON file are found by dotted key", "[formats]") {
    const TempFolder folder;
    write_bytes(folder / "summary.json", summary_text(make_summary()));
    const auto numbers = read_json_numbers(folder / "summary.json");
    CHECK(numbers.at("resistance.mean_N") == 1100.5);
    CHECK(numbers.at("floes.moved") == 90.0);
    CHECK(numbers.at("regions.bow.mean_N.0") == -900.0);
    CHECK(numbers.at("energy.kinetic_J") == 55.0);
    CHECK(numbers.count("title") == 0);
    // unknown, but there: make_summary() leaves the parallel part's length out
    REQUIRE(numbers.count("ship.parallel_length_m") == 1);
    CHECK(std::isnan(numbers.at("ship.parallel_length_m")));
}

TEST_CASE("a summary with a missing key or a wrong type names file and key", "[formats]") {
    const TempFolder folder;
    const std::string text = summary_text(make_summary());
    const auto complaint = [&](const std::string& from, const std::string& to) {
        std::string changed = text;
        changed.replace(changed.find(from), from.size(), to);
        write_bytes(folder / "summary.json", changed);
        return error_text([&] { read_summary(folder / "summary.json"); });
    };
    CHECK_THAT(complaint("\"std_N\"", "\"std\""),
               Catch::Contains("summary.json: resistance.std_N: is missing"));
    CHECK_THAT(complaint("\"steps\": 3000", "\"steps\": \"many\""),
               Catch::Contains("steps: has the wrong type"));
    CHECK_THAT(complaint("\"length_m\": 100.0", "\"length_m\": \"long\""),
               Catch::Contains("ship: has the wrong type"));
    CHECK_THAT(complaint("icesolve-summary/1", "other/1"),
               Catch::Contains("schema: is not icesolve-summary/1"));
    CHECK_THAT(complaint("{", ""), Catch::Contains("is not valid JSON"));
    CHECK_THAT(error_text([&] { read_summary(folder / "no.json"); }),
               Catch::Contains("file not found"));
}

TEST_CASE("spherize's JSON holds the contract's keys", "[formats]") {
    SpheresReport report;
    report.spheres = 240;
    report.inertia_unit_density = {1, 2, 3, 0, 0, 0};
    report.thin_features.push_back({{1.0, 2.0, 3.0}, 0.05});
    report.repairs.emplace_back("weld", 12);
    report.guessed["up"] = "z";
    report.seconds["fill"] = 0.5;
    const TempFolder folder;
    const std::string text = spheres_report_text(report);
    write_bytes(folder / "x.json", text);
    const auto numbers = read_json_numbers(folder / "x.json");
    for (const char* key : {"dimension",
                            "radius_m",
                            "spacing_m",
                            "spheres",
                            "surface_spheres",
                            "volume_m3",
                            "area_m2",
                            "centroid_m.2",
                            "inertia_unit_density.5",
                            "protrusion_max_m",
                            "covering_radius_m",
                            "gap_p50_m",
                            "gap_p99_m",
                            "gap_max_m",
                            "normal_error_mean_deg",
                            "normal_error_p99_deg",
                            "thin_features.0.at_m.1",
                            "thin_features.0.size_m",
                            "repairs.0.count",
                            "seconds.fill"}) {
        CAPTURE(key);
        CHECK(numbers.count(key) == 1);
    }
    CHECK(numbers.at("spheres") == 240.0);
    CHECK_THAT(text, Catch::Contains("\"schema\": \"spherize/1\""));
    CHECK_THAT(text, Catch::Contains("\"step\": \"weld\""));
    CHECK_THAT(text, Catch::Contains("\"up\": \"z\""));
}
