// SPDX-License-Identifier: GPL-3.0-or-later
// Times of the solver's steps on fixed scenes, beside other engines; README.md has the numbers.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <utility>

#include "common/base/error.hpp"
#include "common/base/instruction_set.hpp"
#include "common/base/parallel.hpp"
#include "common/base/part_file.hpp"
#include "common/base/version.hpp"
#include "common/cli/console.hpp"
#include "common/cli/progress.hpp"
#include "tests/bench/icebench_kernels.hpp"
#include "tests/bench/icebench_peer.hpp"
#include "tests/bench/icebench_table.hpp"
#include "tests/bench/machine.hpp"

using namespace ice;
using namespace ice::bench;

namespace {

struct Options {
    std::vector<std::string> scenes = scene_names(), simd{"auto"}, models{"scene", "default"};
    std::vector<int> floes, threads{1, 2};
    int steps = 1000;
    double patience = 150.0;
    bool peers = false, kernels = false, quiet = false;
    std::string csv;
    int iterations = 10;
};

void declare(CLI::App& app, Options& o) {
    app.set_version_flag("--version",
                         fmt::format("icebench {} ({}, {})", version(), git_commit(), compiler()));
    app.add_option("--scene", o.scenes, "Scenes, separated by commas (default: all)")
        ->delimiter(',')
        ->check(CLI::IsMember(scene_names()));
    app.add_option("--floes", o.floes,
                   "Numbers of floes, separated by commas. loose and packed take any (default "
                   "100,400,1600,10000), held 500 and more, of which all but 500 are held (default "
                   "500,100500); paper-3d has 180 and ship-100m 2000 and they are left "
                   "out where the list lacks that")
        ->delimiter(',')
        ->check(CLI::Range(1, 1000000));
    app.add_option("--threads", o.threads, "Numbers of threads (default 1,2)")
        ->delimiter(',')
        ->check(CLI::Range(1, 4096));
    app.add_option("--simd", o.simd, "Instruction sets; all: those this machine has (default auto)")
        ->delimiter(',')
        ->check(CLI::IsMember({"auto", "scalar", "sse4", "avx2", "avx512", "all"}));
    app.add_option("--steps", o.steps, "Steps of 0.01 s (default 1000)")
        ->check(CLI::Range(1, 1000000));
    app.add_flag("--peers", o.peers,
                 "Also Bullet (libbullet-dev) and ODE (libode-dev) on loose and packed, as far as "
                 "they were there when this was built; one thread");
    app.add_flag("--kernels", o.kernels,
                 "Instead of steps: what a unit of work costs in each kernel, in the state after "
                 "--steps steps of each scene; one thread");
    app.add_option("--patience", o.patience,
                   "Wall time after which a peer does not begin another step [s] (default 150)")
        ->check(CLI::PositiveNumber);
    app.add_option("--model", o.models,
                   "Models of our solver, separated by commas (default: both). scene: contacts of "
                   "single spheres, buoyancy and drag at the centre, as loose and packed are "
                   "defined and the peers have them, engine icesolve; default: the solver's "
                   "defaults, flat faces and sharp edges, loads on every facet, engine "
                   "icesolve-default")
        ->delimiter(',')
        ->check(CLI::IsMember({"scene", "default"}));
    app.add_option("--iterations", o.iterations,
                   "Upper bound per stage of our contact solver (default 10)")
        ->check(CLI::Range(1, 100000));
    app.add_option("--csv", o.csv, "Write the table here, too")->type_name("FILE");
    app.add_flag("-q,--quiet", o.quiet, "No progress");
    app.footer(
        "Nothing sleeps and every contact is kept. --model and --iterations do not concern\n"
        "paper-3d, which is the case of that name. Exit codes: 0 ok; 1 failed, or state hashes of\n"
        "one scene differ; 2 bad command line; 130 interrupted.");
}

// What `--simd all` stands for: the instruction sets that this machine has.
std::vector<std::string> instruction_sets() {
    std::vector<std::string> out;
    for (const char* name : {"scalar", "sse4", "avx2", "avx512"}) {
        try {
            set_instruction_set(name);
        } catch (const Error&) {
            continue;
        }
        out.emplace_back(name);
    }
    return out;
}

class Bench {
public:
    explicit Bench(Options options) : o_(std::move(options)) {
        const auto all = std::find(o_.simd.begin(), o_.simd.end(), "all");
        if (all != o_.simd.end()) o_.simd = instruction_sets();
        for (const std::string& name : o_.simd) set_instruction_set(name);  // or refuse it now
    }

    int run() {
        fmt::print("{}, {}, icesolve {} ({})\n\n", test::machine_name(), compiler(), version(),
                   git_commit());
        if (o_.kernels) return run_kernels();
        fmt::print("{}", table_head());
        for (const std::string& name : o_.scenes)
            for (const int floes : numbers_of(name))
                if (!interrupted()) measure_scene(name, floes);
        if (interrupted()) return static_cast<int>(ExitCode::interrupted);
        fmt::print("\nMean time per step by stage [ms]\n\n{}", stage_table(rows_));
        if (o_.peers)
            for (const PeerKind& kind : peer_kinds())
                if (kind.make == nullptr)
                    fmt::print("\n{}: not installed ({})\n", kind.name, kind.package);
        if (!o_.csv.empty()) write_text_file(o_.csv, csv_text(rows_));
        return hashes_agree_ ? 0 : static_cast<int>(ExitCode::failed);
    }

private:
    int run_kernels() {
        set_thread_count(1);
        for (const std::string& name : o_.scenes)
            for (const int floes : numbers_of(name))
                for (const std::string& model : models_of(name)) {
                    const BenchScene scene = make(name, floes, model);
                    fmt::print("{}, {} floes, {} steps, {}\n\n{}", name, floes, o_.steps,
                               engine_of(model), kernel_head());
                    for (const std::string& simd : o_.simd) {
                        if (interrupted()) return static_cast<int>(ExitCode::interrupted);
                        set_instruction_set(simd);
                        fmt::print("{}", kernel_line(measure_kernels(scene, o_.steps)));
                        std::fflush(stdout);
                    }
                    fmt::print("\n");
                }
        return 0;
    }

