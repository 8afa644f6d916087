// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/geometry/rigid_body.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "common/base/assert.hpp"

namespace ice {

namespace {

// An eigenvector's sign is free; fixed here by its largest component.
Vec3 positive(const Vec3& axis) {
    Eigen::Index largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    return axis[largest] < 0.0 ? Vec3(-axis) : axis;
}

}  // namespace

RigidBody rigid_body(const MassProperties& solid, double density) {
    ICE_ASSERT(density > 0.0 && solid.volume > 0.0);
    RigidBody body;
    body.density = density;
    body.volume = solid.volume;
    body.mass = density * solid.volume;
    body.centroid = solid.centroid;
    // exactly symmetric: the sums of both triangles of the matrix round differently
    body.inertia = 0.5 * density * (solid.inertia + solid.inertia.transpose());

    // products of inertia that are rounding alone would turn the axes of a symmetric body
    Mat3 clean = body.inertia;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            // 1e-14 of the trace: some dozens of units in the last place
            if (r != c && std::abs(clean(r, c)) < 1e-14 * clean.trace()) clean(r, c) = 0.0;
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(clean);  // ascending eigenvalues
    body.moments = solver.eigenvalues();
    Mat3 axes;
    axes.col(0) = positive(solver.eigenvectors().col(0));
    axes.col(1) = positive(solver.eigenvectors().col(1));
    axes.col(2) = axes.col(0).cross(axes.col(1));
    body.axes = Eigen::Quaterniond(axes).normalized();
    // q and -q are the same rotation
    if (body.axes.w() < 0.0) body.axes.coeffs() *= -1.0;
    return body;
}

}  // namespace ice
