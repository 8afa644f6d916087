// SPDX-License-Identifier: GPL-3.0-or-later
// How long it takes to fill a hull with a lattice of spheres; the numbers are in README.md here.
//
//   bench_lattice          the 100 m hull, 1e4 to 1e6 triangles, R = 0.1 and 0.05 m
//   bench_lattice --smoke  a few seconds' worth of it, to see that it runs
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>

#include "common/base/parallel.hpp"
#include "common/base/timer.hpp"
#include "preprocess/fill/clear_near.hpp"
#include "preprocess/fill/lattice.hpp"
#include "tests/preprocess/solid_oracle.hpp"
#include "tests/support/make_hull.hpp"

using namespace ice;

namespace {

struct Times {
    double least, median;  // [ms]
};

Times measure(int runs, const std::function<void()>& work) {
    std::vector<double> all;
    for (int k = 0; k < runs; ++k) {
        const Timer timer;
        work();
        all.push_back(1e3 * timer.seconds());
    }
    std::sort(all.begin(), all.end());
    return {all.front(), all[all.size() / 2]};
}

std::string machine() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

void print_fill(const TriangleMesh& hull, LatticeKind kind, double radius, int runs) {
    const LatticeOptions options{kind, radius, radius, 3, true};
    for (const int threads : {1, 2}) {
        set_thread_count(threads);
        LatticeFill fill;
        const Times whole = measure(runs, [&] { fill = fill_lattice_rows(hull, options); });
        LatticeFrame frame;
        const Times place =
            measure(runs, [&] { frame = place_lattice(hull, kind, radius, 3, true); });
        LatticeBits inside, bits;
        const Times scan = measure(runs, [&] { inside = rows_inside(hull, frame); });
        const Times clear = measure(runs, [&] {
            bits = inside;
            clear_near(hull, frame, radius * (1.0 - 1e-9), bits);
        });
        std::vector<Vec3> used(fill.count);
        const Times again = measure(runs, [&] { expand(fill, used); });
        const Times fresh = measure(3, [&] {
            std::vector<Vec3> centers(fill.count);
            expand(fill, centers);
        });
        const double points =
            static_cast<double>(frame.rows()) * static_cast<double>(frame.count[0]);
        fmt::print(
            "{:>9} {:>6g} {:>9} {:>10.3g} {:>9} {:>7} {:>8.2f} {:>8.2f} {:>7.2f} {:>7.2f} "
            "{:>7.2f} {:>8.2f} {:>8.2f}\n",
            kind == LatticeKind::cubic ? "cubic" : "hexagonal", radius, hull.triangles.size(),
            points, fill.count, threads, whole.least, whole.median, place.least, scan.least,
            clear.least, again.least, fresh.least);
    }
}

// The same question to CGAL, on every n-th point of the lattice's box.
void print_cgal(const TriangleMesh& hull, double radius, std::size_t sample) {
    set_thread_count(1);
    const LatticeOptions options{LatticeKind::hexagonal, radius, radius, 3, true};
    LatticeFill fill;
    const Times own = measure(5, [&] { fill = fill_lattice_rows(hull, options); });
    const LatticeFrame& frame = fill.frame;
    const std::size_t nx = static_cast<std::size_t>(frame.count[0]), all = frame.rows() * nx;
    std::vector<Vec3> points;
    std::vector<bool> taken;
    for (std::size_t p = 0; p < all; p += all / sample) {
        const std::size_t row = p / nx, i = p % nx;
        const auto ny = static_cast<std::size_t>(frame.count[1]);
        points.push_back(frame.point(static_cast<std::int64_t>(i),
                                     static_cast<std::int64_t>(row % ny),
                                     static_cast<std::int64_t>(row / ny)));
        taken.push_back((fill.bits[row * frame.words() + i / 64] >> (i % 64) & 1) != 0);
    }
    // a second call with one point takes the tree's building away
    const Timer building;
    test::ask_oracle(hull, {points.front()});
    const double build = building.seconds();
    const Timer asking;
    const auto answers = test::ask_oracle(hull, points);
    const double each = (asking.seconds() - build) / static_cast<double>(points.size());
    std::size_t unlike = 0;
    for (std::size_t k = 0; k < points.size(); ++k)
        unlike += taken[k] != (answers[k].inside && answers[k].distance >= radius * (1.0 - 1e-9));
    const double cgal = each * static_cast<double>(all);
    fmt::print(
        "CGAL Side_of_triangle_mesh and AABB distance, {} triangles, 1 thread: {:.2f} us a "
        "point on {} points ({} unlike ours), {:.3g} s for {:.3g} points; ours {:.3g} s, "
        "ratio {:.0f}\n",
        hull.triangles.size(), 1e6 * each, points.size(), unlike, cgal, static_cast<double>(all),
        1e-3 * own.least, 1e3 * cgal / own.least);
}

}  // namespace

int main(int argc, char** argv) {
    const bool smoke = argc > 1 && std::string_view(argv[1]) == "--smoke";
    const int runs = smoke ? 1 : 21;
    fmt::print("{}, g++ {}; times in ms\n", machine(), __VERSION__);
    fmt::print(
        "  lattice      R triangles     points   spheres threads  fill,min  median   place "
        "   scan   clear  expand  +pages\n");
    const test::HullSize size = smoke ? test::HullSize{10, 2, 1.8} : test::HullSize{};
    const auto counts =
        smoke ? std::vector<std::size_t>{1000} : std::vector<std::size_t>{10000, 100000, 1000000};
    for (const std::size_t count : counts) {
        const TriangleMesh hull = test::make_hull(size, count);
        print_fill(hull, LatticeKind::hexagonal, 0.1, runs);
        if (count == 100000) {
            print_fill(hull, LatticeKind::cubic, 0.1, runs);
            print_fill(hull, LatticeKind::hexagonal, 0.05, 5);
        }
        if (count <= 100000) print_cgal(hull, 0.1, smoke ? 1000 : 20000);
    }
    return 0;
}
