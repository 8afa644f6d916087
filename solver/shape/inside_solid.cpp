// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shape/inside_solid.hpp"

#include <algorithm>
#include <cmath>

namespace ice {

namespace {

constexpr double kMostColumns = 512.0;  // along an axis

// Does the edge lie on the -x side of p, at p's y? The same answer for both directions of the edge.
bool passes(Vec3 a, Vec3 b, const Vec3& p) {
    if ((a.y() > p.y()) == (b.y() > p.y())) return false;
    if (a.y() > b.y()) std::swap(a, b);
    return a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) < p.x();
}

}  // namespace

InsideSolid::InsideSolid(const TriangleMesh& mesh) : mesh_(mesh) {
    for (const Vec3& v : mesh.vertices) box_.extend(v);
    const std::size_t triangles = mesh.triangles.size();
    if (triangles > 0)
        count_ = static_cast<std::size_t>(
            std::clamp(std::sqrt(static_cast<double>(triangles)), 1.0, kMostColumns));
    for (int d = 0; d < 2 && triangles > 0; ++d)
        if (box_.sizes()[d] > 0.0) per_metre_[d] = static_cast<double>(count_) / box_.sizes()[d];

    // first how many each column has, then which
    const auto each = [&](const auto& visit) {
        for (std::size_t t = 0; t < triangles; ++t) {
            Eigen::AlignedBox3d box;
            for (int k = 0; k < 3; ++k) box.extend(mesh.corner(t, k));
            for (std::size_t x = column(0, box.min().x()); x <= column(0, box.max().x()); ++x)
                for (std::size_t y = column(1, box.min().y()); y <= column(1, box.max().y()); ++y)
                    visit(x * count_ + y, t);
        }
    };
    first_.assign(count_ * count_ + 1, 0);
    each([&](std::size_t cell, std::size_t) { ++first_[cell + 1]; });
    for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
    items_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    each([&](std::size_t cell, std::size_t t) { items_[next[cell]++] = t; });
}

std::size_t InsideSolid::column(int axis, double x) const {
    const double k = std::floor((x - box_.min()[axis]) * per_metre_[axis]);
    return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(count_ - 1)));
}

bool InsideSolid::contains(const Vec3& p) const {
    if (box_.isEmpty() || !box_.contains(p)) return false;
    const std::size_t cell = column(0, p.x()) * count_ + column(1, p.y());
    std::size_t above = 0, below = 0;
    for (std::size_t k = first_[cell]; k < first_[cell + 1]; ++k) {
        const std::size_t t = items_[k];
        const Vec3 a = mesh_.corner(t, 0), b = mesh_.corner(t, 1), c = mesh_.corner(t, 2);
        if ((passes(a, b, p) != passes(b, c, p)) == passes(c, a, p)) continue;
        const Vec3 n = (b - a).cross(Vec3(c - a));
        const double height = a.z() + (n.x() * (a.x() - p.x()) + n.y() * (a.y() - p.y())) / n.z();
        ++(height > p.z() ? above : below);
    }
    return above % 2 == 1 && below % 2 == 1;
}

}  // namespace ice
