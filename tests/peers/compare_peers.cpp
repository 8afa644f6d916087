// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's 2D case in our solver, Box2D and Bullet: mean forces side by side, as Markdown.
//
//   compare_peers CASE.cfg...              one run of each engine per case
//   compare_peers --runs 5 CASE.cfg...     five, the hull set back by 0, 1, 2, 3, 4 mm
//   compare_peers --only NAME CASE.cfg...  engines whose name contains NAME
//
// The sphere sets of the cases must be there (cases/prepare.sh); `ninja peers` sees to that.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"
#include "common/cli/console.hpp"
#include "solver/case/read_case.hpp"
#include "solver/step/run.hpp"
#include "tests/peers/measure.hpp"

using namespace ice;
using namespace ice::peers;

namespace {

constexpr double kSetBack = 0.001;  // of the hull from run to run [m]

struct Contestant {
    std::string name;
    std::vector<std::string> overrides;
    std::function<std::unique_ptr<Engine>(World)> make;
};

std::vector<Contestant> contestants() {
    return {
        {"ours, centres (paper)", {"contact.normal=centres"}, make_own_engine},
        {"ours, surface", {"contact.normal=surface"}, make_own_engine},
        {"Box2D", {}, [](World w) { return make_box2d_engine(std::move(w), kBox2dSkin); }},
        // corners as round as those of our discs
        {"Box2D, corners 0.1 m",
         {},
         [](World w) {
             const double radius = w.scene.shapes[1].largest_radius;
             return make_box2d_engine(std::move(w), radius);
         }},
        {"Bullet", {}, make_bullet_engine},
    };
}

struct Row {
    double speed;
    std::string name;
    std::vector<Outcome> runs;
};

// Of several runs: the mean of their means, and half the width of its 95 % interval from their
// scatter; of one run its batch means.
MeanInterval overall(const std::vector<Outcome>& runs, MeanInterval Outcome::*force) {
    if (runs.size() == 1) return runs[0].*force;
    constexpr double kStudent[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262};
    std::vector<double> means;
    double sum = 0.0;
    for (const Outcome& run : runs) sum += means.emplace_back((run.*force).mean);
    const double count = static_cast<double>(runs.size());
    return {sum / count,
            kStudent[runs.size() - 2] * standard_deviation(means) / std::sqrt(count)};
}

template <class Value>
Value largest(const std::vector<Outcome>& runs, Value Outcome::*value) {
    Value most = runs[0].*value;
    for (const Outcome& run : runs) most = std::max(most, run.*value);
    return most;
}

std::string counts(const std::vector<Outcome>& runs, int Outcome::*value) {
    std::string text;
    for (const Outcome& run : runs) {
        const std::string count = fmt::format("{}", run.*value);
        if (text.empty() || text.substr(text.rfind(' ') + 1) != count)
            text += (text.empty() ? "" : ", ") + count;
    }
    return text;
}

void print_tables(const std::vector<Row>& rows) {
    fmt::print("| m/s | engine | f_x [N/m] | f_z [N/m] |\n|---|---|---|---|\n");
    for (const Row& r : rows) {
        const MeanInterval x = overall(r.runs, &Outcome::force_x);
        const MeanInterval z = overall(r.runs, &Outcome::force_z);
        fmt::print("| {:.1f} | {} | {:.0f} +- {:.0f} | {:.0f} +- {:.0f} |\n", r.speed, r.name,
                   x.mean, x.half_width, z.mean, z.half_width);
    }
    fmt::print(
        "\n| m/s | engine | released | behind | centre in hull | overlap hull [mm] | overlap ice "
        "[mm] | peak [kN/m] | fastest [m/s] | imbalance [N/m] | us/step |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const Row& r : rows)
        fmt::print("| {:.1f} | {} | {} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1g} | "
                   "{:.0f} |\n",
                   r.speed, r.name, counts(r.runs, &Outcome::moved),
                   counts(r.runs, &Outcome::behind), counts(r.runs, &Outcome::inside),
                   1e3 * largest(r.runs, &Outcome::deepest_hull),
                   1e3 * largest(r.runs, &Outcome::deepest_ice),
                   1e-3 * largest(r.runs, &Outcome::peak), largest(r.runs, &Outcome::fastest),
                   largest(r.runs, &Outcome::imbalance),
                   1e6 * largest(r.runs, &Outcome::step_seconds));
}

int compare(const std::vector<std::string>& files, int runs, const std::string& only) {
    set_thread_count(1);
    std::vector<Row> rows;
    for (const std::string& file : files)
        for (const Contestant& c : contestants()) {
            if (c.name.find(only) == std::string::npos) continue;
            Row row{0.0, c.name, {}};
            for (int k = 0; k < runs; ++k) {
                Case parameters = read_case(file, c.overrides);
                parameters.hull_position.x() -= k * kSetBack;
                row.speed = parameters.ship_speed(0.0);
                row.runs.push_back(measure(*c.make(build_world(parameters))));
                say(fmt::format("{} m/s, {}, run {}: f_x {:.0f}, f_z {:.0f} N/m", row.speed, c.name,
                                k + 1, row.runs.back().force_x.mean,
                                row.runs.back().force_z.mean));
            }
            rows.push_back(std::move(row));
        }
    print_tables(rows);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("The paper's 2D case in our solver, Box2D and Bullet.", "compare_peers");
    std::vector<std::string> files;
    std::string only;
    int runs = 1;
    app.add_option("case", files, "Case files, 2D")->required()->check(CLI::ExistingFile);
    app.add_option("--runs", runs, "Runs per engine, the hull set back by 1 mm from one to the next")
        ->check(CLI::Range(1, 10));
    app.add_option("--only", only, "Engines whose name contains this");
    CLI11_PARSE(app, argc, argv);
    start_messages(Colour::automatic, false);
    return run_program("compare_peers", [&] { return compare(files, runs, only); });
}
