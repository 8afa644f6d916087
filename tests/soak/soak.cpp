// SPDX-License-Identifier: GPL-3.0-or-later
// An hour of simulated time in one process: what drifts, grows or breaks shows. docs/soak.md has
// the figures.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"
#include "common/cli/console.hpp"
#include "solver/loads/potential_energy.hpp"
#include "solver/run/run.hpp"
#include "solver/run/run_folder.hpp"
#include "tests/soak/basin.hpp"

using namespace ice;

namespace {

struct Options {
    std::filesystem::path out = "soak-run";
    double duration = 3600.0, row = soak::kPeriod;  // simulated [s]
    int threads = 1;
};

// Resident memory of this process [MB].
double resident_megabytes() {
    std::ifstream file("/proc/self/statm");
    double total = 0.0, resident = 0.0;
    file >> total >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

// What is looked at over one row of the table.
struct Row {
    double time = 0.0;        // at its end [s]
    double kinetic = 0.0;     // mean over the row's steps [J]
    double fastest = 0.0;     // floe, at any step [m/s]
    double overlap = 0.0;     // deepest of any step [m]
    double contacts = 0.0;    // that pressed, mean
    double dissipated = 0.0;  // friction, impacts, crushing and drag since the start [J]
    double residual = 0.0;    // of the energy ledger since the start [J]
    double potential = 0.0;   // of the floes above the start's [J]
    double memory = 0.0;      // [MB]
    std::int64_t steps = 0, idle_steps = 0;  // idle: no contact pressed
    int escaped = 0;

    // of a share of nothing rounding makes anything: before the first contact that is 1e-30 J
    double share() const { return dissipated > 1.0 ? residual / dissipated : 0.0; }
};

void add_step(Row& row, const World& w) {
    ++row.steps;
    row.kinetic += kinetic_energy(w.scene.bodies);
    for (const std::int32_t i : w.scene.bodies.moving)
        row.fastest = std::max(row.fastest, w.scene.bodies.velocity[i].norm());
    int pressed = 0;
    for (const Constraint& c : w.constraints) {
        row.overlap = std::max(row.overlap, -c.gap);
        pressed += c.total_normal() > 0.0;
    }
    row.contacts += pressed;
    row.idle_steps += pressed == 0;
}

Row close_row(Row row, const World& w) {
    const EnergyLedger& l = w.ledger;
    const double potential = potential_energy(w.scene, w.parameters);
    row.time = w.time;
    row.kinetic /= static_cast<double>(row.steps);
    row.contacts /= static_cast<double>(row.steps);
    row.dissipated = l.friction + l.restitution + l.crushing + l.drag;
    row.residual = l.residual(potential);
    row.potential = potential - l.potential_start.value_or(potential);
    row.memory = resident_megabytes();
    row.escaped = soak::count_escaped(w);
    return row;
}

void print_row(const Row& r) {
    fmt::print(
        "| {:.0f} | {:.0f} | {:.1f} | {:.1f} | {:.0f} | {:.1f} | {:+.3f} | {:.1f} | {:.2f} | "
        "{:.1f} |\n",
        r.time, r.contacts,
        100.0 * static_cast<double>(r.idle_steps) / static_cast<double>(r.steps), r.kinetic,
        r.potential, r.dissipated / 1e3, 100.0 * r.share(), 1e3 * r.overlap, r.fastest, r.memory);
    std::fflush(stdout);
}

// Bounds of the figures. The ledger's is that above which every run warns; a contact opens a tenth
// of the thickness within some steps, and floes that rock on each other come deeper; 2 m/s is what
// weight and buoyancy give a floe that rises 2 m without drag, from twice the depth there is.
// Memory follows the busiest step so far, so that it is the second half of the hour that must not
// grow.
constexpr double kMostUnexplained = 0.005, kMostOverlap = 0.1 * soak::kThickness;
constexpr double kMostSpeed = 2.0, kMostGrowth = 0.05;
constexpr double kLong = 1800.0;  // simulated time from which memory is held to its bound [s]

bool holds(bool good, const std::string& text) {
    fmt::print("{}: {}\n", good ? "good" : "BAD", text);
    return good;
}

bool judge(const std::vector<Row>& rows) {
    double unexplained = 0.0, overlap = 0.0, fastest = 0.0;
    int escaped = 0;
    for (const Row& r : rows) {
        unexplained = std::max(unexplained, std::abs(r.share()));
        overlap = std::max(overlap, r.overlap);
        fastest = std::max(fastest, r.fastest);
        escaped = std::max(escaped, r.escaped);
    }
    const double growth = rows.back().memory / rows[rows.size() / 2].memory - 1.0;
    // no short-circuit: every verdict is printed
    bool good = holds(escaped == 0, fmt::format("{} floes left the basin", escaped));
    good &= holds(unexplained <= kMostUnexplained,
                  fmt::format("at most {:.3f} % of the dissipated energy unexplained, bound {} %",
                              100.0 * unexplained, 100.0 * kMostUnexplained));
    good &= holds(overlap <= kMostOverlap, fmt::format("deepest overlap {:.1f} mm, bound {:.0f} mm",
                                                       1e3 * overlap, 1e3 * kMostOverlap));
    good &= holds(fastest <= kMostSpeed,
                  fmt::format("fastest floe {:.2f} m/s, bound {} m/s", fastest, kMostSpeed));
    good &= holds(growth <= kMostGrowth || rows.back().time < kLong,
                  fmt::format("memory grew by {:.1f} % in the second half, "
                              "bound {:.0f} %",
                              100.0 * growth, 100.0 * kMostGrowth));
    return good;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Stirs a basin of 400 floes for an hour of simulated time.", "soak");
    Options o;
    app.add_option("--out", o.out, "Run folder (soak-run)");
    app.add_option("--duration", o.duration, "Simulated seconds (3600)");
    app.add_option("--row", o.row, "Simulated seconds per row of the table (360)");
    app.add_option("--threads", o.threads, "Threads (1)");
    CLI11_PARSE(app, argc, argv);
    start_messages(Colour::automatic, true);
    return run_program("soak", [&] {
        set_thread_count(o.threads);
        World world = soak::make_basin(o.duration);
        fmt::print(
            "| t [s] | contacts | idle steps [%] | kinetic [J] | potential [J] | dissipated [kJ] | "
            "unexplained [%] | overlap [mm] | fastest [m/s] | memory [MB] |\n"
            "|---|---|---|---|---|---|---|---|---|---|\n");
        Row row;
        std::vector<Row> rows;
        const auto watch = [&](double, const World& w) {
            add_step(row, w);
            if (w.time >= o.row * static_cast<double>(rows.size() + 1) - 1e-6) {
                rows.push_back(close_row(row, w));
                print_row(rows.back());
                row = {};
            }
            return true;
        };
        RunOptions options;
        const RunFolder folder(o.out, Existing::replace);
        options.folder = folder.path();
        options.command_line = command_line(argc, argv);
        options.keep_going = watch;
        const Summary summary = run(world, options);
        fmt::print("\n{} steps, state hash {:016x}\n", summary.steps, summary.state_hash);
        for (const Warning& w : summary.warnings) fmt::print("warning: {}\n", with_verdict(w));
        return judge(rows) ? 0 : static_cast<int>(ExitCode::failed);
    });
}
