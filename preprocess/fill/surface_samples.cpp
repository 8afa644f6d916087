// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/surface_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ice {

namespace {

int pieces(double length, double size) {
    return std::max(1, static_cast<int>(std::ceil(length / size)));
}

}  // namespace

// Strips parallel to the longest edge ab; c is the corner opposite to it.
void SurfaceSampler::add_strips(std::size_t t, std::vector<SurfaceSample>& out) const {
    const Vec3 vector = mesh_.area_vector(t);
    const double area = vector.norm();
    if (!(area > 0.0)) return;
    int longest = 0;
    double length = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double now = (mesh_.corner(t, (k + 1) % 3) - mesh_.corner(t, k)).norm();
        if (now > length) {
            length = now;
            longest = k;
        }
    }
    const Vec3 a = mesh_.corner(t, longest), b = mesh_.corner(t, (longest + 1) % 3),
               c = mesh_.corner(t, (longest + 2) % 3);
    const Vec3 normal = vector / area;
    // strips as high as the samples are apart; at the apex they become shorter
    const int rows = pieces(2.0 * area / length, size_);
    for (int row = 0; row < rows; ++row) {
        // a strip is a trapezoid between two heights; its pieces are equal trapezoids
        const double low = static_cast<double>(row) / rows, high = (row + 1.0) / rows;
        const double wide = 1.0 - low, narrow = 1.0 - high;
        const int count = pieces(0.5 * (wide + narrow) * length, size_);
        const double share = area * (high - low) * (wide + narrow) / count;
        // height of a trapezoid's centroid above its wide side
        const double up = low + (high - low) * (wide + 2.0 * narrow) / (3.0 * (wide + narrow));
        const Vec3 from = a + up * (c - a), to = b + up * (c - b);
        for (int k = 0; k < count; ++k)
            out.push_back({from + (k + 0.5) / count * (to - from), normal, share,
                           static_cast<std::int32_t>(t)});
    }
}

// A prism's side is two triangles; the one with two corners at the lower y represents both.
void SurfaceSampler::add_section(std::size_t t, std::vector<SurfaceSample>& out) const {
    Vec3 low[3];
    int count = 0;
    double y_low = std::numeric_limits<double>::infinity(), y_high = -y_low;
    for (int k = 0; k < 3; ++k) {
        y_low = std::min(y_low, mesh_.corner(t, k).y());
        y_high = std::max(y_high, mesh_.corner(t, k).y());
    }
    for (int k = 0; k < 3; ++k)
        if (mesh_.corner(t, k).y() < 0.5 * (y_low + y_high)) low[count++] = mesh_.corner(t, k);
    if (count != 2) return;
    const Vec3 a(low[0].x(), 0.0, low[0].z()), b(low[1].x(), 0.0, low[1].z());
    const double length = (b - a).norm();
    // per metre of breadth the area of a piece is its length
    const int k = pieces(length, size_);
    const Vec3 normal = mesh_.area_vector(t).normalized();
    for (int i = 0; i < k; ++i)
        out.push_back(
            {a + (i + 0.5) / k * (b - a), normal, length / k, static_cast<std::int32_t>(t)});
}

void SurfaceSampler::sample(std::size_t t, std::vector<SurfaceSample>& out) const {
    out.clear();
    if (dimension_ == 2) {
        const Vec3 vector = mesh_.area_vector(t);
        if (std::abs(vector.y()) < 0.5 * vector.norm()) add_section(t, out);
        return;
    }
    if (half_ &&
        std::max({mesh_.corner(t, 0).y(), mesh_.corner(t, 1).y(), mesh_.corner(t, 2).y()}) < 0.0)
        return;
    add_strips(t, out);
    if (!half_) return;
    // samples in the plane of symmetry belong to both halves
    std::erase_if(out, [](const SurfaceSample& s) { return s.point.y() < 0.0; });
    for (SurfaceSample& s : out)
        if (s.point.y() == 0.0) s.area *= 0.5;
}

}  // namespace ice
