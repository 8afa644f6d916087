// SPDX-License-Identifier: GPL-3.0-or-later
// Our fills of a hull beside those of OpenVDB and YADE, in one run; README.md has the numbers.
//
//   bench_peers             10 m hull of 1e4 triangles, R = 0.05 m, and 100 m, 1e5, R = 0.1 m
//   bench_peers --smoke     a small hull, to see that it runs
//   bench_peers --csv FILE  the table as a file, too
//
// A peer that was not found when this was built is named as not installed.
#include <fmt/format.h>
#include <fmt/os.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <string>

#ifdef ICE_WITH_OPENVDB
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/VolumeToSpheres.h>
#include <tbb/global_control.h>
#endif

#include "common/base/parallel.hpp"
#include "common/base/timer.hpp"
#include "common/geometry/mass_properties.hpp"
#include "preprocess/fill/lattice.hpp"
#include "preprocess/fill/make_layer.hpp"
#include "tests/bench/machine.hpp"
#include "tests/support/make_hull.hpp"

using namespace ice;

namespace {

constexpr int kPatience = 400;            // with YADE [s]
constexpr double kEnough = 10.0;          // runs that take longer are not repeated [s]
constexpr std::size_t kAskedFor = 40000;  // of fillWithSpheres: its cost grows with the square

struct Hull {
    std::string name;
    TriangleMesh mesh;
    double radius;  // of the spheres [m]
    double volume = measure_mass(mesh).volume;
};

struct Cost {
    double wall = 1e300, cpu = 1e300;  // [s]; cpu summed over threads
};

struct Result {
    std::size_t spheres = 0;
    Cost cost{};
    std::optional<std::size_t> unlike{};  // lattice points answered differently from ours
    bool interior = true;                 // side by side, not a layer that overlaps
    std::string note{};
};

// Prints a line per result. Our interior with the same number of threads comes first: the others'
// processor time per sphere is divided by it. Times by the clock would compare the other programs
// that the machine runs: the long runs of peers have to share, the short ones of ours do not.
class Table {
public:
    explicit Table(const std::string& csv) {
        if (!csv.empty()) csv_.emplace(fmt::output_file(csv));
        fmt::print(kLine, "program", "hull", "triangles", "R", "threads", "spheres", "s", "cpu s",
                   "ns/sphere", "coverage", "unlike", "to ours", "");
        if (csv_)
            csv_->print(kCsv, "program", "hull", "triangles", "radius_m", "threads", "spheres",
                        "seconds", "cpu_seconds", "ns_per_sphere", "coverage", "points_unlike_ours",
                        "ratio_to_ours", "note");
    }

    void add(const std::string& program, const Hull& hull, int threads, const Result& result) {
        const double sphere = 4.0 / 3.0 * std::numbers::pi * std::pow(hull.radius, 3);
        const auto count = static_cast<double>(result.spheres);
        const double cpu = result.cost.cpu / count;
        const double ours = ours_.try_emplace({hull.name, threads}, cpu).first->second;
        std::string coverage, ratio;  // the layer overlaps and is no other way to the interior
        if (result.interior) {
            coverage = fmt::format("{:.3f}", count * sphere / hull.volume);
            ratio = fmt::format("{:.3g}", cpu / ours);
        }
        const auto print = [&](const auto& to) {
            to(program, hull.name, hull.mesh.triangles.size(), hull.radius, threads, result.spheres,
               fmt::format("{:.4g}", result.cost.wall), fmt::format("{:.4g}", result.cost.cpu),
               fmt::format("{:.4g}", 1e9 * result.cost.wall / count), coverage,
               result.unlike ? fmt::format("{}", *result.unlike) : "", ratio, result.note);
        };
        print([](const auto&... cells) { fmt::print(kLine, cells...); });
        std::fflush(stdout);
        if (csv_) print([&](const auto&... cells) { csv_->print(kCsv, cells...); });
    }

private:
    static constexpr const char* kLine =
        "{:<30}{:>6}{:>10}{:>6}{:>8}{:>9}{:>10}{:>10}{:>11}{:>9}{:>7}{:>9} {}\n";
    static constexpr const char* kCsv = "{},{},{},{},{},{},{},{},{},{},{},{},{}\n";

