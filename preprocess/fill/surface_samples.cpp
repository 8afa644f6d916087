// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/surface_samples.hpp"

#include <algorithm>
#include <cmath>

namespace ice {

namespace {

constexpr double kMostSamples = 2e6;

// The k^2 equal triangles of a triangle, centres only.
void add_triangle(const TriangleMesh& mesh, std::size_t t, int k, std::vector<SurfaceSample>& out) {
    const Vec3 a = mesh.corner(t, 0), u = (mesh.corner(t, 1) - a) / k,
               v = (mesh.corner(t, 2) - a) / k;
    const Vec3 area = mesh.area_vector(t);
    const double share = area.norm() / (static_cast<double>(k) * k);
    const Vec3 normal = area.normalized();
    for (int i = 0; i < k; ++i)
        for (int j = 0; i + j < k; ++j) {
            const auto add = [&](double s, double r) {
                out.push_back({a + s * u + r * v, normal, share, static_cast<std::int32_t>(t)});
            };
            add(i + 1.0 / 3.0, j + 1.0 / 3.0);
            if (i + j + 2 <= k) add(i + 2.0 / 3.0, j + 2.0 / 3.0);
        }
}

// A prism's side is two triangles; the one with two corners at the lower y stands for both.
void add_strips(const TriangleMesh& mesh, std::size_t t, double size,
                std::vector<SurfaceSample>& out) {
    Vec3 low[3];
    int count = 0;
    double y_low = 1e300, y_high = -1e300;
    for (int k = 0; k < 3; ++k) {
        y_low = std::min(y_low, mesh.corner(t, k).y());
        y_high = std::max(y_high, mesh.corner(t, k).y());
    }
    for (int k = 0; k < 3; ++k)
        if (mesh.corner(t, k).y() < 0.5 * (y_low + y_high)) low[count++] = mesh.corner(t, k);
    if (count != 2) return;
    const Vec3 a(low[0].x(), 0.0, low[0].z()), b(low[1].x(), 0.0, low[1].z());
    const double length = (b - a).norm();
    const int k = std::max(1, static_cast<int>(std::ceil(length / size)));
    const Vec3 normal = mesh.area_vector(t).normalized();
    for (int i = 0; i < k; ++i)
        out.push_back(
            {a + (i + 0.5) / k * (b - a), normal, length / k, static_cast<std::int32_t>(t)});
}

}  // namespace

std::vector<SurfaceSample> sample_surface(const TriangleMesh& mesh, double size, int dimension) {
    std::vector<SurfaceSample> out;
    double area = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += mesh.area_vector(t).norm();
    size = std::max(size, std::sqrt(2.0 * area / kMostSamples));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 vector = mesh.area_vector(t);
        if (dimension == 2) {
            if (std::abs(vector.y()) < 0.5 * vector.norm()) add_strips(mesh, t, size, out);
            continue;
        }
        double longest = 0.0;
        for (int k = 0; k < 3; ++k)
            longest = std::max(longest, (mesh.corner(t, k) - mesh.corner(t, (k + 1) % 3)).norm());
        add_triangle(mesh, t, std::max(1, static_cast<int>(std::ceil(longest / size))), out);
    }
    return out;
}

}  // namespace ice
