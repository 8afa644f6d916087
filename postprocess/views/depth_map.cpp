// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/views/depth_map.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "postprocess/views/seen_triangle.hpp"

namespace ice::views {

namespace {

// Nearness of a cell in which the viewer sees nothing [m]: below that of any triangle, so the first
// one replaces it.
constexpr double kNothing = -std::numeric_limits<double>::infinity();

}  // namespace

DepthMap::DepthMap(const TriangleMesh& mesh, const Projection& projection, int columns) {
    if (mesh.triangles.empty()) return;
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(projection.apply(v));
    cell_ = std::max(box.sizes().x(), box.sizes().y()) / columns;
    if (!(cell_ > 0.0)) return;
    right0_ = box.min().x();
    up0_ = box.min().y();
    // one more column and row: the far border lies in a cell, too
    columns_ = static_cast<int>(box.sizes().x() / cell_) + 1;
    rows_ = static_cast<int>(box.sizes().y() / cell_) + 1;
    nearest_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), kNothing);
    triangle_.assign(nearest_.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        draw(t, projection.apply(mesh.corner(t, 0)), projection.apply(mesh.corner(t, 1)),
             projection.apply(mesh.corner(t, 2)));
}

void DepthMap::draw(std::size_t triangle, const Vec3& a, const Vec3& b, const Vec3& c) {
    const SeenTriangle seen(a, b, c);
    if (seen.covers_nothing()) return;
    const auto column = [&](double right) { return static_cast<int>((right - right0_) / cell_); };
    const auto row = [&](double up) { return static_cast<int>((up - up0_) / cell_); };
    const int first = std::max(0, column(std::min({a.x(), b.x(), c.x()})));
    const int last = std::min(columns_ - 1, column(std::max({a.x(), b.x(), c.x()})));
    const int bottom = std::max(0, row(std::min({a.y(), b.y(), c.y()})));
    const int top = std::min(rows_ - 1, row(std::max({a.y(), b.y(), c.y()})));
    // cell by cell the triangle nearest to the viewer, at the cell's middle
    for (int r = bottom; r <= top; ++r)
        for (int k = first; k <= last; ++k) {
            const auto nearness = seen.z_at(right0_ + (k + 0.5) * cell_, up0_ + (r + 0.5) * cell_);
            const auto cell = static_cast<std::size_t>(r * columns_ + k);
            if (!nearness || *nearness <= nearest_[cell]) continue;
            nearest_[cell] = *nearness;
            triangle_[cell] = triangle;
        }
}

std::optional<std::size_t> DepthMap::cell(double right, double up) const {
    if (columns_ == 0 || right < right0_ || up < up0_) return std::nullopt;
    const double k = (right - right0_) / cell_, r = (up - up0_) / cell_;
    if (k >= columns_ || r >= rows_) return std::nullopt;
    return static_cast<std::size_t>(static_cast<int>(r) * columns_ + static_cast<int>(k));
}

double DepthMap::nearness(double right, double up) const {
    const auto at = cell(right, up);
    return at ? nearest_[*at] : kNothing;
}

std::optional<std::size_t> DepthMap::triangle(double right, double up) const {
    const auto at = cell(right, up);
    if (!at || nearest_[*at] == kNothing) return std::nullopt;
    return triangle_[*at];
}

}  // namespace ice::views
