// SPDX-License-Identifier: GPL-3.0-or-later
// The flow around a case's hull: how far the water's loads on the floes move with finer panels and
// a finer table, what the flow adds to a step, and what a look into the table takes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <ctime>
#include <functional>
#include <limits>

#include "common/base/error.hpp"
#include "common/base/instruction_set.hpp"
#include "common/base/parallel.hpp"
#include "solver/case/read_case.hpp"
#include "solver/flow/flow_table.hpp"
#include "solver/run/run.hpp"

namespace ice::bench {
namespace {

// Loads are looked at in one of so many steps: floes move by some 0.1 m between two.
constexpr int kEvery = 10;
// The machine is seldom alone: the least of so many runs is what the work takes.
constexpr int kRuns = 15;

// Processor time of all threads: by the clock, other programs would count.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Variant {
    std::string name;
    FlowGrid grid;
    double make_seconds = 0.0;
    double power = 0.0;  // that the water takes from the floes, sum over the samples [W]
    double push = 0.0;   // of the water on the floes along x, likewise [N]
};

struct Sums {
    int samples = 0;
    double resistance = 0.0;                        // sum over the same samples [N]
    double steps = 0.0, step_cpu = 0.0;             // [s]
    int timed = 0;                                  // states whose loads were timed
    double floes = 0.0, with = 0.0, without = 0.0;  // loads in and without the flow [s]
};

Variant make(const std::string& name, const World& w, double panel, double spacing) {
    const double start = cpu_seconds();
    FlowOptions options;
    options.water = -w.scene.bodies.position[kShip].z();
    options.panel = panel;
    options.spacing = spacing;
    const HullFlow made = make_hull_flow(w.scene.shapes[0].mesh, w.parameters.dimension, options);
    return {name, FlowGrid(made.table), cpu_seconds() - start};
}

double longest_edge(const World& w) {
    FlowOptions options;
    options.water = -w.scene.bodies.position[kShip].z();
    options.table = false;
    return make_hull_flow(w.scene.shapes[0].mesh, w.parameters.dimension, options).panel;
}

// What the water takes from the floes as they move now, and its push along x.
void add_loads(World& w, std::vector<FloeLoad>& loads, Variant& v) {
    std::swap(w.scene.water.grid, v.grid);
    const Bodies& b = w.scene.bodies;
    loads.resize(b.moving.size());
    load_floes(w.scene, w.parameters, b.moving, loads);
    for (std::size_t k = 0; k < loads.size(); ++k) {
        const auto i = static_cast<std::size_t>(b.moving[k]);
        const Vec3 force = loads[k].drag.force + loads[k].pressure.force,
                   moment = loads[k].drag.moment + loads[k].pressure.moment;
        v.power -= force.dot(b.velocity[i]) + moment.dot(b.angular_velocity[i]);
        v.push += force.x();
    }
    std::swap(w.scene.water.grid, v.grid);
}

double least_cpu(const std::function<void()>& work) {
    double least = std::numeric_limits<double>::infinity();
    for (int run = 0; run < kRuns; ++run) {
        const double start = cpu_seconds();
        work();
        least = std::min(least, cpu_seconds() - start);
    }
    return least;
}

// Loads of one state with the flow and, its table laid aside, without.
void time_loads(World& w, std::vector<FloeLoad>& loads, Sums& sums) {
    const auto timed = [&] {
        return least_cpu([&] {
                   for (int k = 0; k < 5; ++k)
                       load_floes(w.scene, w.parameters, w.scene.bodies.moving, loads);
               }) /
               5.0;
    };
    sums.with += timed();
    FlowGrid aside;
    std::swap(w.scene.water.grid, aside);
    sums.without += timed();
    std::swap(w.scene.water.grid, aside);
    ++sums.timed;
    sums.floes += static_cast<double>(w.scene.bodies.moving.size());
}

Sums sample(World& w, std::vector<Variant>& variants) {
    Sums sums;
    std::vector<FloeLoad> loads;
    const auto steps = std::llround(w.parameters.duration / w.parameters.time_step);
    for (std::int64_t n = 1; n <= steps; ++n) {
        const double start = cpu_seconds();
        step(w);
        if (w.time < w.parameters.average_from) continue;
        sums.step_cpu += cpu_seconds() - start;
        sums.steps += 1.0;
        const StepRecord ice =
            measure_step(w.scene, w.contacts, w.constraints, w.parameters.time_step);
        sums.resistance -= ice.contact_force.x() + ice.friction_force.x();
        if (n % kEvery != 0) continue;
        ++sums.samples;
        w.scene.water.follow(w.scene.bodies.position[kShip], w.scene.ship_velocity);
        for (Variant& v : variants) add_loads(w, loads, v);
        if (n % (10 * kEvery) == 0) time_loads(w, loads, sums);
    }
    return sums;
}

// @return the change by finer panels, as a share of the ship's force
double print_loads(const std::vector<Variant>& variants, const Sums& sums, double speed) {
    const double resistance = sums.resistance / sums.steps;
    fmt::print(
        "mean force of the ice on the ship {:.1f} N over {:.0f} steps; the water's loads in "
        "{} of them:\n\n| table | panels | spacing m | MB | made, cpu s | taken by the water, "
        "per metre N | push along x N | change, % of the ship's force |\n"
        "|---|---|---|---|---|---|---|---|\n",
        resistance, sums.steps, sums.samples);
    const auto change_of = [&](const Variant& v) {
        return (v.power - variants[0].power) / sums.samples / speed / resistance;
    };
    for (const Variant& v : variants)
        fmt::print("| {} | {} | {:.4g} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.3f} |\n", v.name,
                   v.grid.panels, 1.0 / v.grid.per_spacing, 4e-6 * double(v.grid.node.size()),
                   v.make_seconds, v.power / sums.samples / speed, v.push / sums.samples,
                   100.0 * change_of(v));
    return std::abs(change_of(variants[1]));
}

void print_cost(const Sums& sums) {
    const double step = sums.step_cpu / sums.steps;
    const double with = sums.with / sums.timed, without = sums.without / sums.timed;
    fmt::print(
        "\na step takes {:.3f} ms of cpu; loads of {:.0f} floes {:.1f} us with the flow, "
        "{:.1f} us without: the flow adds {:.2f} % of a step\n",
        1e3 * step, sums.floes / sums.timed, 1e6 * with, 1e6 * without,
        100.0 * (with - without) / step);
}

// The corners of the floes that are in the table.
void print_looks(const World& w) {
    const Bodies& b = w.scene.bodies;
    std::vector<Vec3> points;
    for (const std::int32_t i : b.moving) {
        const auto k = static_cast<std::size_t>(i);
        for (const Vec3& v : w.scene.shapes[static_cast<std::size_t>(b.shape[k])].mesh.vertices) {
            const Vec3 at = b.position[k] + b.rotation[k] * v - w.scene.water.ship;
            const Vec3 place(at.x(), at.y(), b.position[k].z() + (b.rotation[k] * v).z());
            if (w.scene.water.reaches(
                    place + Vec3(w.scene.water.ship.x(), w.scene.water.ship.y(), 0), 0.0))
                points.push_back(place);
        }
    }
    std::vector<FlowSample> out(points.size());
    fmt::print("\n| instruction set | a look at each of {} corners, ns |\n|---|---|\n",
               points.size());
    for (const char* name : {"scalar", "sse4", "avx2", "avx512"}) {
        try {
            set_instruction_set(name);
        } catch (const Error&) {
            continue;  // not on this machine
        }
        constexpr int kRepeats = 200;
        const double least = least_cpu([&] {
            for (int k = 0; k < kRepeats; ++k) look_up_flow(w.scene.water.grid, points, out);
        });
        fmt::print("| {} | {:.1f} |\n", name,
                   1e9 * least / kRepeats / static_cast<double>(points.size()));
    }
    set_instruction_set("auto");
}

int run(const std::string& file, const std::vector<std::string>& overrides, double most) {
    set_thread_count(1);
    World w = build_world(read_case(file, overrides));
    if (w.scene.water.grid.empty())
        throw bad_input(file, "has no flow", "give flow.model = \"double-body\"");
    const double edge = longest_edge(w), spacing = 1.0 / w.scene.water.grid.per_spacing;
    std::vector<Variant> variants;
    variants.push_back(make("as the case's", w, 0.0, spacing));
    variants.push_back(make("panels x 4", w, 0.5 * edge, spacing));
    variants.push_back(make("spacing / 2", w, 0.0, 0.5 * spacing));
    const Sums sums = sample(w, variants);
    const double change = print_loads(variants, sums, w.scene.ship_velocity.norm());
    print_cost(sums);
    print_looks(w);
    if (change <= most) return 0;
    fmt::print(stderr, "finer panels change more than {:.3g} % of the ship's force\n",
               100.0 * most);
    return 1;
}

}  // namespace
}  // namespace ice::bench

int main(int argc, char** argv) {
    CLI::App app(
        "Runs a case and looks at the flow's loads on its floes with finer panels and a finer "
        "table, each on the same poses and motions. One thread.");
    std::string file;
    std::vector<std::string> overrides;
    double most = 1e300;
    app.add_option("case", file, "Case file, its sphere sets made")->required();
    app.add_option("--set", overrides, "key=value in place of the case's")->allow_extra_args(false);
    app.add_option("--most", most,
                   "Fail where finer panels change a larger share of the ship's force");
    CLI11_PARSE(app, argc, argv);
    try {
        return ice::bench::run(file, overrides, most);
    } catch (const ice::Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return static_cast<int>(error.code());
    }
}
