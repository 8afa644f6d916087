// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/geometry/mass_properties.hpp"

#include <Eigen/Dense>
#include <Eigen/Geometry>

namespace ice {

MassProperties measure_mass(const TriangleMesh& mesh) {
    MassProperties out;
    if (mesh.triangles.empty()) return out;
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    const Vec3 reference = box.center();

    Vec3 first = Vec3::Zero();   // int x dV
    Mat3 second = Mat3::Zero();  // int x x^T dV
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 a = mesh.corner(t, 0) - reference;
        const Vec3 b = mesh.corner(t, 1) - reference;
        const Vec3 c = mesh.corner(t, 2) - reference;
        const Vec3 s = a + b + c;
        const double volume = a.dot(b.cross(c)) / 6.0;
        out.volume += volume;
        out.area += mesh.area_vector(t).norm();
        first += volume / 4.0 * s;
        second += volume / 20.0 *
                  (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
    }
    if (out.volume == 0.0) return out;

    const Vec3 mean = first / out.volume;
    const Mat3 central = second - out.volume * mean * mean.transpose();
    out.centroid = reference + mean;
    out.inertia = central.trace() * Mat3::Identity() - central;
    return out;
}

}  // namespace ice
