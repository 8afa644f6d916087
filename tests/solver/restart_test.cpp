// SPDX-License-Identifier: GPL-3.0-or-later
// A run that is stopped and continued is the run that was never stopped.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "common/base/error.hpp"
#include "solver/run/run.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/compare_runs.hpp"
#include "tests/support/make_worlds.hpp"

using namespace ice;
using namespace ice::test;

namespace {

constexpr std::int64_t kSteps = 120;

// Pressure [Pa] low enough that the plate's impacts crush what they hit.
constexpr double kSoft = 5e3;

// A plate drives over a row of floes that buoyancy presses against it; the first floe is released
// at once, the next ones when touched. Rows and frames are no multiples of each other or of the
// step.
Case pressed_row(double crushing_pressure) {
    Case p;
    p.time_step = 0.01;
    p.duration = kSteps * p.time_step;
    p.average_from = 0.25;
    p.speed_table = {{0.0, 0.5}, {1.0, 1.0}};
    p.contact.crushing_pressure = crushing_pressure;
    p.frames_every = 0.07;
    p.history_every = 0.023;
    p.track = {1, 3};
    p.floes.resize(1);
    p.floes[0].hold = Hold::until_contact;
    p.resolved = "\n[simulation]\nduration = 1.2\n\n[contact]\nrestitution = 0.3\n";
    return p;
}

World make_world(const Case& parameters, double floe_radius = 0.05) {
    // a free ship floats
    const double depth = parameters.ship.any_free() ? 1.0 : 0.4;
    World w = plate_world(parameters, Vec3(3, 2, depth), 0.1, 0.2, -0.5);
    const auto box = add_shape(w, make_box_set(Vec3(0.5, 0.4, 0.2), floe_radius, 0.1));
    for (int k = 0; k < 4; ++k)
        add_floe(w.scene, box, 900.0, Vec3(0.55 * k, 0.05 * k, -0.6 - 0.002 * k),
                 Quaternion(Eigen::AngleAxisd(0.1 * k, Vec3(1, 2, 3).normalized())), 0, k > 0);
    // one more under the first: contacts between floes carry load, too
    add_floe(w.scene, box, 900.0, Vec3(0.1, 0, -0.805), Quaternion::Identity(), 0, false);
    return w;
}

// Runs until step `stop` and is interrupted there.
void run_until(const Case& parameters, const std::filesystem::path& folder, std::int64_t stop) {
    World w = make_world(parameters);
    RunOptions options{folder, "first"};
    options.keep_going = [&](double, const World& now) { return now.steps < stop; };
    REQUIRE(run(w, options).status == "interrupted");
    REQUIRE(w.steps == stop);
}

Summary go_on(const Case& parameters, const std::filesystem::path& checkpoint,
              const std::filesystem::path& folder) {
    World w = make_world(parameters);
    SavedRun saved = read_checkpoint(checkpoint, w);
    RunOptions options{folder, "first"};
    options.saved = &saved;
    return run(w, options);
}

// The hull with a floe, and two floes with each other, under load.
bool in_contact(const World& w) {
    return std::any_of(w.constraints.begin(), w.constraints.end(),
                       [](const Constraint& c) { return c.a == 0 && c.rest_normal > 0.0; }) &&
           std::any_of(w.constraints.begin(), w.constraints.end(),
                       [](const Constraint& c) { return c.a > 0 && c.rest_normal > 0.0; });
}

}  // namespace

TEST_CASE("a run continued from a checkpoint ends with the same bits and files",
          "[step][checkpoint]") {
    const double pressure = GENERATE(std::numeric_limits<double>::infinity(), kSoft);
    const std::int64_t stop = GENERATE(1, 2, 24, 25, 26, 70, 97, 119);
    CAPTURE(pressure, stop);
    const TempFolder folder;
    const Case p = pressed_row(pressure);
    World whole = make_world(p);
    run(whole, {folder / "whole", "first"});
    CHECK(in_contact(whole));
    // what is crushed is part of the state that goes on
    CHECK(whole.scene.crushed.displacement.empty() == std::isinf(pressure));

    run_until(p, folder / "parts", stop);
    go_on(p, folder / "parts" / "checkpoint.h5", folder / "parts");
    check_same_runs(folder / "whole", folder / "parts", p.track);
}

