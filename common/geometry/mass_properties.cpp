// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/geometry/mass_properties.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <cmath>

namespace ice {

MassProperties measure_mass(const TriangleMesh& mesh) {
    MassProperties out;
    if (mesh.triangles.empty()) return out;
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    // Any reference point gives the same sums. With one amidst the mesh the tetrahedra are no
    // larger than the solid, so a mesh far from its origin loses no digits by cancellation.
    const Vec3 reference = box.center();

    Vec3 first = Vec3::Zero();   // int x dV
    Mat3 second = Mat3::Zero();  // int x x^T dV
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 a = mesh.corner(t, 0) - reference;
        const Vec3 b = mesh.corner(t, 1) - reference;
        const Vec3 c = mesh.corner(t, 2) - reference;
        const Vec3 s = a + b + c;
        // Signed: a tetrahedron on the outer side of the surface counts negative. The sums over all
        // triangles are those of the solid, whatever part of the tetrahedra lies outside it.
        const double volume = a.dot(b.cross(c)) / 6.0;
        out.volume += volume;
        out.area += mesh.area_vector(t).norm();
        first += volume / 4.0 * s;
        second += volume / 20.0 *
                  (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
    }
    // a flat or empty mesh has no centroid
    if (out.volume == 0.0) return out;

    const Vec3 mean = first / out.volume;
    // Steiner: second moments about the centroid. The inertia tensor is int (|x|^2 1 - x x^T) dV,
    // the trace of int x x^T dV less that matrix.
    const Mat3 central = second - out.volume * mean * mean.transpose();
    out.centroid = reference + mean;
    out.inertia = central.trace() * Mat3::Identity() - central;
    return out;
}

std::string fault_of(const MassProperties& solid) {
    // Of the largest entry, and of the trace [-]: rounding of the sums over a fine mesh is below
    // 1e-12. A smaller value refuses plates, a larger one passes tensors with a wrong digit.
    constexpr double kRounding = 1e-9;
    const auto positive = [](double x) { return x > 0.0 && std::isfinite(x); };
    if (!positive(solid.volume)) return fmt::format("a volume of {:g} m3", solid.volume);
    if (!positive(solid.area)) return fmt::format("a surface of {:g} m2", solid.area);
    if (!solid.centroid.allFinite()) return "a centroid that is no number";
    if (!solid.inertia.allFinite()) return "an inertia that is no number";
    const Mat3& inertia = solid.inertia;
    // Each test needs the one before it: the eigenvalues of a matrix that is not symmetric, or has
    // no number in it, have no effect.
    const double size = inertia.cwiseAbs().maxCoeff();
    if ((inertia - inertia.transpose()).cwiseAbs().maxCoeff() > kRounding * size)
        return "an inertia that is not symmetric";
    const Vec3 m = Eigen::SelfAdjointEigenSolver<Mat3>(inertia, Eigen::EigenvaluesOnly)
                       .eigenvalues();  // ascending
    if (!(m[0] > 0.0)) return fmt::format("a moment of inertia of {:g} m5", m[0]);
    // I_1 + I_2 - I_3 = 2 int x_3^2 dV is negative for no distribution of mass. A plate has 0, so
    // rounding must be allowed for.
    if (m[2] > m[0] + m[1] + kRounding * m.sum())
        return fmt::format(
            "moments of inertia {:g}, {:g} and {:g} m5: one is above the sum of the "
            "others",
            m[0], m[1], m[2]);
    return {};
}

}  // namespace ice
