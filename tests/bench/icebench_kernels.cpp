// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/icebench_kernels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

#include "common/base/instruction_set.hpp"
#include "common/base/timer.hpp"
#include "solver/contact/sweep.hpp"
#include "solver/narrow/neighbours/search_pair.hpp"

namespace ice::bench {

namespace {

// The machine is seldom alone: the least of so many runs is what the kernel takes.
constexpr int kRuns = 15;

// Contacts may be this far apart [m].
constexpr double kMargin = 0.002;

// Least time of a run, which repeats `work` `repeats` times, per unit of work [ns].
double least_ns(int repeats, double units, const std::function<void()>& work) {
    double least = std::numeric_limits<double>::infinity();
    for (int run = 0; run < kRuns; ++run) {
        const Timer timer;
        for (int k = 0; k < repeats; ++k) work();
        least = std::min(least, timer.seconds());
    }
    return 1e9 * least / repeats / units;
}

NearSpheres row_of_spheres(std::size_t count, float y) {
    NearSpheres out;
    out.count = count;
    // a kernel may read beyond the last one
    for (std::size_t k = 0; k < count + SphereBlocks::kGroup; ++k) {
        out.x.push_back(0.1f * static_cast<float>(k));
        out.y.push_back(y);
        out.z.push_back(0.0f);
        out.normal_extent.push_back(0.05f);
        out.tangent_extent.push_back(0.0f);
        out.own.push_back(0.05f);
        out.id.push_back(static_cast<std::int32_t>(k));
    }
    return out;
}

double time_pair_tests() {
    constexpr std::size_t kFew = 16, kMany = 1024;
    const NearSpheres few = row_of_spheres(kFew, 0.0f), many = row_of_spheres(kMany, 100.0f);
    NearPairs found;
    return least_ns(200, kFew * kMany, [&] {
        find_near_pairs(few, 0, kFew, many, {0.01f, 0.1f}, found);
    });
}

double time_hull_search(const World& w) {
    std::vector<PairView> views;
    double spheres = 0.0;
    for (const BodyPair& pair : w.pairs.pairs())
        if (pair.a == static_cast<std::int32_t>(kShip)) {
            views.emplace_back(w.scene, pair);
            spheres += static_cast<double>(views.back().shape_b.center.size());
        }
    if (views.empty()) return std::numeric_limits<double>::quiet_NaN();
    PairSearch search;
    std::size_t found = 0;
    const double reach =
        w.scene.shapes[static_cast<std::size_t>(w.scene.bodies.shape[kShip])].patch_radius;
    return least_ns(5, spheres, [&] {
        for (const PairView& view : views)
            search.for_each_near(view, kMargin, reach,
                                 [&](std::int32_t, std::int32_t) { ++found; });
    });
}

double time_fresh_pairs(const World& w) {
    ContactFinder finder;
    std::vector<Contact> contacts;
    const auto& pairs = w.pairs.pairs();
    return least_ns(1, static_cast<double>(pairs.size()), [&] {
        finder.find(w.scene, pairs, w.parameters.normal, w.parameters.time_step, kMargin, contacts);
    });
}

double time_sweep(const World& w) {
    const std::vector<Constraint>& constraints = w.constraints;
    ContactRows rows;
    std::vector<std::int32_t> all(constraints.size());
    std::iota(all.begin(), all.end(), 0);
    rows.build(w.scene.bodies, constraints, all);
    rows.begin_stage(w.scene.bodies, constraints, &Constraint::rest_normal,
                     &Constraint::rest_tangent, [&](const Constraint& c) -> ContactRows::Target {
                         return {-std::max(c.gap, 0.0) / w.parameters.time_step, c.max_impulse};
                     });
    return least_ns(20, static_cast<double>(constraints.size()),
                    [&] { sweep(rows.blocks, rows.rows, rows.motion); });
}

}  // namespace

KernelTimes measure_kernels(const BenchScene& scene, int steps) {
    World w = scene.world;
    double pairs = 0.0;
    for (int k = 0; k < steps; ++k) {
        step(w);
        pairs += static_cast<double>(w.pairs.pairs().size());
    }
    KernelTimes out;
    out.simd = instruction_set();
    out.known_pair = 1e9 * w.stage_seconds[static_cast<std::size_t>(Stage::narrow)] / pairs;
    out.pair_test = time_pair_tests();
    out.hull_sphere = time_hull_search(w);
    out.fresh_pair = time_fresh_pairs(w);
    out.sweep_contact = time_sweep(w);
    return out;
}

std::string kernel_head() {
    return "| simd   | pair test ns | hull, floe sphere ns | fresh pair ns | known pair ns | "
           "sweep, "
           "contact ns |\n|---|---|---|---|---|---|\n";
}

std::string kernel_line(const KernelTimes& t) {
    return fmt::format("| {:<6} | {:>12.3f} | {:>20.2f} | {:>13.0f} | {:>13.0f} | {:>17.2f} |\n",
                       t.simd, t.pair_test, t.hull_sphere, t.fresh_pair, t.known_pair,
                       t.sweep_contact);
}

}  // namespace ice::bench