TEST_CASE("a free ship goes on with the same bits", "[step][checkpoint][ship]") {
    const std::int64_t stop = GENERATE(1, 25, 70);
    CAPTURE(stop);
    const TempFolder folder;
    Case p = pressed_row(kSoft);
    p.speed_table = {{0.0, 0.8}};
    p.ship.free.fill(true);
    p.ship.added_mass.fill(0.1);
    p.ship.damping = {100.0, 100.0, 0.1, 0.1, 0.1, 100.0};
    p.propulsion.hold_speed = 1.0;
    World whole = make_world(p);
    run(whole, {folder / "whole", "first"});
    CHECK(in_contact(whole));
    CHECK(whole.ship.angles().norm() > 0.0);

    run_until(p, folder / "parts", stop);
    go_on(p, folder / "parts" / "checkpoint.h5", folder / "parts");
    check_same_runs(folder / "whole", folder / "parts", p.track);
}

TEST_CASE("contacts are active at the steps where the runs above are stopped",
          "[step][checkpoint]") {
    World w = make_world(pressed_row(std::numeric_limits<double>::infinity()));
    for (int k = 0; k < 24; ++k) step(w);
    CHECK(in_contact(w));
    for (int k = 24; k < 97; ++k) step(w);
    CHECK(in_contact(w));
}

TEST_CASE("ice is crushed before the runs above are stopped and goes on being crushed after",
          "[step][checkpoint]") {
    World w = make_world(pressed_row(kSoft));
    for (int k = 0; k < 24; ++k) step(w);
    const auto crushed = [&] {
        double sum = 0.0;
        for (const Vec3& r : w.scene.crushed.displacement) sum += r.norm();
        return sum;
    };
    const double before = crushed();
    CHECK(before > 0.0);
    for (int k = 24; k < kSteps; ++k) step(w);
    CHECK(crushed() > before);
}

namespace {

// A plate squeezes a floe against unbroken ice, after another floe has flown into it at 12 m/s.
World jam_world(const Case& parameters) {
    World w = plate_world(parameters, Vec3(3, 2, 2), 0.1, 0.2, -1.0);
    const auto box = add_shape(w, make_box_set(Vec3(0.5, 0.4, 0.2), 0.05, 0.1));
    add_floe(w.scene, box, 900.0, Vec3(1.755, 0, 0), Quaternion::Identity(), 0, false);
    add_floe(w.scene, box, 900.0, Vec3(2.262, 0, 0), Quaternion::Identity(), 1, true);
    const std::size_t thrown =
        add_floe(w.scene, box, 900.0, Vec3(0, 3, 0), Quaternion::Identity(), 0, false);
    w.scene.bodies.momentum[thrown] = w.scene.bodies.mass[thrown] * Vec3(0, -12, 0);
    update_derived(w.scene.bodies, thrown);
    return w;
}

Case jam_case() {
    Case p = empty_space(0.01);
    p.duration = 0.4;
    p.speed_table = {{0.0, 0.5}};
    p.contact.iterations = 50;
    p.contact.restitution = 0.0;
    p.floes.push_back(p.floes[0]);
    p.floes[1].hold = Hold::always;
    p.resolved = "\n[simulation]\nduration = 0.4\n";
    return p;
}

}  // namespace

TEST_CASE("a run stopped in the middle of a jam has the summary of the whole run",
          "[step][checkpoint]") {
    const TempFolder folder;
    const Case p = jam_case();
    World whole = jam_world(p);
    const Summary expected = run(whole, {folder / "whole", "first"});
    const auto warned = [&](const char* words) {
        return std::any_of(
            expected.warnings.begin(), expected.warnings.end(),
            [&](const Warning& w) { return w.text.find(words) != std::string::npos; });
    };
    // all that the statistics keep of a jam is there to be compared, and of bodies too fast
    CHECK(warned("jam: in "));
    CHECK(warned("first floe 1 at t = 0.0"));
    CHECK(expected.max_overlap > 0.0);
    CHECK(warned("the hull and floe 3 met at 12 m/s at t = "));

    World w = jam_world(p);
    RunOptions options{folder / "parts", "first"};
    options.keep_going = [](double, const World& now) { return now.steps < 20; };
    const Summary half = run(w, options);
    REQUIRE(half.status == "interrupted");
    World again = jam_world(p);
    SavedRun saved = read_checkpoint(folder / "parts" / "checkpoint.h5", again);
    RunOptions rest{folder / "parts", "first"};
    rest.saved = &saved;
    run(again, rest);
    check_same_runs(folder / "whole", folder / "parts", {});
}

