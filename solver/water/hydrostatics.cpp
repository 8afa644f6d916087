// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/water/hydrostatics.hpp"

#include <array>

namespace ice {

namespace {

// z-extent of the turned shape about the body origin
std::pair<double, double> vertical_extent(const Shape& shape, const Mat3& rotation) {
    double low = 1e300, high = -1e300;
    for (const Vec3& v : shape.mesh.vertices) {
        const double z = rotation.row(2).dot(v);
        low = std::min(low, z);
        high = std::max(high, z);
    }
    return {low, high};
}

struct Moments {
    double volume = 0.0;
    Vec3 first = Vec3::Zero();
};

// Adds int z n_z (1, x, y, z/2) dA over one triangle. The integrands are quadratic and cubic in the
// corners; with area A_z = n_z A and w the corner sums they close as below.
void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, Moments& m) {
    const double area_z =
        0.5 * ((b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y()));
    const double sum_z = a.z() + b.z() + c.z();
    m.volume += area_z * sum_z / 3.0;
    for (int d = 0; d < 2; ++d) {
        // int x z = A / 12 (sum x sum z + sum of products)
        const double products = a[d] * a.z() + b[d] * b.z() + c[d] * c.z();
        m.first[d] += area_z / 12.0 * ((a[d] + b[d] + c[d]) * sum_z + products);
    }
    const double squares = a.z() * a.z() + b.z() * b.z() + c.z() * c.z();
    m.first.z() += 0.5 * area_z / 12.0 * (sum_z * sum_z + squares);
}

// Clips a triangle by z <= 0 (Sutherland-Hodgman) and adds the wetted polygon as a fan.
void add_wetted(const std::array<Vec3, 3>& corner, Moments& m) {
    std::array<Vec3, 4> wet;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& p = corner[k];
        const Vec3& q = corner[(k + 1) % 3];
        if (p.z() <= 0.0) wet[count++] = p;
        if ((p.z() < 0.0 && q.z() > 0.0) || (p.z() > 0.0 && q.z() < 0.0)) {
            Vec3 cut = p + (q - p) * (p.z() / (p.z() - q.z()));
            cut.z() = 0.0;
            wet[count++] = cut;
        }
    }
    for (std::size_t k = 2; k < count; ++k) add_triangle(wet[0], wet[k - 1], wet[k], m);
}

}  // namespace

Submerged measure_submerged(const Shape& shape, const Mat3& rotation, double height) {
    Submerged out;
    // a sphere about the origin decides most cases without a look at the vertices
    if (height >= shape.bounding_radius) return out;
    const bool surely_below = height <= -shape.bounding_radius;
    const auto [low, high] =
        surely_below ? std::pair{-1.0, -1.0} : vertical_extent(shape, rotation);
    if (!surely_below && height + low >= 0.0) return out;
    if (surely_below || height + high <= 0.0) {
        out.volume = shape.solid.volume;
        out.centre = rotation * shape.solid.centroid;
        return out;
    }
    Moments m;
    const Vec3 lift(0.0, 0.0, height);
    for (const auto& t : shape.mesh.triangles) {
        std::array<Vec3, 3> corner;
        for (std::size_t k = 0; k < 3; ++k)
            corner[k] = rotation * shape.mesh.vertices[static_cast<std::size_t>(t[k])] + lift;
        add_wetted(corner, m);
    }
    if (m.volume <= 0.0) return out;
    out.volume = m.volume;
    out.centre = m.first / m.volume - lift;
    return out;
}

double floating_height(const Shape& shape, const Mat3& rotation, double fraction) {
    const auto [low, high] = vertical_extent(shape, rotation);
    double wet = -high, dry = -low;  // heights of the origin: all below, all above the water
    const double target = fraction * shape.solid.volume;
    if (target >= shape.solid.volume) return wet;
    while (dry - wet > 1e-12 * (high - low)) {
        const double middle = 0.5 * (wet + dry);
        if (middle == wet || middle == dry) break;
        (measure_submerged(shape, rotation, middle).volume > target ? wet : dry) = middle;
    }
    return 0.5 * (wet + dry);
}

}  // namespace ice