    // The paper's case has models of its own.
    std::vector<std::string> models_of(const std::string& scene) const {
        return scene == "paper-3d" ? std::vector<std::string>{"scene"} : o_.models;
    }

    static const char* engine_of(const std::string& model) {
        return model == "default" ? "icesolve-default" : "icesolve";
    }

    BenchScene make(const std::string& name, int floes, const std::string& model) const {
        Models models;
        models.iterations = o_.iterations;
        if (model == "scene") {
            models.normal = NormalRule::centres;
            models.buoyancy = BuoyancyModel::centre;
            models.drag = DragModel::projected;
        }
        return make_bench_scene(name, floes, models);
    }

    std::vector<int> numbers_of(const std::string& scene) const {
        std::vector<int> usual = usual_floes(scene);
        if (o_.floes.empty()) return usual;
        if (takes_any_number(scene)) {
            std::vector<int> out = o_.floes;
            std::erase_if(out, [&](int n) { return n < fewest_floes(scene); });
            return out;
        }
        std::erase_if(usual, [&](int n) {
            return std::find(o_.floes.begin(), o_.floes.end(), n) == o_.floes.end();
        });
        return usual;
    }

    void measure_scene(const std::string& name, int floes) {
        std::vector<Row> fastest;  // of each model, on one thread if measured: peers' measure
        for (const std::string& model : models_of(name)) {
            const std::size_t first = rows_.size();
            if (!measure_model(make(name, floes, model), model)) return;
            compare_hashes(first);
            fastest.push_back(*std::min_element(rows_.begin() + static_cast<std::ptrdiff_t>(first),
                                                rows_.end(), [](const Row& l, const Row& r) {
                                                    return std::pair(l.threads > 1, l.median_ms()) <
                                                           std::pair(r.threads > 1, r.median_ms());
                                                }));
        }
        if (o_.peers && !fastest.empty()) measure_peers(name, floes, fastest);
    }

    bool measure_model(const BenchScene& scene, const std::string& model) {
        for (const std::string& simd : o_.simd)
            for (const int threads : o_.threads) {
                set_thread_count(threads);
                set_instruction_set(simd);
                const std::string in_force(instruction_set());  // of "auto" the best
                Progress progress("icebench", o_.quiet);
                Row row = measure_solver(
                    scene, o_.steps,
                    watch(progress, fmt::format("{} {}, {}, {}, {} threads", scene.name,
                                                scene.world.scene.bodies.size() - 1,
                                                engine_of(model), in_force, threads)));
                progress.finish();
                row.engine = engine_of(model);
                row.simd = in_force;
                if (!add(std::move(row), "")) return false;
            }
        return true;
    }

    void measure_peers(const std::string& name, int floes, const std::vector<Row>& ours) {
        const BenchScene scene = make(name, floes, "scene");
        if (!scene.for_peers) return;
        for (const PeerKind& kind : peer_kinds()) {
            if (kind.make == nullptr || interrupted()) continue;
            Progress progress("icebench", o_.quiet);
            Row row = measure_peer(
                kind, scene, {o_.steps, o_.patience},
                watch(progress, fmt::format("{} {}, {}", scene.name, floes, kind.name)));
            progress.finish();
            std::string to_ours;
            for (const Row& own : ours)
                to_ours += fmt::format("{}{:.1f}", to_ours.empty() ? "" : " / ", ratio(row, own));
            add(std::move(row), to_ours);
        }
    }

    static Watch watch(Progress& progress, const std::string& note) {
        return [&progress, note](double done) {
            progress.update(done, note);
            return !interrupted();
        };
    }

    bool add(Row row, const std::string& to_ours) {
        if (row.interrupted) return false;
        fmt::print("{}", table_line(row, to_ours));
        std::fflush(stdout);
        rows_.push_back(std::move(row));
        return true;
    }

    void compare_hashes(std::size_t first) {
        for (std::size_t k = first + 1; k < rows_.size(); ++k)
            if (rows_[k].state_hash != rows_[first].state_hash) {
                say_warning(fmt::format("{} {}: the state depends on threads or instruction set",
                                        rows_[k].scene, rows_[k].floes));
                hashes_agree_ = false;
                return;
            }
    }

    Options o_;
    std::vector<Row> rows_;
    bool hashes_agree_ = true;
};

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Times the solver's steps on fixed scenes: fields of box floes of spheres and a ship that "
        "goes into them.",
        "icebench");
    Options options;
    declare(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::bad_input);
    }
    start_messages(Colour::automatic, options.quiet);
    catch_interrupts();
    return run_program("icebench", [&] { return Bench(options).run(); });
}
