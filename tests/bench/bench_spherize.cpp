// SPDX-License-Identifier: GPL-3.0-or-later
// How long spherize takes, step by step and as a command; tests/bench/README.md has the numbers.
//
//   bench_spherize SPHERIZE PAPER_HULL          the paper's hull and a 100 m hull at R = 0.1 m
//   bench_spherize SPHERIZE PAPER_HULL --smoke  small ones, to see that it runs
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "common/base/parallel.hpp"
#include "common/base/timer.hpp"
#include "preprocess/clean/weld.hpp"
#include "preprocess/fill/fill_spheres.hpp"
#include "preprocess/fill/make_layer.hpp"
#include "preprocess/load/read_mesh.hpp"
#include "preprocess/measure/mirror_symmetry.hpp"
#include "tests/bench/machine.hpp"
#include "tests/support/make_hull.hpp"

using namespace ice;

namespace {

// By the clock, and as processor time of all threads, which other programs lengthen little.
struct Times {
    double wall = 1e300, cpu = 1e300;  // [ms]
};

Times least_times(int runs, const std::function<void()>& work) {
    Times least;
    for (int k = 0; k < runs; ++k) {
        const Timer timer;
        const std::clock_t start = std::clock();
        work();
        least.wall = std::min(least.wall, 1e3 * timer.seconds());
        least.cpu =
            std::min(least.cpu, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return least;
}

void print_layer(const char* name, const TriangleMesh& mesh, double radius, int runs) {
    const double area = measure_mass(mesh).area;
    for (const bool mirror : {true, false})
        for (const int threads : {1, 2}) {
            set_thread_count(threads);
            const SurfaceTree tree(mesh);
            if (mirror && !is_mirror_symmetric(tree)) continue;
            std::size_t count = 0;
            const Times layer = least_times(runs, [&] {
                count = make_layer(tree, {radius, radius, 3, mirror}).size();
            });
            fmt::print("{:>12} {:>9} {:>6} {:>7} {:>9} {:>10.2f} {:>10.2f} {:>9.2f} {:>8.3f}\n",
                       name, mesh.triangles.size(), mirror ? "yes" : "no", threads, count,
                       layer.wall, layer.cpu, 1e3 * layer.wall / static_cast<double>(count),
                       static_cast<double>(count) * std::sqrt(0.75) * radius * radius / area);
        }
}

// Binary STL, as yards send it: three corners a triangle, nothing shared.
void write_stl(const std::filesystem::path& path, const TriangleMesh& mesh) {
    std::ofstream out(path, std::ios::binary);
    out << std::string(80, ' ');
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    out.write(reinterpret_cast<const char*>(&count), sizeof count);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Eigen::Vector3f normal = mesh.area_vector(t).normalized().cast<float>();
        out.write(reinterpret_cast<const char*>(normal.data()), 12);
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3f corner = mesh.corner(t, k).cast<float>();
            out.write(reinterpret_cast<const char*>(corner.data()), 12);
        }
        out.write("\0", 2);
    }
}

struct CommandCost {
    double seconds, cpu, memory;  // [s], [s] of all threads, largest resident size [GB]
};

CommandCost run_command(const std::vector<std::string>& arguments) {
    std::vector<char*> argv;
    for (const std::string& argument : arguments) argv.push_back(strdup(argument.c_str()));
    argv.push_back(nullptr);
    const Timer timer;
    const pid_t child = fork();
    if (child == 0) {
        execv(argv[0], argv.data());
        _exit(127);
    }
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    for (char* argument : argv) std::free(argument);
    if (status != 0) {
        fmt::print(stderr, "{} failed\n", arguments.front());
        std::exit(1);
    }
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return {timer.seconds(), seconds(usage.ru_utime) + seconds(usage.ru_stime),
            1024.0 * static_cast<double>(usage.ru_maxrss) / 1e9};
}

void print_command(const std::string& spherize, const char* name, const TriangleMesh& mesh,
                   double radius, int runs) {
    const auto folder =
        std::filesystem::temp_directory_path() / fmt::format("spherize-{}", getpid());
    std::filesystem::create_directories(folder);
    write_stl(folder / "hull.stl", mesh);
    for (const char* mode : {"surface", "fill"})
        for (const char* threads : {"1", "2"}) {
            CommandCost least{1e300, 1e300, 0.0};
            for (int k = 0; k < runs; ++k) {
                const CommandCost cost = run_command(
                    {spherize, folder / "hull.stl", "-q", "-r", fmt::format("{}", radius), "--mode",
                     mode, "--threads", threads, "--units", "m", "-o", folder / "hull.spheres.h5"});
                least.seconds = std::min(least.seconds, cost.seconds);
                least.cpu = std::min(least.cpu, cost.cpu);
                least.memory = std::max(least.memory, cost.memory);
            }
            fmt::print(
                "{:>12} {:>9} {:>9} {:>7} {:>9.3f} {:>9.3f} {:>7.2f} {:>9.1f}\n", name,
                mesh.triangles.size(), mode, threads, least.seconds, least.cpu, least.memory,
                static_cast<double>(std::filesystem::file_size(folder / "hull.spheres.h5")) / 1e6);
        }
    std::filesystem::remove_all(folder);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        fmt::print(stderr, "usage: bench_spherize SPHERIZE PAPER_HULL [--smoke]\n");
        return 2;
    }
    const bool smoke = argc > 3 && std::string_view(argv[3]) == "--smoke";
    const int runs = smoke ? 1 : 5;
    fmt::print("{}, g++ {}\n", test::machine_name(), __VERSION__);
    TriangleMesh paper = read_mesh(argv[2], {});
    weld(paper);  // as spherize does: edges are where triangles share vertices
    const TriangleMesh hull =
        smoke ? test::make_hull({10, 2, 1.8}, 1000) : test::make_hull({100, 20, 18}, 100000);
    fmt::print("\nsurface layer, R = spacing = 0.1 m; hex: spheres over those of an ideal layer\n");
    fmt::print("{:>12} {:>9} {:>6} {:>7} {:>9} {:>10} {:>10} {:>9} {:>8}\n", "hull", "triangles",
               "mirror", "threads", "spheres", "ms", "cpu ms", "us/sphere", "hex");
    print_layer("paper", paper, 0.1, 3 * runs);
    print_layer("100 m", hull, 0.1, runs);
    fmt::print("\nspherize hull.stl -r 0.1: the whole command\n");
    fmt::print("{:>12} {:>9} {:>9} {:>7} {:>9} {:>9} {:>7} {:>9}\n", "hull", "triangles", "mode",
               "threads", "s", "cpu s", "GB", "file, MB");
    print_command(argv[1], "paper", paper, 0.1, runs);
    print_command(argv[1], "100 m", hull, 0.1, runs);
    return 0;
}
