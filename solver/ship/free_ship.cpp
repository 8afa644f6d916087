// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/ship/free_ship.hpp"

#include <cmath>

#include "common/base/assert.hpp"
#include "common/formats/checkpoint_file.hpp"

namespace ice {

namespace {

// The part of a motion, given along its three axes, that is free.
Vec3 free_part(const ShipBody& body, Freedom first, Vec3 motion) {
    for (int k = 0; k < 3; ++k)
        if (!body.free[static_cast<std::size_t>(first + k)]) motion[k] = 0.0;
    return motion;
}

// Surge, sway, heave or roll, pitch, yaw of six numbers.
Vec3 of_three(const SixNumbers& six, Freedom first) {
    const auto k = static_cast<std::size_t>(first);
    return {six[k], six[k + 1], six[k + 2]};
}

double quadratic(const Vec3& v, const Mat3& m) { return v.dot(m * v); }

}  // namespace

void FreeShip::begin(const Case& p, Scene& scene) {
    if (begun_) return;
    begun_ = true;
    if (!p.ship.any_free()) return;
    rig_ = make_ship_rig(p, scene);
    // the prescribed speed at t = 0, and the floating pose, is the start of the free motions
    velocity_ = Vec3(p.ship_speed(0.0), 0.0, 0.0);
    angles_ = rig_->equilibrium.angles;
    Bodies& b = scene.bodies;
    b.position[kShip].z() = rig_->equilibrium.height;
    b.orientation[kShip] = orientation_of(angles_);
    b.rotation[kShip] = b.orientation[kShip].toRotationMatrix();
}

void FreeShip::place(Scene& scene, double height, const ShipAngles& angles) {
    ICE_ASSERT(is_free());
    Bodies& b = scene.bodies;
    // the ship turns about its centre of gravity, which keeps its place in the plane
    const Vec3 before = b.rotation[kShip] * rig_->body.centre_of_gravity;
    angles_ = angles;
    b.orientation[kShip] = orientation_of(angles_);
    b.rotation[kShip] = b.orientation[kShip].toRotationMatrix();
    b.position[kShip] += before - b.rotation[kShip] * rig_->body.centre_of_gravity;
    b.position[kShip].z() = height;
}

void FreeShip::start_step(const Case& p, Scene& scene, double time) {
    begin(p, scene);
    Bodies& b = scene.bodies;
    // Speed in the middle of the step: the displacement of a linear speed table is then exact.
    const Vec3 course(p.ship_speed(time + 0.5 * p.time_step), 0.0, 0.0);
    if (is_free()) {
        // The free motions go on with the velocity of the last step; the others follow the
        // course.
        const ShipAxes axes = axes_of(angles_);
        const Vec3 along = axes.translation.transpose() * velocity_;
        Vec3 velocity = free_part(rig_->body, surge, along);
        if (!rig_->body.free[surge]) velocity += course;
        const Vec3 rates = free_part(rig_->body, roll, axes.rotation.inverse() * spin_);
        b.velocity[kShip] = axes.translation * velocity;
        b.angular_velocity[kShip] = axes.rotation * rates;
        // response to impulses with the matrices at the step's start, (S1)
        b.ship = response_of(rig_->body, angles_);
        if (!energies_.kinetic_start) {
            energies_.kinetic_start = kinetic_energy(b);
            energies_.potential_start = potential_energy(scene, p);
        }
        velocity_start_ = b.velocity[kShip];
        spin_start_ = b.angular_velocity[kShip];
    } else {
        b.velocity[kShip] = course;
    }
    scene.ship_velocity = b.velocity[kShip];
}

ShipState FreeShip::state_of(const Bodies& b, double time) const {
    return {b.position[kShip], angles_, b.velocity[kShip], b.angular_velocity[kShip], time};
}

void FreeShip::apply_loads(const Case& p, Scene& scene, double time) {
    if (!is_free()) return;
    Bodies& b = scene.bodies;
    loads_ = measure_ship_loads(p, scene.shapes[0], *rig_, state_of(b, time), scene.water.current,
                                speed_error_);
    add_damping(p, scene);
    // In world axes, by the same inverses as for impulses: locked motions have zeros in them, so
    // that a force along them changes nothing.
    const ShipForce total = loads_.total();
    // (S1) without impulses: the contacts have theirs in the stages that follow
    b.velocity[kShip] += b.ship.inverse_mass * (p.time_step * total.force);
    b.angular_velocity[kShip] += b.ship.inverse_inertia * (p.time_step * total.moment);
    // the integral of the error for `hold_speed`
    if (!std::isnan(p.propulsion.hold_speed))
        speed_error_ += p.time_step * (p.propulsion.hold_speed -
                                       axes_of(angles_).translation.col(0).dot(b.velocity[kShip]));
}

// (M + dt D / 2) dv = dt (F - D v): damping by the mean of the velocities before and after the
// loads. It does not overshoot, and its error is of second order.
void FreeShip::add_damping(const Case& p, Scene& scene) {
    const Bodies& b = scene.bodies;
    const Vec3 translation = of_three(rig_->damping, surge),
               rotation = of_three(rig_->damping, roll);
    if (translation.isZero(0.0) && rotation.isZero(0.0)) return;
    const double dt = p.time_step;
    const ShipAxes axes = axes_of(angles_);
    const ShipMasses masses = masses_of(rig_->body, angles_);
    const ShipForce others = loads_.total();
    const auto damped = [&](Freedom first, const Mat3& mass, const Vec3& by, const Vec3& rate,
                            const Vec3& force) -> Vec3 {
        const Mat3 heavier = mass + Mat3((0.5 * dt * by).asDiagonal());
        const Vec3 change =
            inverse_on_free(heavier, rig_->body, first) * (dt * (force - by.cwiseProduct(rate)));
        return -by.cwiseProduct(free_part(rig_->body, first, rate) + 0.5 * change);
    };
    // through the water: damping of a ship that drifts with the current is zero
    const Vec3 through_water =
        axes.translation.transpose() * (b.velocity[kShip] - scene.water.current);
    const Vec3 rates = axes.rotation.inverse() * b.angular_velocity[kShip];
    const Vec3 force = damped(surge, masses.translation, translation, through_water,
                              axes.translation.transpose() * others.force);
    const Vec3 moment =
        damped(roll, masses.rotation, rotation, rates, axes.rotation.transpose() * others.moment);
    // back to world axes: the angles' own are not at right angles where the ship trims
    loads_.losses.force += axes.translation * force;
    loads_.losses.moment += axes.rotation.transpose().inverse() * moment;
}

void FreeShip::enter_step(const Scene& scene, const std::vector<Constraint>& constraints,
                          const PositionCorrections& corrections, double dt) {
    if (!is_free()) return;
    const Bodies& b = scene.bodies;
    const ShipAxes axes = axes_of(angles_);
    // (S3): each force times the mean of the step's first and last velocity, free motions only
    const Vec3 mean = 0.5 * (velocity_start_ + b.velocity[kShip]);
    const Vec3 mean_spin = 0.5 * (spin_start_ + b.angular_velocity[kShip]);
    const Vec3 v =
        axes.translation * free_part(rig_->body, surge, axes.translation.transpose() * mean);
    const Vec3 w = axes.rotation * free_part(rig_->body, roll, axes.rotation.inverse() * mean_spin);
    const auto work = [&](const ShipForce& f) { return dt * (f.force.dot(v) + f.moment.dot(w)); };
    energies_.thrust += work(loads_.propulsion);
    energies_.tow += work(loads_.tow);
    energies_.mooring += work(loads_.mooring);
    energies_.losses -= work(loads_.losses);
    // position corrections move the ship against the water's forces: work without a velocity
    energies_.separation -= loads_.water.force.dot(corrections.shift[kShip]) +
                            loads_.water.moment.dot(corrections.turn[kShip]);
    for (const Constraint& c : constraints) {
        // an impulse J on the floe is -J on the ship, at arm_a from G
        if (c.a != static_cast<std::int32_t>(kShip) || c.total_normal() <= 0.0) continue;
        const Vec3 j = c.total_normal() * c.normal + c.total_tangent();
        energies_.ice += j.dot(v + w.cross(c.arm_a));
    }
}

void FreeShip::turn(Scene& scene, const PositionCorrections& corrections, double dt) {
    if (!is_free()) return;
    Bodies& b = scene.bodies;
    const ShipAxes axes = axes_of(angles_);
    const ShipMasses masses = masses_of(rig_->body, angles_);
    velocity_ = b.velocity[kShip];
    spin_ = b.angular_velocity[kShip];
    const Vec3 rates = axes.rotation.inverse() * spin_;
    // momenta in world axes, for the checks and the hash; the state is velocity and angles
    b.momentum[kShip] =
        axes.translation * (masses.translation * (axes.translation.transpose() * velocity_));
    b.angular_momentum[kShip] = axes.rotation.transpose().inverse() * (masses.rotation * rates);
    const Vec3 shift = axes.translation.transpose() * corrections.shift[kShip];
    b.position[kShip] += axes.translation * free_part(rig_->body, surge, shift);
    if (!rig_->body.turns()) return;
    // `centre` stays that of the step, as its contacts have it
    const Vec3 turn = dt * rates + axes.rotation.inverse() * corrections.turn[kShip];
    const ShipAngles turned = angles_ + free_part(rig_->body, roll, turn);
    const Vec3 after = orientation_of(turned).toRotationMatrix() * rig_->body.centre_of_gravity;
    place(scene, b.position[kShip].z() + (b.ship.centre - after).z(), turned);
}

double FreeShip::kinetic_energy(const Bodies& b) const {
    if (!is_free()) return 0.0;
    const ShipAxes axes = axes_of(angles_);
    const ShipMasses masses = masses_of(rig_->body, angles_);
    const Vec3 v = free_part(rig_->body, surge, axes.translation.transpose() * b.velocity[kShip]);
    const Vec3 w = free_part(rig_->body, roll, axes.rotation.inverse() * b.angular_velocity[kShip]);
    return 0.5 * (quadratic(v, masses.translation) + quadratic(w, masses.rotation));
}

double FreeShip::potential_energy(const Scene& scene, const Case& p) const {
    if (!is_free() || !rig_->body.floats()) return 0.0;
    const Bodies& b = scene.bodies;
    return floating_energy(scene.shapes[0], rig_->body, b.rotation[kShip], b.position[kShip].z(),
                           p.water_density, p.gravity);
}

void FreeShip::carry(CheckpointFile& file) {
    file.carry("ship.angles", angles_);
    file.carry("ship.velocity", velocity_);
    file.carry("ship.spin", spin_);
    file.carry("ship.speed_error", speed_error_);
    file.carry("ship.thrust_work", energies_.thrust);
    file.carry("ship.tow_work", energies_.tow);
    file.carry("ship.mooring_work", energies_.mooring);
    file.carry("ship.ice_work", energies_.ice);
    file.carry("ship.losses", energies_.losses);
    file.carry("ship.separation", energies_.separation);
    file.carry("ship.kinetic_start", energies_.kinetic_start);
    file.carry("ship.potential_start", energies_.potential_start);
}

}  // namespace ice
