// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's 2D case in our solver, Box2D and Bullet: mean forces side by side, as Markdown.
//
//   compare_peers CASE.cfg...              one run of each engine per case
//   compare_peers --runs 5 CASE.cfg...     five, the hull a little further aft each time
//   compare_peers --only NAME CASE.cfg...  engines whose name contains NAME
//   compare_peers --sharp DIR CASE.cfg...  also our solver with the sets in DIR: sharper corners
//   compare_peers --set KEY=VALUE ...      replaces a key of the cases, as icesolve does
//
// The sphere sets of the cases must be there (cases/prepare.sh); `ninja peers` sees to that.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"
#include "common/cli/console.hpp"
#include "common/formats/spheres_file.hpp"
#include "solver/case/read_case.hpp"
#include "solver/run/run.hpp"
#include "tests/peers/measure.hpp"

using namespace ice;
using namespace ice::peers;

namespace {

// Of the hull from run to run [m]. No whole number of steps of travel at any of the speeds: that
// would be the same run, later.
constexpr double kSetBack = 0.00037;

struct Options {
    std::vector<std::string> files, overrides;
    std::string only, sharp;
    int runs = 1;
};

struct Contestant {
    std::string name;
    std::vector<std::string> overrides;
    std::function<std::unique_ptr<Engine>(World)> make;
};

std::vector<Contestant> contestants(const Options& o) {
    std::vector<Contestant> out{
        {"ours, centres (paper)", {"contact.normal=centres"}, make_own_engine},
        {"ours, surface", {"contact.normal=surface"}, make_own_engine}};
    if (!o.sharp.empty()) {
        const std::filesystem::path folder = std::filesystem::absolute(o.sharp);
        const std::string hull = (folder / "hull.spheres.h5").string();
        const std::string floe = (folder / "floe.spheres.h5").string();
        out.push_back({fmt::format("ours, surface, R {:g} m", read_spheres(floe).radius),
                       {"contact.normal=surface", "hull.spheres=" + hull, "floes.spheres=" + floe},
                       make_own_engine});
    }
    // corners of floes and hull as round as our discs make them
    const auto round = [](World w) {
        const double radius = w.scene.shapes[1].largest_radius;
        return make_box2d_engine(std::move(w), radius);
    };
    const auto square = [](World w) { return make_box2d_engine(std::move(w), kBox2dSkin); };
    out.push_back({"Box2D, round corners", {}, round});
    out.push_back({"Box2D", {}, square});
    out.push_back({"Bullet", {}, make_bullet_engine});
    std::erase_if(out,
                  [&](const Contestant& c) { return c.name.find(o.only) == std::string::npos; });
    return out;
}

struct Row {
    double speed;
    std::string name;
    std::vector<Outcome> runs;
};

// Mean of the runs' means, and its 95 % interval from their scatter (Student).
MeanInterval over_runs(const std::vector<Outcome>& runs, MeanInterval Outcome::*force) {
    std::vector<double> means;
    for (const Outcome& run : runs) means.push_back((run.*force).mean);
    return student_interval(means);
}

MeanInterval of_first(const std::vector<Outcome>& runs, MeanInterval Outcome::*force) {
    return runs[0].*force;
}

template <class Value>
Value largest(const std::vector<Outcome>& runs, Value Outcome::*value) {
    Value most = runs[0].*value;
    for (const Outcome& run : runs) most = std::max(most, run.*value);
    return most;
}

template <class Value>
Value smallest(const std::vector<Outcome>& runs, Value Outcome::*value) {
    Value least = runs[0].*value;
    for (const Outcome& run : runs) least = std::min(least, run.*value);
    return least;
}

std::string range(const std::vector<Outcome>& runs, int Outcome::*value) {
    const int least = smallest(runs, value), most = largest(runs, value);
    return least == most ? fmt::format("{}", least) : fmt::format("{}-{}", least, most);
}

// One line per case and force, one column per engine; rows come engine by engine, case after case.
template <class Mean>
void print_forces(const std::vector<Row>& rows, std::size_t engines, const Mean& mean) {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < engines; ++k) names.push_back(rows[k].name);
    fmt::print("| m/s | N/m | {} |\n|---|---|", fmt::join(names, " | "));
    for (std::size_t k = 0; k < names.size(); ++k) fmt::print("---|");
    for (std::size_t first = 0; first < rows.size(); first += names.size())
        for (const auto& [symbol, force] :
             {std::pair{"f_x", &Outcome::force_x}, std::pair{"f_z", &Outcome::force_z}}) {
            fmt::print("\n| {:.1f} | {} |", rows[first].speed, symbol);
            for (std::size_t k = 0; k < names.size(); ++k) {
                const MeanInterval m = mean(rows[first + k].runs, force);
                fmt::print(" {:.0f} +- {:.0f} |", m.mean, m.half_width);
            }
        }
    fmt::print("\n");
}

