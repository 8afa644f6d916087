// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/verify_solid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/parallel.hpp"
#include "common/geometry/edge_table.hpp"
#include "common/geometry/mass_properties.hpp"
#include "common/geometry/winding_number.hpp"
#include "preprocess/measure/row_volumes.hpp"

namespace ice {

namespace {

// Largest relative difference of volumes that agree [-]. At 100 rows the sampling error is about
// 0.1 % on a ship, so that a sound solid passes at once; a larger value passes solids with a part
// missing.
constexpr double kRowError = 0.005;
// Rows per side of the box, tried in turn until they agree. The last takes a hundred times as long
// as the first and is reached by slender solids alone.
constexpr int kRows[] = {100, 300, 1000};

// Van der Corput sequence in a base: with bases 2, 3, 5 it fills the box evenly (Halton).
double radical_inverse(std::uint64_t k, std::uint64_t base) {
    double out = 0.0, digit = 1.0;
    for (; k > 0; k /= base) {
        digit /= static_cast<double>(base);
        out += digit * static_cast<double>(k % base);
    }
    return out;
}

}  // namespace

SolidProof verify_solid(const TriangleMesh& mesh, double overlap_allowed) {
    SolidProof proof;
    const auto edges = edge_table(mesh);
    const auto bad = std::count_if(edges.begin(), edges.end(),
                                   [](const MeshEdge& edge) { return !edge.regular(); });
    if (bad > 0) {
        proof.fault = fmt::format("{} edges do not have two triangles facing one side", bad);
        return proof;
    }
    proof.volume = measure_mass(mesh).volume;
    if (!(proof.volume > 0.0)) {
        proof.fault = "the volume is zero";
        return proof;
    }
    // Three independent counts of the volume along rows in x, y, z: by sign, by winding number, by
    // parity. They agree only for a surface that is closed, outward and does not overlap itself.
    // Few rows first: a good mesh is accepted early, a finer count is made only where the first is
    // in doubt.
    for (const int rows : kRows) {
        proof.row_error = proof.overlap = 0.0;
        for (const RowVolume& axis : measure_rows(mesh, rows)) {
            proof.row_error =
                std::max(proof.row_error, std::abs(axis.by_sign / proof.volume - 1.0));
            for (const double other : {axis.by_winding, axis.by_parity})
                proof.overlap =
                    std::max(proof.overlap, std::abs(other - axis.by_sign) / proof.volume);
        }
        if (proof.row_error <= kRowError) break;
    }
    if (proof.row_error > kRowError)
        proof.fault =
            fmt::format("its volume along three axes differs by {:.2g} %", 100.0 * proof.row_error);
    else if (proof.overlap > overlap_allowed)
        proof.fault = fmt::format("{:.2g} % of its volume is counted twice or not at all",
                                  100.0 * proof.overlap);
    proof.good = proof.fault.empty();
    return proof;
}

WindingComparison compare_windings(const TriangleMesh& open, const TriangleMesh& closed) {
    // Places of a Halton sequence [-]: their error falls faster than that of random ones, and they
    // are the same in every run. 20 000 places give a volume within about 1 %; more take longer.
    constexpr std::size_t kPlaces = 20000;
    const WindingNumber first(open), second(closed);
    Eigen::AlignedBox3d box;
    for (const Vec3& v : closed.vertices) box.extend(v);
    enum : std::uint8_t { in_first = 1, in_second = 2, vague = 4 };
    std::vector<std::uint8_t> found(kPlaces, 0);
    parallel_for(kPlaces, 100, [&](std::size_t k) {
        const Vec3 unit(radical_inverse(k + 1, 2), radical_inverse(k + 1, 3),
                        radical_inverse(k + 1, 5));
        const Vec3 p = box.min() + box.sizes().cwiseProduct(unit);
        // near 0 and 1 the winding number of an open surface is clear; between, the place is near
        // an opening
        const double w = std::abs(first.at(p));
        found[k] = static_cast<std::uint8_t>((first.contains(p) ? in_first : 0) |
                                             (second.contains(p) ? in_second : 0) |
                                             (w > 0.2 && w < 0.8 ? vague : 0));
    });
    std::array<double, 8> count{};
    for (const std::uint8_t f : found) count[f] += 1.0;
    const double one = count[1] + count[5], other = count[2] + count[6], both = count[3] + count[7];
    const double total = std::max(other + both, 1.0), share = box.volume() / kPlaces;
    WindingComparison out;
    out.differs = (one + other) / total;
    out.unclear = (count[4] + count[5] + count[6] + count[7]) / total;
    out.first_volume = (one + both) * share;
    out.second_volume = (other + both) * share;
    return out;
}

}  // namespace ice
