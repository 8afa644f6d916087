// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/icebench_measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <numeric>

#include "common/base/parallel.hpp"
#include "common/base/timer.hpp"
#include "solver/record/measure_step.hpp"
#include "solver/record/recorder.hpp"
#include "tests/bench/icebench_peer.hpp"

namespace ice::bench {

namespace {

// Energy is measured every 10 steps, or every (floes / 1000) where that is more: it takes as long
// as a step in which all floes move, and empties the caches.
constexpr int kEnergyEvery = 10, kFloesPerStep = 1000;

// Kinetic and potential energy above that at the start and what the ship put in [J]. The moment
// that buoyancy "centre" leaves out takes energy like a load from outside.
double energy_above_input(const World& w) {
    const EnergyLedger& ledger = w.ledger;
    return ledger.kinetic_change + potential_energy(w.scene, w.parameters) -
           *ledger.potential_start + ledger.buoyancy_moment - ledger.ship_work;
}

// Of one thread its own: another one that waits for work uses up time of the process, too.
double processor_seconds(int threads) {
#ifdef CLOCK_THREAD_CPUTIME_ID
    timespec now{};
    if (threads == 1 && clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) == 0)
        return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
#endif
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// Does one step and adds its times.
void timed(Row& row, const std::function<void()>& work) {
    const double start = processor_seconds(row.threads);
    const Timer timer;
    work();
    row.step_ms.push_back(1e3 * timer.seconds());
    row.step_cpu_ms.push_back(1e3 * (processor_seconds(row.threads) - start));
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

double Row::least_ms() const { return *std::min_element(step_ms.begin(), step_ms.end()); }

double Row::median_ms() const {
    std::vector<double> sorted = step_ms;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
}

double Row::mean_ms() const { return mean(step_ms); }
double Row::mean_cpu_ms() const { return mean(step_cpu_ms); }

Row measure_solver(const BenchScene& scene, int steps, const Watch& watch) {
    World w = scene.world;
    Row row;
    row.engine = "icesolve";
    row.scene = scene.name;
    row.floes = static_cast<int>(w.scene.bodies.size()) - 1;
    row.threads = thread_count();
    const int energy_every = std::max(kEnergyEvery, row.floes / kFloesPerStep);
    for (int k = 1; k <= steps && !row.interrupted; ++k) {
        timed(row, [&] { step(w); });
        const StepRecord record =
            measure_step(w.scene, w.contacts, w.constraints, w.parameters.time_step);
        row.contacts += record.contacts;
        row.max_overlap = std::max(row.max_overlap, record.max_overlap);
        row.energy = record.kinetic_energy;
        if (k % energy_every == 0 || k == steps) {
            const double above = energy_above_input(w);
            if (!(row.energy_above_input >= above)) row.energy_above_input = above;
        }
        row.interrupted = !watch(static_cast<double>(k) / steps);
    }
    const auto done = static_cast<double>(row.step_ms.size());
    row.contacts /= done;
    row.state_hash = fmt::format("{:016x}", state_hash(w.scene, w.constraints));
    for (const double seconds : w.stage_seconds) row.stage_ms.push_back(1e3 * seconds / done);
    return row;
}

Row measure_peer(const PeerKind& kind, const BenchScene& scene, const Length& length,
                 const Watch& watch) {
    const std::unique_ptr<Peer> peer = kind.make(scene);
    Row row;
    row.engine = kind.name;
    row.scene = scene.name;
    row.floes = static_cast<int>(scene.world.scene.bodies.size()) - 1;
    const Timer all;
    for (int k = 1; k <= length.steps && !row.interrupted; ++k) {
        if (k > 1 && all.seconds() > length.patience) break;
        timed(row, [&] { peer->step(); });
        const Peer::Contacts contacts = peer->contacts();
        row.contacts += contacts.count;
        row.max_overlap = std::max(row.max_overlap, contacts.max_overlap);
        row.interrupted = !watch(static_cast<double>(k) / length.steps);
    }
    row.contacts /= static_cast<double>(row.step_ms.size());
    row.energy = peer->kinetic_energy();
    return row;
}

double ratio(const Row& peer, const Row& ours) {
    const auto same = std::min(peer.step_cpu_ms.size(), ours.step_cpu_ms.size());
    const auto sum = [&](const Row& row) {
        const auto from = row.step_cpu_ms.begin();
        return std::accumulate(from, from + static_cast<std::ptrdiff_t>(same), 0.0);
    };
    return sum(peer) / sum(ours);
}

}  // namespace ice::bench
