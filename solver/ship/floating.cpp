// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/ship/floating.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "solver/water/hydrostatics.hpp"

namespace ice {

namespace {

// Newton's steps at most [-]: a ship that needs more is refused as one without equilibrium.
constexpr int kMostSteps = 100;
// Force and moment that are left, as shares of the weight and of weight times length [-]. Smaller
// is below the rounding of the sums over the mesh; larger lets the ship begin with a small bob.
constexpr double kBalanced = 1e-11;
// Half the span of a central difference [rad] (for heave: of the hull's depth): its error is of the
// order of 1e-8. Smaller loses digits to rounding, larger sees the curvature of the hull.
constexpr double kStepAngle = 1e-4;
// Bounds of one of Newton's steps: [rad], and a share of the hull's depth [-]. Larger ones may turn
// the ship over or lift it out of the water; smaller ones only take more steps.
constexpr double kMostTilt = 0.1;
constexpr double kMostSink = 0.1;

// heave, roll, pitch: the motions in which water restores
using Attitude = Vec3;

class Balance {
public:
    Balance(const Case& p, const Scene& scene, const ShipBody& body)
        : case_(p), hull_(scene.shapes[0]), body_(body), size_(hull_.box.sizes()) {}

    // generalised force of the three motions at the centre of gravity
    Vec3 force(const Attitude& a) const {
        // about the axes of the angles, in which the stiffness is that of roll and pitch
        const ShipAngles angles(a[1], a[2], 0.0);
        const ShipAxes axes = axes_of(angles);
        const FloatingForce f = floating(a);
        return {f.lift, axes.rotation.col(0).dot(f.moment), axes.rotation.col(1).dot(f.moment)};
    }
    FloatingForce floating(const Attitude& a) const {
        const Mat3 r = orientation_of(ShipAngles(a[1], a[2], 0.0)).toRotationMatrix();
        const double height = a[0] - (r * body_.centre_of_gravity).z();
        return floating_force(hull_, body_, r, height, case_.water_density, case_.gravity);
    }
    // - d force_k / d attitude_j by central differences
    Mat3 stiffness(const Attitude& a) const {
        Mat3 out;
        const Vec3 by(kStepAngle * size_.z(), kStepAngle, kStepAngle);
        for (int j = 0; j < 3; ++j) {
            const Vec3 step = by[j] * Vec3::Unit(j);
            out.col(j) = (force(a - step) - force(a + step)) / (2.0 * by[j]);
        }
        return out;
    }
    // the scale of each motion's force
    Vec3 scale() const {
        // moments count against weight times length, so that one tolerance serves all three
        const double weight = body_.mass * case_.gravity;
        return {weight, weight * size_.y() + (size_.y() == 0.0 ? 1.0 : 0.0), weight * size_.x()};
    }
    // Far from equilibrium the stiffness changes with the attitude: a whole step of Newton's could
    // turn the hull over, or lift it out of the water, where nothing restores.
    Vec3 limited(Vec3 step) const {
        step[0] = std::clamp(step[0], -kMostSink * size_.z(), kMostSink * size_.z());
        for (int k = 1; k < 3; ++k) step[k] = std::clamp(step[k], -kMostTilt, kMostTilt);
        return step;
    }

private:
    const Case& case_;
    const Shape& hull_;
    const ShipBody& body_;
    Vec3 size_;
};

bool is_free(const ShipBody& body, int k) { return body.free[static_cast<std::size_t>(heave + k)]; }

// The stiffness without the motions that are locked.
Mat3 on_free(Mat3 stiffness, const ShipBody& body) {
    for (int k = 0; k < 3; ++k) {
        if (is_free(body, k)) continue;
        stiffness.row(k).setZero();
        stiffness.col(k).setZero();
        stiffness(k, k) = 1.0;
    }
    return stiffness;
}

[[noreturn]] void refuse(const Case& p, const std::string& what, const std::string& remedy) {
    throw bad_input(p.file.string() + ": [ship]", what, remedy);
}

void require_stable(const Case& p, const ShipBody& body, const Equilibrium& e) {
    const auto unstable = [&](const char* motion, const char* gm, double value) {
        refuse(p,
               fmt::format("the ship does not float upright: its stiffness in {} is {:.3g}, {} = "
                           "{:.4g} m",
                           motion, value * body.mass * p.gravity, gm, value),
               "lower the z of ship.centre_of_gravity, or leave that motion out of ship.free");
    };
    if (body.free[roll] && !(e.gm_transverse > 0.0)) unstable("roll", "GM", e.gm_transverse);
    if (body.free[pitch] && !(e.gm_longitudinal > 0.0))
        unstable("pitch", "the longitudinal GM", e.gm_longitudinal);
}

}  // namespace

FloatingForce floating_force(const Shape& hull, const ShipBody& body, const Mat3& rotation,
                             double height, double water_density, double gravity) {
    const Submerged wet = measure_submerged(hull, rotation, height);
    const double buoyancy = water_density * gravity * wet.volume;
    const Vec3 arm = wet.centre - rotation * body.centre_of_gravity;
    return {buoyancy - body.mass * gravity, arm.cross(Vec3(0.0, 0.0, buoyancy)), wet.volume};
}

double floating_energy(const Shape& hull, const ShipBody& body, const Mat3& rotation, double height,
                       double water_density, double gravity) {
    const Submerged wet = measure_submerged(hull, rotation, height);
    return body.mass * gravity * (height + (rotation * body.centre_of_gravity).z()) -
           water_density * gravity * wet.volume * (height + wet.centre.z());
}

Equilibrium find_equilibrium(const Case& p, const Scene& scene, const ShipBody& body) {
    const Balance balance(p, scene, body);
    const double place = scene.bodies.position[kShip].z();
    Attitude at(place + body.centre_of_gravity.z(), 0.0, 0.0);
    bool found = !body.floats() || p.gravity == 0.0;
    for (int k = 0; k < kMostSteps && !found; ++k) {
        Vec3 force = balance.force(at);
        for (int j = 0; j < 3; ++j)
            if (!is_free(body, j)) force[j] = 0.0;
        found = (force.cwiseQuotient(balance.scale())).cwiseAbs().maxCoeff() <= kBalanced;
        if (found) break;
        const Mat3 stiffness = on_free(balance.stiffness(at), body);
        // Newton's method on the free motions: force + (d force / d attitude) step = 0, the
        // stiffness being minus that derivative.
        const Vec3 step = stiffness.fullPivLu().solve(force);
        if (!step.allFinite() || !(stiffness(0, 0) > 0.0)) break;  // above, or wholly under water
        at += balance.limited(step);
    }
    if (!found)
        refuse(p, fmt::format("a ship of {:.6g} kg finds no equilibrium on the water", body.mass),
               "leave ship.mass out for what the hull displaces, or look at its "
               "centre_of_gravity");
    Equilibrium out;
    out.angles = ShipAngles(at[1], at[2], 0.0);
    const Mat3 r = orientation_of(out.angles).toRotationMatrix();
    // a ship that was not turned or moved keeps its bits
    out.height = at[0] == place + body.centre_of_gravity.z() && out.angles.isZero(0.0)
                     ? place
                     : at[0] - (r * body.centre_of_gravity).z();
    out.volume = balance.floating(at).volume;
    const Mat3 stiffness = balance.stiffness(at);
    for (int k = 0; k < 3; ++k)
        out.stiffness[static_cast<std::size_t>(heave + k)] = stiffness(k, k);
    const double weight = body.mass * p.gravity;
    // C44 / (m g) = GM, C55 / (m g) likewise.
    out.gm_transverse = out.stiffness[roll] / weight;
    out.gm_longitudinal = out.stiffness[pitch] / weight;
    if (p.gravity > 0.0) require_stable(p, body, out);
    return out;
}

}  // namespace ice
