// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/lattice.hpp"

#include <bit>

#include "common/base/assert.hpp"
#include "common/base/parallel.hpp"
#include "preprocess/fill/clear_near.hpp"

namespace ice {

namespace {

// Share of the clearance [-] by which a point may be nearer: spheres then may touch flat faces. A
// larger value lets spheres reach out by as much, a smaller one drops spheres that touch.
constexpr double kClearanceRounding = 1e-9;
// Layers along z, and runs of some hundred spheres each, below which waking threads costs more than
// it saves. They change the time alone.
constexpr std::size_t kSerialLayers = 16;
constexpr std::size_t kSerialRuns = 1000;

// A point stays only with its mirror image: rounding could let one of the two in.
void keep_pairs(const LatticeFrame& frame, LatticeBits& bits, std::int64_t k) {
    const std::size_t words = frame.words();
    for (std::int64_t j = 0; j < frame.count[1] / 2; ++j) {
        std::uint64_t* const one = bits.data() + frame.row(j, k) * words;
        std::uint64_t* const other = bits.data() + frame.row(frame.count[1] - 1 - j, k) * words;
        for (std::size_t w = 0; w < words; ++w) one[w] = other[w] = one[w] & other[w];
    }
}

void find_runs(const LatticeFrame& frame, const LatticeBits& bits, std::int64_t k,
               std::vector<LatticeRun>& out) {
    const auto words = static_cast<std::int64_t>(frame.words());
    for (std::int64_t j = 0; j < frame.count[1]; ++j) {
        const std::uint64_t* const row = bits.data() + frame.row(j, k) * frame.words();
        // each end of a run is a bit unlike the one before it
        std::int64_t first = -1;
        for (std::int64_t w = 0; w < words; ++w) {
            std::uint64_t ends = row[w] ^ (row[w] << 1 | (first >= 0 ? 1u : 0u));
            // Of 64 points at a time only the ends of runs are visited; rows of a solid have few.
            for (; ends != 0; ends &= ends - 1) {
                const std::int64_t at = 64 * w + std::countr_zero(ends);
                if (first < 0) {
                    first = at;
                    continue;
                }
                out.push_back({static_cast<std::int32_t>(j), static_cast<std::int32_t>(k),
                               static_cast<std::int32_t>(first),
                               static_cast<std::int32_t>(at - first)});
                first = -1;
            }
        }
        if (first >= 0)
            out.push_back({static_cast<std::int32_t>(j), static_cast<std::int32_t>(k),
                           static_cast<std::int32_t>(first),
                           static_cast<std::int32_t>(64 * words - first)});
    }
}

}  // namespace

LatticeFill fill_lattice_rows(const TriangleMesh& mesh, const LatticeOptions& o) {
    LatticeFill out;
    // Three steps: the frame of points, the rows' parts inside the solid, then the points too
    // near to the surface.
    out.frame = place_lattice(mesh, o.kind, o.radius, o.dimension, o.mirror);
    out.bits = rows_inside(mesh, out.frame);
    clear_near(mesh, out.frame, o.clearance * (1.0 - kClearanceRounding), out.bits);

    std::vector<std::vector<LatticeRun>> layers(static_cast<std::size_t>(out.frame.count[2]));
    parallel_for(layers.size(), kSerialLayers, [&](std::size_t k) {
        const auto layer = static_cast<std::int64_t>(k);
        // Layers are independent: rows of one layer mirror into rows of the same layer.
        if (o.mirror) keep_pairs(out.frame, out.bits, layer);
        find_runs(out.frame, out.bits, layer, layers[k]);
    });
    for (const auto& layer : layers) {
        out.runs.insert(out.runs.end(), layer.begin(), layer.end());
        for (const LatticeRun& run : layer) out.count += static_cast<std::size_t>(run.count);
    }
    return out;
}

void expand(const LatticeFill& fill, std::span<Vec3> out) {
    // Offsets first: each run then writes its own part of the result, in any order of threads.
    std::vector<std::size_t> offset;
    std::size_t sum = 0;
    for (const LatticeRun& run : fill.runs) {
        offset.push_back(sum);
        sum += static_cast<std::size_t>(run.count);
    }
    parallel_for(fill.runs.size(), kSerialRuns, [&](std::size_t r) {
        const LatticeRun& run = fill.runs[r];
        const double y = fill.frame.y(run.j), z = fill.frame.z(run.j, run.k);
        const double start = fill.frame.start(run.j, run.k), step = fill.frame.step.x();
        Vec3* to = out.data() + offset[r];
        for (std::int32_t i = run.first; i < run.first + run.count; ++i)
            *to++ = {start + step * i, y, z};
    });
}

std::vector<std::uint8_t> outer_spheres(const LatticeFill& fill, int dimension) {
    ICE_ASSERT(fill.frame.kind == LatticeKind::cubic);
    const LatticeFrame& frame = fill.frame;
    // beyond the frame there is no point
    const auto is_set = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
        if (i < 0 || j < 0 || k < 0 || i >= frame.count[0] || j >= frame.count[1] ||
            k >= frame.count[2])
            return false;
        const std::uint64_t word =
            fill.bits[frame.row(j, k) * frame.words() + static_cast<std::size_t>(i >> 6)];
        return (word >> (i & 63) & 1) != 0;
    };
    std::vector<std::uint8_t> out;
    out.reserve(fill.count);
    for (const LatticeRun& run : fill.runs)
        for (std::int64_t i = run.first; i < run.first + run.count; ++i) {
            // a sphere with all its neighbours along the axes lies inside, any other one is outer
            bool whole = is_set(i - 1, run.j, run.k) && is_set(i + 1, run.j, run.k) &&
                         is_set(i, run.j, run.k - 1) && is_set(i, run.j, run.k + 1);
            if (dimension == 3)
                whole = whole && is_set(i, run.j - 1, run.k) && is_set(i, run.j + 1, run.k);
            out.push_back(whole ? 0 : 1);
        }
    return out;
}

Lattice fill_lattice(const SurfaceTree& tree, double radius, double clearance, int dimension,
                     bool mirror) {
    const LatticeFill fill =
        fill_lattice_rows(tree.mesh(), {LatticeKind::cubic, radius, clearance, dimension, mirror});
    Lattice out;
    out.centers.resize(fill.count);
    expand(fill, out.centers);
    out.outer = outer_spheres(fill, dimension);
    return out;
}

}  // namespace ice