TEST_CASE("a run stopped three times, once in each folder, is still the same run",
          "[step][checkpoint]") {
    const TempFolder folder;
    const Case p = pressed_row(kSoft);
    World whole = make_world(p);
    run(whole, {folder / "whole", "first"});

    run_until(p, folder / "a", 10);
    std::filesystem::path from = folder / "a";
    for (const auto& [name, stop] : {std::pair("b", 33), std::pair("b", 34), std::pair("c", 80)}) {
        World w = make_world(p);
        SavedRun saved = read_checkpoint(from / "checkpoint.h5", w);
        RunOptions options{folder / name, "first"};
        options.saved = &saved;
        const std::int64_t last = stop;
        options.keep_going = [&](double, const World& now) { return now.steps < last; };
        REQUIRE(run(w, options).status == "interrupted");
        from = folder / name;
    }
    go_on(p, from / "checkpoint.h5", from);
    check_same_runs(folder / "whole", from, p.track);
    // the folders that were only read are as they were
    CHECK(read_summary(folder / "a" / "summary.json").steps == 10);
    CHECK(std::filesystem::exists(folder / "a" / "run.h5"));
}

TEST_CASE("a finished run goes on to a longer duration", "[step][checkpoint]") {
    const TempFolder folder;
    const Case p = pressed_row(kSoft);
    World whole = make_world(p);
    run(whole, {folder / "whole", "first"});

    Case half = p;
    half.duration = 0.59;  // within a row of the histories
    half.resolved = "\n[simulation]\nduration = 0.59\n\n[contact]\nrestitution = 0.3\n";
    World w = make_world(half);
    RunOptions options{folder / "parts", "first"};
    options.checkpoint_every = 1000.0;  // at the end only
    REQUIRE(run(w, options).status == "completed");
    go_on(p, folder / "parts" / "checkpoint.h5", folder / "parts");
    check_same_runs(folder / "whole", folder / "parts", p.track);

    // and nothing is left to do for the shorter one: the same files again
    World again = make_world(half);
    run(again, {folder / "half", "first"});
    go_on(half, folder / "parts" / "checkpoint.h5", folder / "same");
    check_same_runs(folder / "half", folder / "same", p.track);
}

TEST_CASE("checkpoints are written at the multiples of checkpoint_every and at the end",
          "[step][checkpoint]") {
    const TempFolder folder;
    World w = make_world(pressed_row(kSoft));
    RunOptions options{folder / "r", "first"};
    options.checkpoint_every = 0.352;
    std::vector<std::int64_t> steps;
    options.keep_going = [&](double, const World&) {
        World now = make_world(pressed_row(kSoft));
        if (!std::filesystem::exists(folder / "r" / "checkpoint.h5")) return true;
        read_checkpoint(folder / "r" / "checkpoint.h5", now);
        if (steps.empty() || steps.back() != now.steps) steps.push_back(now.steps);
        return true;
    };
    run(w, options);
    CHECK(steps ==
          std::vector<std::int64_t>{35, 70, 106, 120});  // nearest to 0.352, 0.704, 1.056; 1.2 s
    for (const auto& entry : std::filesystem::directory_iterator(folder / "r"))
        CHECK_FALSE(entry.path().filename().string().starts_with("checkpoint-rows"));
}

TEST_CASE("a checkpoint that cannot be written ends the run with the reason, not with a full disk",
          "[step][checkpoint][errors]") {
    const TempFolder folder;
    World w = make_world(pressed_row(kSoft));
    RunOptions options{folder / "run", "first"};
    options.checkpoint_every = 0.3;
    options.keep_going = [&](double, const World& now) {
        // a folder in the checkpoint's place
        if (now.steps == 10) std::filesystem::create_directories(folder / "run/checkpoint.h5/in");
        return true;
    };
    const std::string text = error_text([&] { run(w, options); });
    CHECK_THAT(text, Catch::Contains("checkpoint.h5") && !Catch::Contains("disk is almost full"));
    const Summary kept = read_summary(folder / "run" / "summary.json");
    CHECK(kept.status == "failed");
    REQUIRE(!kept.warnings.empty());
    for (const Warning& warning : kept.warnings)
        CHECK_THAT(warning.text, !Catch::Contains("disk is almost full"));
    CHECK(std::any_of(kept.warnings.begin(), kept.warnings.end(), [](const Warning& warning) {
        return warning.text.find("checkpoint.h5") != std::string::npos;
    }));
}

