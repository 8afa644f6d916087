// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/statistics/bottom_coverage.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "postprocess/statistics/choose_frames.hpp"
#include "postprocess/views/depth_map.hpp"
#include "postprocess/views/seen_triangle.hpp"

namespace ice::statistics {

namespace {

// Cells along the hull [-]: a hull of usual proportions then has some 10 000 wet cells, so steps of
// the share are 0.01 %. Twice as many take four times as long.
constexpr int kColumns = 300;

// Heights of the wetted hull on a grid over its plan, ship frame.
struct Plan {
    Eigen::AlignedBox3d box;
    double cell = 1.0;
    long columns = 0, rows = 0;
    std::vector<double> height;  // [rows x columns] lowest z of the hull; NaN where it is dry
    std::size_t wet = 0;

    Plan(const TriangleMesh& hull, double waterline) {
        for (const Vec3& v : hull.vertices) box.extend(v);
        cell = std::max(box.sizes().x(), box.sizes().y()) / kColumns;
        columns = static_cast<long>(std::ceil(box.sizes().x() / cell));
        rows = static_cast<long>(std::ceil(box.sizes().y() / cell));
        // the map of the viewer's nearest surface serves as the map of lowest points
        const auto from = views::projection_of(views::ViewFrom::below);
        const views::DepthMap map(hull, from, kColumns);
        for (long r = 0; r < rows; ++r)
            for (long c = 0; c < columns; ++c) {
                const Vec3 page = from.apply(Vec3(x(c), y(r), 0.0));
                // seen from below the nearest point is the lowest: nearness is -z
                const double z = -map.nearness(page.x(), page.y());
                const bool is_wet = std::isfinite(z) && z < waterline;
                height.push_back(is_wet ? z : std::nan(""));
                wet += is_wet ? 1 : 0;
            }
    }
    double x(long column) const {
        return box.min().x() + (static_cast<double>(column) + 0.5) * cell;
    }
    double y(long row) const { return box.min().y() + (static_cast<double>(row) + 0.5) * cell; }
    // first cell whose centre is at or beyond a place, cut to the grid
    static long first(double from_edge, double cell, long count) {
        return std::clamp(std::lround(std::ceil(from_edge / cell - 0.5)), 0L, count);
    }
};

// Marks the cells in which the triangle lies below the hull.
void cover(const Plan& plan, const Vec3 corner[3], std::vector<char>& covered) {
    const Vec3 &a = corner[0], &b = corner[1], &c = corner[2];
    const views::SeenTriangle seen(a, b, c);
    if (seen.covers_nothing()) return;
    const auto range = [&](int axis, double origin, long count) {
        const auto [low, high] = std::minmax({a[axis], b[axis], c[axis]});
        return std::pair(Plan::first(low - origin, plan.cell, count),
                         Plan::first(high - origin, plan.cell, count));
    };
    // Only cells whose centres can lie in the triangle are tested. Centres, not areas: the sum over
    // cells has no bias, and neighbouring triangles count no cell twice.
    const auto [c0, c1] = range(0, plan.box.min().x(), plan.columns);
    const auto [r0, r1] = range(1, plan.box.min().y(), plan.rows);
    for (long row = r0; row < r1; ++row)
        for (long column = c0; column < c1; ++column) {
            const auto z = seen.z_at(plan.x(column), plan.y(row));
            const auto k = static_cast<std::size_t>(row * plan.columns + column);
            // NaN compares false: dry cells stay uncovered
            if (z && *z < plan.height[k]) covered[k] = 1;
        }
}

double covered_share(const Plan& plan, const RunHeader& header, const std::vector<double>& radius,
                     const RunFrame& frame) {
    std::vector<char> covered(plan.height.size(), 0);
    for (std::size_t b = 0; b < frame.position.size(); ++b) {
        if (frame.state[b] == FloeState::absent) continue;
        const auto shape = static_cast<std::size_t>(header.body_shape[b]);
        const Vec3 offset = frame.position[b] - frame.ship_position;
        // no part of this floe lies below the hull
        if (plan.box.exteriorDistance(offset) > radius[shape]) continue;
        const Mat3 turn = frame.orientation[b].toRotationMatrix();
        const TriangleMesh& mesh = header.shapes[shape].mesh;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            Vec3 corner[3];
            for (int k = 0; k < 3; ++k) corner[k] = offset + turn * mesh.corner(t, k);
            cover(plan, corner, covered);
        }
    }
    return static_cast<double>(std::count(covered.begin(), covered.end(), 1)) /
           static_cast<double>(plan.wet);
}

}  // namespace

BottomCoverage measure_bottom_coverage(const RunData& run, std::size_t frames) {
    BottomCoverage out;
    if (run.frames.empty() || run.header.shapes.empty() ||
        run.header.shapes[0].mesh.triangles.empty())
        return out;
    // in the hull's axes the water lies at minus the ship's height
    const Plan plan(run.header.shapes[0].mesh, -run.frames.front().ship_position.z());
    if (plan.wet == 0) return out;
    out.area = static_cast<double>(plan.wet) * plan.cell * plan.cell;
    std::vector<double> radius;
    for (const RunShape& shape : run.header.shapes) {
        radius.push_back(0.0);
        for (const Vec3& v : shape.mesh.vertices) radius.back() = std::max(radius.back(), v.norm());
    }
    for (const std::size_t f : choose_frames(run.frames.size(), frames)) {
        out.time.push_back(run.frames[f].time);
        out.share.push_back(covered_share(plan, run.header, radius, run.frames[f]));
    }
    return out;
}

}  // namespace ice::statistics
