// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/weld.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace ice {

namespace {

constexpr double kTolerance = 1e-6;  // of the diagonal: rounding of single-precision files

using Cell = std::array<std::int64_t, 3>;

// For each vertex the first vertex within the tolerance, itself if none.
std::vector<std::int32_t> find_representatives(const std::vector<Vec3>& vertices) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : vertices) box.extend(v);
    const double tolerance = std::max(kTolerance * box.diagonal().norm(), 1e-300);
    // cells of twice the tolerance: near vertices lie in the same or a neighbouring cell
    const auto cell_of = [&](const Vec3& v) -> Cell {
        Cell cell;
        for (int d = 0; d < 3; ++d)
            cell[static_cast<std::size_t>(d)] =
                static_cast<std::int64_t>(std::floor((v[d] - box.min()[d]) / (2.0 * tolerance)));
        return cell;
    };
    std::map<Cell, std::vector<std::int32_t>> cells;
    std::vector<std::int32_t> representative(vertices.size());
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        const Cell at = cell_of(vertices[k]);
        auto found = static_cast<std::int32_t>(k);
        for (int n = 0; n < 27; ++n) {
            const auto near =
                cells.find({at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1});
            if (near == cells.end()) continue;
            for (const std::int32_t other : near->second)
                if ((vertices[static_cast<std::size_t>(other)] - vertices[k]).norm() <= tolerance)
                    found = std::min(found, other);
        }
        representative[k] = found;
        if (found == static_cast<std::int32_t>(k)) cells[at].push_back(found);
    }
    return representative;
}

}  // namespace

WeldCounts weld(TriangleMesh& mesh) {
    WeldCounts counts;
    const auto representative = find_representatives(mesh.vertices);
    TriangleMesh out;
    out.region_names = mesh.region_names;
    std::vector<std::int32_t> renumbered(mesh.vertices.size(), -1);
    std::set<std::array<std::int32_t, 3>> seen;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        std::array<std::int32_t, 3> corner = mesh.triangles[t];
        for (std::int32_t& v : corner) v = representative[static_cast<std::size_t>(v)];
        if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) {
            ++counts.degenerate_triangles;
            continue;
        }
        // the same triangle whichever corner comes first; its other side is another triangle
        std::array<std::int32_t, 3> key = corner;
        std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
        if (!seen.insert(key).second) {
            ++counts.duplicate_triangles;
            continue;
        }
        for (std::int32_t& v : corner) {
            std::int32_t& index = renumbered[static_cast<std::size_t>(v)];
            if (index < 0) {
                index = static_cast<std::int32_t>(out.vertices.size());
                out.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
            }
            v = index;
        }
        out.triangles.push_back(corner);
        out.region.push_back(mesh.region[t]);
    }
    // the same point written several times is how files and readers store corners: no repair
    for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
        const auto first = static_cast<std::size_t>(representative[k]);
        counts.merged_vertices += mesh.vertices[k] != mesh.vertices[first];
    }
    mesh = std::move(out);
    return counts;
}

}  // namespace ice
