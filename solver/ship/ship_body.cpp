// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/ship/ship_body.hpp"

#include <algorithm>
#include <cmath>

#include "common/math/ordered_products.hpp"
#include "solver/integrate/rotation.hpp"
#include "solver/ship/ship_matrix.hpp"
#include "solver/water/hydrostatics.hpp"

namespace ice {

namespace {

void take_diagonal(const Mat6& matrix, SixNumbers& out) {
    for (int k = 0; k < kFreedoms; ++k) out[static_cast<std::size_t>(k)] = matrix(k, k);
}

// About the centre of gravity.
void take_matrix(const ShipMatrix& given, ShipBody& out) {
    const Vec3 arm = out.centre_of_gravity - given.about;
    Mat6 mass = moved(given.added, arm);
    take_diagonal(mass, out.added);
    take_diagonal(moved(given.damping, arm), out.water_damping);
    mass.diagonal().head<3>().array() += out.mass;
    mass.diagonal().tail<3>() += out.inertia;
    out.coupling = largest_coupling(mass);
}

}  // namespace

bool ShipBody::any_free() const {
    return std::any_of(free.begin(), free.end(), [](bool f) { return f; });
}

ShipBody make_ship_body(const Case& p, const Scene& scene) {
    const Shape& hull = scene.shapes[0];
    const Submerged wet =
        measure_submerged(hull, Mat3::Identity(), scene.bodies.position[kShip].z());
    ShipBody out;
    out.free = p.ship.free;
    // not-a-number means "not given": the mass of the displaced water, at its centre
    out.mass = std::isnan(p.ship.mass) ? p.water_density * wet.volume : p.ship.mass;
    out.centre_of_gravity =
        p.ship.centre_of_gravity.hasNaN() ? wet.centre : p.ship.centre_of_gravity;
    const Vec3 size = hull.box.sizes();
    // usual radii of gyration of ships: 0.35 breadths in roll, a quarter of the length in pitch and
    // yaw
    const Vec3 usual(0.35 * size.y(), 0.25 * size.x(), 0.25 * size.x());
    out.gyration = p.ship.gyration.hasNaN() ? usual : p.ship.gyration;
    out.inertia = out.mass * out.gyration.cwiseAbs2();
    for (int k = 0; k < 3; ++k) {
        const auto translation = static_cast<std::size_t>(k), rotation = translation + 3;
        out.added[translation] = p.ship.added_mass[translation] * out.mass;
        out.added[rotation] = p.ship.added_mass[rotation] * out.inertia[k];
    }
    // later sources replace earlier ones: shares of the mass, computed from the hull, a given
    // matrix
    if (p.ship.computes_added_mass) {
        take_diagonal(ship_added_mass(hull.mesh, -scene.bodies.position[kShip].z(),
                                      out.centre_of_gravity, p.water_density)
                          .matrix,
                      out.added);
    }
    if (!p.ship.matrix.empty()) take_matrix(read_ship_matrix(p.ship.matrix), out);
    return out;
}

Quaternion orientation_of(const ShipAngles& a) {
    if (a.isZero(0.0)) return Quaternion::Identity();
    const Quaternion pitched = ordered_product(exponential_map(Vec3(0.0, a[1], 0.0)),
                                               exponential_map(Vec3(a[0], 0.0, 0.0)));
    return ordered_normalized(ordered_product(exponential_map(Vec3(0.0, 0.0, a[2])), pitched));
}

ShipAxes axes_of(const ShipAngles& a) {
    // Translations are along the heading, level, and up; roll about the ship's own axis, pitch
    // about its level one, yaw about the vertical: the axes of R = R_z R_y R_x.
    ShipAxes out;
    if (a.isZero(0.0)) return out;
    out.translation = exponential_map(Vec3(0.0, 0.0, a[2])).toRotationMatrix();
    out.rotation.col(0) = orientation_of(a).toRotationMatrix().col(0);
    out.rotation.col(1) = out.translation.col(1);
    return out;
}

ShipMasses masses_of(const ShipBody& body, const ShipAngles& a) {
    const ShipAxes axes = axes_of(a);
    const Mat3 r = orientation_of(a).toRotationMatrix();
    const Vec3 added(body.added[surge], body.added[sway], body.added[heave]);
    const Vec3 added_rotation(body.added[roll], body.added[pitch], body.added[yaw]);
    // mass and inertia are the ship's, given in its own axes, turned into those of the motions
    const Mat3 to_ship = r.transpose() * axes.translation, rotation = r.transpose() * axes.rotation;
    ShipMasses out;
    out.translation =
        body.mass * Mat3::Identity() + to_ship.transpose() * added.asDiagonal() * to_ship;
    out.rotation =
        rotation.transpose() * Vec3(body.inertia + added_rotation).asDiagonal() * rotation;
    return out;
}

Mat3 inverse_on_free(const Mat3& matrix, const ShipBody& body, Freedom first) {
    // Locked motions take no part: their rows and columns leave the matrix before it is
    // inverted.
    Mat3 kept = Mat3::Identity();
    const auto is_free = [&](int k) { return body.free[static_cast<std::size_t>(first + k)]; };
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j)
            if (is_free(k) && is_free(j)) kept(k, j) = matrix(k, j);
    // in units of its own size: the inverse is by cofactors
    const double size = kept.cwiseAbs().maxCoeff();
    for (int k = 0; k < 3; ++k)
        if (!is_free(k)) kept(k, k) = size;
    Mat3 inverse = Mat3(kept / size).inverse() / size;
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j)
            if (!is_free(k) || !is_free(j)) inverse(k, j) = 0.0;
    return inverse;
}

ShipResponse response_of(const ShipBody& body, const ShipAngles& angles) {
    const ShipAxes axes = axes_of(angles);
    const ShipMasses masses = masses_of(body, angles);
    ShipResponse out;
    out.free = body.any_free();
    out.inverse_mass = axes.translation * inverse_on_free(masses.translation, body, surge) *
                       axes.translation.transpose();
    out.inverse_inertia =
        axes.rotation * inverse_on_free(masses.rotation, body, roll) * axes.rotation.transpose();
    out.least_response = 1.0 / body.mass;
    out.centre = orientation_of(angles).toRotationMatrix() * body.centre_of_gravity;
    return out;
}

}  // namespace ice
