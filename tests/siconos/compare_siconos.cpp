// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of cases solved again by Siconos numerics: prints README.md's table.
//   build/release/tests/compare_siconos cases/broken-field/case.cfg ...
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "solver/case/read_case.hpp"
#include "solver/run/run.hpp"
#include "tests/siconos/step_again.hpp"

using namespace ice;

namespace {

struct Options {
    std::vector<std::string> cases, settings;
    int samples = 20, sweeps = 20000;
};

// Sums over the steps that were solved again.
struct Row {
    Vec3 as_run = Vec3::Zero(), ours = Vec3::Zero(), siconos = Vec3::Zero();  // [N s]
    double apart = 0.0, apart_as_run = 0.0;  // of Siconos, sums of the steps' norms [N s]
    double size = 0.0;                       // sum of Siconos' norms [N s]
    std::size_t contacts = 0, at_bound = 0;
    int steps = 0, unconverged = 0;
    double error = 0.0;

    void add(const oracle::StepAgain& s) {
        as_run += s.as_run;
        ours += s.ours;
        siconos += s.siconos;
        apart += (s.ours - s.siconos).norm();
        apart_as_run += (s.as_run - s.siconos).norm();
        size += s.siconos.norm();
        contacts += s.contacts;
        at_bound += s.at_bound;
        ++steps;
        unconverged += s.converged ? 0 : 1;
        error = std::max(error, s.error);
    }
};

Row compare(const std::string& path, const Options& options) {
    std::vector<std::string> settings = options.settings;
    // the oracle has no restitution (step_again.hpp); without it a stage has one solution
    settings.push_back("contact.restitution=0");
    World world = build_world(read_case(path, settings));
    const double dt = world.parameters.time_step;
    const auto step_of = [dt](double time) { return std::llround(time / dt); };
    const std::int64_t first = step_of(world.parameters.average_from),
                       last = step_of(world.parameters.duration);
    const std::int64_t every = std::max<std::int64_t>(1, (last - first) / options.samples);
    Row row;
    while (world.steps < last) {
        const bool sample = world.steps >= first && (world.steps - first) % every == 0;
        const Bodies before = sample ? world.scene.bodies : Bodies{};
        step(world);
        if (sample) row.add(oracle::solve_again(before, world, options.sweeps));
    }
    return row;
}

void print(const std::string& name, const Row& r) {
    const double all = r.siconos.norm();
    fmt::print(
        "| {} | {} | {:.0f}, {:.0f} | {} | {:+.2g} % | {:.2g} % | {:+.2g} % | {:.2g} % | {:.1e} "
        "|\n",
        name, r.steps, static_cast<double>(r.contacts) / r.steps,
        static_cast<double>(r.at_bound) / r.steps, r.unconverged,
        100.0 * (r.ours - r.siconos).dot(r.siconos) / (all * all), 100.0 * r.apart / r.size,
        100.0 * (r.as_run - r.siconos).dot(r.siconos) / (all * all),
        100.0 * r.apart_as_run / r.size, r.error);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Steps of cases solved again by Siconos numerics");
    app.add_option("cases", options.cases, "case files")->required()->check(CLI::ExistingFile);
    app.add_option("--set", options.settings, "key=value, of all cases")->allow_extra_args(false);
    app.add_option("--samples", options.samples,
                   "steps of a case's averaged time that are solved again")
        ->capture_default_str();
    app.add_option("--sweeps", options.sweeps, "of Siconos, at most")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    fmt::print(
        "| case | steps | contacts, at their bound | unconverged | to rounding: sum | step by "
        "step | as run: sum | step by step | error |\n|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& path : options.cases)
        print(std::filesystem::path(path).parent_path().filename().string(),
              compare(path, options));
    return 0;
}