    std::optional<fmt::ostream> csv_;
    std::map<std::pair<std::string, int>, double> ours_;  // interior fill [cpu s per sphere]
};

Cost least_cost(int runs, const std::function<void()>& work) {
    Cost least;
    const Timer all;
    for (int k = 0; k < runs && (k == 0 || all.seconds() < kEnough); ++k) {
        const Timer timer;
        const std::clock_t start = std::clock();
        work();
        least.wall = std::min(least.wall, timer.seconds());
        least.cpu = std::min(least.cpu, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return least;
}

LatticeFill fill_ours(Table& table, const Hull& hull, int threads) {
    LatticeFill fill;
    std::vector<Vec3> centers;
    const Cost cost = least_cost(9, [&] {
        fill = fill_lattice_rows(hull.mesh,
                                 {LatticeKind::hexagonal, hull.radius, hull.radius, 3, true});
        centers.resize(fill.count);
        expand(fill, centers);
    });
    table.add("ours: hexagonal interior", hull, threads, {fill.count, cost, 0});
    return fill;
}

void layer_ours(Table& table, const Hull& hull, int threads) {
    std::size_t count = 0;
    const Cost cost = least_cost(2, [&] {
        const SurfaceTree tree(hull.mesh);
        count = make_layer(tree, {hull.radius, hull.radius, 3, true}).size();
    });
    table.add("ours: surface layer", hull, threads, {count, cost, {}, false});
}

#ifdef ICE_WITH_OPENVDB

// A level set whose band is deep enough to tell what is farther than R from the surface.
openvdb::FloatGrid::Ptr level_set(const Hull& hull, double voxel) {
    const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec3I> triangles;
    for (const Vec3& p : hull.mesh.vertices)
        points.emplace_back(transform->worldToIndex(openvdb::Vec3d(p.data())));
    for (const auto& t : hull.mesh.triangles) triangles.emplace_back(t.data());
    const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> mesh(
        points, triangles);
    const auto depth = static_cast<float>(std::ceil(hull.radius / voxel) + 2.0);
    return openvdb::tools::meshToVolume<openvdb::FloatGrid>(mesh, *transform, 1.0F, depth);
}

struct Sampled {
    std::size_t taken = 0, unlike = 0;
};

// The same lattice points asked of the level set.
Sampled sample(const openvdb::FloatGrid& grid, const LatticeFill& ours, double radius) {
    const LatticeFrame& frame = ours.frame;
    std::vector<Sampled> rows(frame.rows());
    parallel_for(rows.size(), 2, [&](std::size_t row) {
        const auto values = grid.getConstAccessor();
        const openvdb::tools::GridSampler<openvdb::FloatGrid::ConstAccessor,
                                          openvdb::tools::BoxSampler>
            sampler(values, grid.transform());
        const auto [k, j] = std::lldiv(static_cast<std::int64_t>(row), frame.count[1]);
        for (std::int64_t i = 0; i < frame.count[0]; ++i) {
            const Vec3 p = frame.point(i, j, k);
            const bool taken =
                sampler.wsSample({p.x(), p.y(), p.z()}) <= static_cast<float>(-radius);
            const auto at = static_cast<std::size_t>(i);
            const bool in_ours = (ours.bits[row * frame.words() + at / 64] >> (at % 64) & 1) != 0;
            rows[row].taken += taken;
            rows[row].unlike += taken != in_ours;
        }
    });
    Sampled all;
    for (const Sampled& row : rows) all = {all.taken + row.taken, all.unlike + row.unlike};
    return all;
}

void compare_openvdb(Table& table, const Hull& hull, const LatticeFill& ours, int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    for (const int parts : {1, 2}) {
        const double voxel = hull.radius / parts;
        Sampled sampled;
        const Cost cost =
            least_cost(2, [&] { sampled = sample(*level_set(hull, voxel), ours, hull.radius); });
        table.add(fmt::format("OpenVDB level set (voxel R{})", parts == 1 ? "" : "/2"), hull,
                  threads, {sampled.taken, cost, sampled.unlike});
    }
    // as many candidates as spheres: more of them only lengthens the search
    const auto most = static_cast<int>(std::min(ours.count, kAskedFor));
    std::vector<openvdb::Vec4s> spheres;
    const Cost cost = least_cost(2, [&] {
        openvdb::tools::fillWithSpheres(*level_set(hull, hull.radius / 2), spheres, {1, most},
                                        false, 2.0F, 2.0F, 0.0F, most);
    });
    table.add("OpenVDB fillWithSpheres", hull, threads,
              {spheres.size(), cost, {}, true, fmt::format("asked for {}", most)});
}

#endif

#ifdef ICE_YADE

// A triangle mesh as GTS reads it: vertices, edges, triangles by their edges, numbered from 1.
void write_gts(const std::filesystem::path& path, const TriangleMesh& mesh) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> number;
    std::vector<std::pair<std::int32_t, std::int32_t>> edges;
    std::vector<std::array<std::size_t, 3>> faces;
    for (const auto& t : mesh.triangles) {
        auto& face = faces.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const auto edge = std::minmax({t[k], t[(k + 1) % 3]});
            const auto [at, is_new] = number.try_emplace(edge, edges.size() + 1);
            if (is_new) edges.push_back(edge);
            face[k] = at->second;
        }
    }
    auto out = fmt::output_file(path.string());
    out.print("{} {} {}\n", mesh.vertices.size(), edges.size(), faces.size());
    for (const Vec3& p : mesh.vertices) out.print("{} {} {}\n", p.x(), p.y(), p.z());
    for (const auto& [a, b] : edges) out.print("{} {}\n", a + 1, b + 1);
    for (const auto& face : faces) out.print("{} {} {}\n", face[0], face[1], face[2]);
}

// Only one thread: its lattice is a loop in Python.
void compare_yade(Table& table, const Hull& hull) {
    const auto path = std::filesystem::temp_directory_path() / fmt::format("hull-{}.gts", getpid());
    write_gts(path, hull.mesh);
    const std::string command = fmt::format("timeout {} {} -n -x {} {} {} 2>/dev/null", kPatience,
                                            ICE_YADE, ICE_YADE_FILL, path.string(), hull.radius);
    Result result;
    FILE* pipe = popen(command.c_str(), "r");
    for (char line[256]; pipe != nullptr && std::fgets(line, sizeof line, pipe) != nullptr;)
        std::sscanf(line, "spheres %zu seconds %lf cpu %lf", &result.spheres, &result.cost.wall,
                    &result.cost.cpu);
    const int status = pipe != nullptr ? pclose(pipe) : -1;
    std::filesystem::remove(path);
    if (result.spheres > 0)
        table.add("YADE regularHexa(inGtsSurface)", hull, 1, result);
    else
        fmt::print("YADE regularHexa(inGtsSurface), {} hull: {}\n", hull.name,
                   WEXITSTATUS(status) == 124 ? "took too long" : "no answer");
}

#endif

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Fills of a hull by us, OpenVDB and YADE");
    bool smoke = false;
    std::string csv;
    app.add_flag("--smoke", smoke, "a small hull, to see that it runs");
    app.add_option("--csv", csv, "write the table here, too");
    CLI11_PARSE(app, argc, argv);

    fmt::print("{}, g++ {}\n", test::machine_name(), __VERSION__);
    Table table(csv);
    std::vector<Hull> hulls;
    if (smoke) hulls.push_back({"10 m", test::make_hull({10, 2, 1.8}, 1000), 0.2});
    if (!smoke) hulls.push_back({"10 m", test::make_hull({10, 2, 1.8}, 10000), 0.05});
    if (!smoke) hulls.push_back({"100 m", test::make_hull({100, 20, 18}, 100000), 0.1});
    for (const Hull& hull : hulls) {
        for (const int threads : {1, 2}) {
            set_thread_count(threads);
            [[maybe_unused]] const LatticeFill ours = fill_ours(table, hull, threads);
            layer_ours(table, hull, threads);
#ifdef ICE_WITH_OPENVDB
            compare_openvdb(table, hull, ours, threads);
#endif
        }
#ifdef ICE_YADE
        compare_yade(table, hull);
#endif
    }
#ifndef ICE_WITH_OPENVDB
    fmt::print("OpenVDB: not installed (libopenvdb-dev)\n");
#endif
#ifndef ICE_YADE
    fmt::print("YADE: not installed (yade)\n");
#endif
    return 0;
}
