// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/ship/ship_loads.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/base/error.hpp"

namespace ice {

namespace {

// Most phase of a spring's swing in a step, w dt [rad]: beyond it symplectic Euler is off by more
// than a per cent in the period, (w dt)^2 / 24, and at w dt = 2 it diverges. Smaller refuses time
// steps that are good enough.
constexpr double kMostSwing = 0.5;

// Gravity in the time constant of the controls [m/s2], also where a case has none. Controls settle
// sooner with more; means do not depend on it.
constexpr double kUsualGravity = 9.81;

Vec3 level(const Vec3& v) { return {v.x(), v.y(), 0.0}; }

// The stiffness of each motion by itself: it gives the critical damping, and the period that the
// time step must resolve.
SixNumbers restoring(const Case& p, const ShipRig& rig) {
    SixNumbers out = p.mooring.stiffness;
    for (const Freedom k : {heave, roll, pitch}) out[k] += rig.equilibrium.stiffness[k];
    for (const Freedom k : {surge, sway}) out[k] += p.tow.stiffness;
    return out;
}

void require_short_steps(const Case& p, const char* what, double swing) {
    if (!(swing > kMostSwing)) return;
    throw bad_input(
        p.file.string() + ": simulation.time_step",
        fmt::format(
            "{:g} s are too long for the ship in {}: its phase advances {:.2g} rad in a step",
            p.time_step, what, swing),
        fmt::format("use {:.2g} s or less", p.time_step * kMostSwing / swing));
}

// Coefficients of damping, with the masses that swing.
void set_damping(const Case& p, ShipRig& rig) {
    constexpr const char* kNames[] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
    const ShipMasses masses = masses_of(rig.body, rig.equilibrium.angles);
    const SixNumbers stiffness = restoring(p, rig);
    for (int k = 0; k < kFreedoms; ++k) {
        // c = 2 zeta sqrt(C (M + A)) where something restores; else the given coefficient
        // itself
        const auto i = static_cast<std::size_t>(k);
        if (!rig.body.free[i]) continue;
        const double mass = k < 3 ? masses.translation(k, k) : masses.rotation(k - 3, k - 3);
        const bool springs = stiffness[i] > 0.0;
        rig.damping[i] =
            p.ship.damping[i] * (springs ? 2.0 * std::sqrt(stiffness[i] * mass) : 1.0) +
            rig.body.water_damping[i];
        if (springs)
            require_short_steps(p, kNames[k], p.time_step * std::sqrt(stiffness[i] / mass));
        // The tow's damper takes the velocity of the step's start: an explicit damper diverges from
        // c dt / m = 2 on.
        if (k == surge)
            require_short_steps(p, "surge, with tow.damping", p.time_step * p.tow.damping / mass);
    }
}

// Along the heading, at the centre of gravity: a thrust does not trim the ship.
void add_propulsion(const Case& p, const ShipRig& rig, const ShipState& s, const ShipAxes& axes,
                    const Vec3& current, double speed_error, ShipLoads& out) {
    const Vec3 ahead = axes.translation.col(0);
    const double through_water = ahead.dot(s.velocity - current);
    const double tau = rig.control_time;
    if (std::isnan(p.propulsion.hold_speed)) {
        out.thrust = thrust_at(p.propulsion, through_water);
    } else {
        // a regulator with the time tau: proportional and integral, critically damped
        const double error = p.propulsion.hold_speed - ahead.dot(s.velocity);
        out.thrust =
            (rig.body.mass + rig.body.added[surge]) * (error + speed_error / (4.0 * tau)) / tau;
    }
    out.propulsion.force = out.thrust * ahead;
    out.losses.force = -open_water_resistance(p.propulsion, through_water) * ahead;
    if (!p.propulsion.hold_heading) return;
    // The heading is held likewise: omega^2 off + 2 omega r is critically damped.
    const double omega = 1.0 / (4.0 * tau), inertia = rig.body.inertia[2] + rig.body.added[yaw];
    const double off = s.angles[2] - rig.anchor_angles[2];
    out.propulsion.moment.z() = -inertia * omega * (omega * off + 2.0 * s.angular_velocity.z());
}

// A spring and a damper from the towing point to the carriage, which has the prescribed course.
void add_tow(const Case& p, const ShipRig& rig, const ShipState& s, const Mat3& rotation,
             ShipLoads& out) {
    if (p.tow.stiffness == 0.0 && p.tow.damping == 0.0) return;
    const Vec3 arm = rotation * (p.tow.point - rig.body.centre_of_gravity);
    const Vec3 point = s.position + rotation * p.tow.point;
    const Vec3 carriage = rig.towed_from + Vec3(p.ship_travel(0.0, s.time), 0.0, 0.0);
    const Vec3 velocity = s.velocity + s.angular_velocity.cross(arm);
    const Vec3 carriage_velocity(p.ship_speed(s.time), 0.0, 0.0);
    out.tow.force = level(p.tow.stiffness * (carriage - point) +
                          p.tow.damping * (carriage_velocity - velocity));
    out.tow.moment = arm.cross(out.tow.force);
}

void add_mooring(const Case& p, const ShipRig& rig, const ShipState& s, const Mat3& rotation,
                 const ShipAxes& axes, ShipLoads& out) {
    const Vec3 off = s.position + rotation * rig.body.centre_of_gravity - rig.anchor;
    const ShipAngles turned = s.angles - rig.anchor_angles;
    Vec3 along;  // the motions' generalised moments
    for (int k = 0; k < 3; ++k) {
        const auto linear = static_cast<std::size_t>(k), angular = linear + 3;
        out.mooring.force[k] = p.mooring.pretension[linear] - p.mooring.stiffness[linear] * off[k];
        along[k] = p.mooring.pretension[angular] - p.mooring.stiffness[angular] * turned[k];
    }
    // The angles are no components of one rotation. M is the moment whose parts along the three
    // axes of the angles are the generalised moments, axes.rotation^T M = along.
    if (!along.isZero(0.0)) out.mooring.moment = axes.rotation.transpose().inverse() * along;
}

}  // namespace

ShipForce ShipLoads::total() const {
    ShipForce sum = water;
    for (const ShipForce* part : {&propulsion, &tow, &mooring, &losses, &gyroscopic}) sum += *part;
    return sum;
}

ShipRig make_ship_rig(const Case& p, const Scene& scene) {
    ShipRig rig;
    rig.body = make_ship_body(p, scene);
    if (!(rig.body.mass > 0.0))
        throw bad_input(p.file.string() + ": ship.mass",
                        "is missing, and the hull displaces no water to take it from",
                        "give ship.mass, or a draught");
    rig.equilibrium = find_equilibrium(p, scene, rig.body);
    rig.anchor_angles = rig.equilibrium.angles;
    const Mat3 rotation = orientation_of(rig.anchor_angles).toRotationMatrix();
    Vec3 place = scene.bodies.position[kShip];
    place.z() = rig.equilibrium.height;
    rig.anchor = place + rotation * rig.body.centre_of_gravity;
    rig.towed_from = place + rotation * p.tow.point;
    rig.control_time = std::sqrt(scene.shapes[0].box.sizes().x() / kUsualGravity);
    set_damping(p, rig);
    return rig;
}

ShipLoads measure_ship_loads(const Case& p, const Shape& hull, const ShipRig& rig,
                             const ShipState& s, const Vec3& current, double speed_error) {
    ShipLoads out;
    const ShipAxes axes = axes_of(s.angles);
    const Mat3 rotation = orientation_of(s.angles).toRotationMatrix();
    // a ship that neither heaves, rolls nor pitches keeps its height: the water's force has no
    // effect
    if (rig.body.floats()) {
        const FloatingForce f =
            floating_force(hull, rig.body, rotation, s.position.z(), p.water_density, p.gravity);
        out.water = {Vec3(0.0, 0.0, f.lift), f.moment};
    }
    add_propulsion(p, rig, s, axes, current, speed_error, out);
    add_tow(p, rig, s, rotation, out);
    add_mooring(p, rig, s, rotation, axes, out);
    // -w x (I + A') w of (S1)
    if (rig.body.turns()) {
        const Vec3 added(rig.body.added[roll], rig.body.added[pitch], rig.body.added[yaw]);
        const Vec3 spin = rotation.transpose() * s.angular_velocity;
        const Vec3 momentum = rotation * (rig.body.inertia + added).cwiseProduct(spin);
        out.gyroscopic.moment = -s.angular_velocity.cross(momentum);
    }
    return out;
}

}  // namespace ice