TEST_CASE("files that are lost begin at the checkpoint, and the summary says so",
          "[step][checkpoint]") {
    const TempFolder folder;
    const Case p = pressed_row(kSoft);
    World whole = make_world(p);
    const Summary expected = run(whole, {folder / "whole", "first"});
    run_until(p, folder / "parts", 50);
    for (const char* name : {"run.h5", "floe_1.csv"})
        std::filesystem::remove(folder / "parts" / name);

    const Summary s = go_on(p, folder / "parts" / "checkpoint.h5", folder / "parts");
    CHECK(s.state_hash == expected.state_hash);
    CHECK(s.resistance.mean == expected.resistance.mean);
    REQUIRE(s.warnings.size() == expected.warnings.size() + 2);
    CHECK(read_bytes(folder / "parts" / "forces.csv") ==
          read_bytes(folder / "whole" / "forces.csv"));
    const RunData rest = read_run(folder / "parts" / "run.h5");
    CHECK(rest.history.front().time > 0.5);
    CHECK(rest.history.back().time == read_run(folder / "whole" / "run.h5").history.back().time);
}

TEST_CASE("a checkpoint of another case or sphere set is refused with the key's name",
          "[step][checkpoint][errors]") {
    const TempFolder folder;
    const Case p = pressed_row(kSoft);
    run_until(p, folder / "r", 20);
    const auto text_of = [&](const Case& now, double radius) {
        return error_text([&] {
            World w = make_world(now, radius);
            read_checkpoint(folder / "r" / "checkpoint.h5", w);
        });
    };
    CHECK(text_of(p, 0.05).empty());
    Case other = p;
    other.resolved = "\n[simulation]\nduration = 9.0\n\n[contact]\nrestitution = 0.2\n";
    CHECK_THAT(text_of(other, 0.05),
               Catch::Contains("contact.restitution: 0.3 in the checkpoint, 0.2 in the case") &&
                   !Catch::Contains("duration: "));
    CHECK_THAT(text_of(p, 0.04), Catch::Contains("floes.1.spheres"));
    Case shorter = p;
    shorter.duration = 0.1;
    CHECK_THAT(text_of(shorter, 0.05),
               Catch::Contains("simulation.duration") && Catch::Contains("which is at 0.2 s"));
}

TEST_CASE("a checkpoint that holds a NaN is refused with the floe's number",
          "[step][checkpoint][errors]") {
    const TempFolder folder;
    const Case p = pressed_row(kSoft);
    World w = make_world(p);
    Recorder recorder(p, w.scene);
    recorder.open(folder.path(), "first", w.scene);
    RunProgress progress;
    w.scene.bodies.angular_momentum[2].y() = std::numeric_limits<double>::quiet_NaN();
    write_checkpoint(folder / "checkpoint.h5", w, recorder, progress);
    CHECK_THAT(error_text([&] {
                   World again = make_world(p);
                   read_checkpoint(folder / "checkpoint.h5", again);
               }),
               Catch::Contains("checkpoint.h5: holds a NaN or infinity for floe 2"));
}

TEST_CASE("a checkpoint is refused when any floe of a group has another shape",
          "[step][checkpoint][errors]") {
    const TempFolder folder;
    Case p = pressed_row(kSoft);
    p.floes[0].pattern = GENERATE(Pattern::file, Pattern::grid);
    // the last floe's shape stays, as that of a field's last floe may
    const auto make = [&](double radius) {
        World w = make_world(p, radius);
        const auto last = add_shape(w, make_box_set(Vec3(0.6, 0.4, 0.2), 0.05, 0.1));
        add_floe(w.scene, last, 900.0, Vec3(20, 0, -0.1), Quaternion::Identity(), 0, true);
        return w;
    };
    World w = make(0.05);
    RunOptions options{folder / "r", "first"};
    options.keep_going = [](double, const World& now) { return now.steps < 5; };
    run(w, options);
    const auto text_of = [&](double radius) {
        return error_text([&] {
            World again = make(radius);
            read_checkpoint(folder / "r" / "checkpoint.h5", again);
        });
    };
    CHECK(text_of(0.05).empty());
    CHECK_THAT(text_of(0.04), Catch::Contains(p.floes[0].pattern == Pattern::file
                                                  ? "floes.1.file: the field holds other floes"
                                                  : "floes.1.spheres: the file holds another"));
}