void print_checks(const std::vector<Row>& rows) {
    fmt::print("| m/s | engine | released | behind | centre in hull | overlap hull, ice [mm] | ");
    fmt::print("peak [kN/m] | fastest [m/s] | imbalance [N/m] | us/step |\n");
    fmt::print("|---|---|---|---|---|---|---|---|---|---|\n");
    for (const Row& r : rows)
        fmt::print(
            "| {:.1f} | {} | {} | {} | {} | {:.1f}, {:.1f} | {:.0f} | {:.1f} | {:.0e} | "
            "{:.0f} |\n",
            r.speed, r.name, range(r.runs, &Outcome::moved), range(r.runs, &Outcome::behind),
            range(r.runs, &Outcome::inside), 1e3 * largest(r.runs, &Outcome::deepest_hull),
            1e3 * largest(r.runs, &Outcome::deepest_ice), 1e-3 * largest(r.runs, &Outcome::peak),
            largest(r.runs, &Outcome::fastest), largest(r.runs, &Outcome::imbalance),
            1e6 * smallest(r.runs, &Outcome::step_seconds));
}

void print_tables(const std::vector<Row>& rows, std::size_t engines) {
    fmt::print("The case as it stands, 95 % intervals from the autocorrelation:\n\n");
    print_forces(rows, engines, of_first);
    const std::size_t runs = rows[0].runs.size();
    if (runs > 1) {
        fmt::print(
            "\nMean of {} runs, the hull {:g} mm further aft from one to the next, 95 % "
            "intervals from their scatter:\n\n",
            runs, 1e3 * kSetBack);
        print_forces(rows, engines, over_runs);
    }
    fmt::print(
        "\nWhat the runs showed (least to most, or the most of all runs; the least time):\n\n");
    print_checks(rows);
}

int compare(const Options& o) {
    set_thread_count(1);
    std::vector<Row> rows;
    for (const std::string& file : o.files)
        for (const Contestant& c : contestants(o)) {
            Row row{0.0, c.name, {}};
            for (int k = 0; k < o.runs; ++k) {
                std::vector<std::string> overrides = o.overrides;
                overrides.insert(overrides.end(), c.overrides.begin(), c.overrides.end());
                Case parameters = read_case(file, overrides);
                parameters.hull_position.x() -= k * kSetBack;
                row.speed = parameters.ship_speed(0.0);
                row.runs.push_back(measure(*c.make(build_world(parameters))));
                say(fmt::format("{} m/s, {}, run {}: f_x {:.0f}, f_z {:.0f} N/m", row.speed, c.name,
                                k + 1, row.runs.back().force_x.mean, row.runs.back().force_z.mean));
            }
            rows.push_back(std::move(row));
        }
    if (rows.empty())
        throw bad_input("--only", fmt::format("no engine's name contains '{}'", o.only),
                        "try ours, Box2D or Bullet");
    print_tables(rows, rows.size() / o.files.size());
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("The paper's 2D case in our solver, Box2D and Bullet.", "compare_peers");
    Options o;
    app.add_option("case", o.files, "Case files, 2D")->required()->check(CLI::ExistingFile);
    app.add_option("--runs", o.runs, "Runs per engine, the hull a little further aft each time")
        ->check(CLI::Range(1, 10));
    app.add_option("--only", o.only, "Engines whose name contains this");
    app.add_option("--sharp", o.sharp, "Folder with hull and floe.spheres.h5 of small discs")
        ->check(CLI::ExistingDirectory);
    app.add_option("--set", o.overrides, "key=value, replaces a key of the cases; repeatable")
        ->allow_extra_args(false)
        ->take_all();
    CLI11_PARSE(app, argc, argv);
    start_messages(Colour::automatic, false);
    return run_program("compare_peers", [&] { return compare(o); });
}
