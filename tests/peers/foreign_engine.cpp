// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/peers/foreign_engine.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"

namespace ice::peers {

namespace {

// Half length and height of a rectangle about the origin with its sides along the axes.
Vec2 half_size(const Polygon& outline) {
    Eigen::AlignedBox2d box;
    for (const Vec2& p : outline) box.extend(p);
    const Vec2 half = 0.5 * box.sizes();
    const bool rectangle = outline.size() == 4 && box.center().norm() < 1e-6 &&
                           std::all_of(outline.begin(), outline.end(), [&](const Vec2& p) {
                               return (p.cwiseAbs() - half).norm() < 1e-6;
                           });
    if (!rectangle) throw bad_input("floes", "are not rectangles", "the peers take boxes only");
    return half;
}

}  // namespace

ForeignEngine::ForeignEngine(World world) : world_(std::move(world)) {
    const Case& p = world_.parameters;
    if (p.dimension != 2 || world_.scene.dimension != 2)
        throw bad_input("simulation.dimension", "is not 2", "the peers take 2D cases only");
    for (const FloeGroup& group : p.floes)
        if (group.hold == Hold::until_contact)
            throw bad_input("floes.hold", "is until-contact", "the peers know no such rule");
    for (const Shape& shape : world_.scene.shapes) outlines_.push_back(outline_of(shape.mesh));
    hull_ = outlines_[0];
    const Bodies& b = world_.scene.bodies;
    half_sizes_.resize(b.size(), Vec2::Zero());
    for (std::size_t i = 1; i < b.size(); ++i)
        half_sizes_[i] = half_size(outlines_[static_cast<std::size_t>(b.shape[i])]);
}

double ForeignEngine::friction(std::size_t a, std::size_t b) const {
    const bool ship = a == kShip || b == kShip;
    return ship ? world_.parameters.contact.friction_ship_ice
                : world_.parameters.contact.friction_ice_ice;
}

PlaneState ForeignEngine::start_of(std::size_t i) const {
    const Bodies& b = world_.scene.bodies;
    const Mat3& r = b.rotation[i];
    const Vec3 &x = b.position[i], &v = b.velocity[i];
    // turned about y by a, the body's x axis points to (cos a, 0, -sin a)
    return {Vec2(x.x(), x.z()), Vec2(v.x(), v.z()), std::atan2(r(2, 0), r(0, 0)),
            -b.angular_velocity[i].y()};
}

// Neither engine lets prescribed and immovable bodies meet, so the rule of the case is applied
// here: a floe goes free when the ship reaches it within the step.
void ForeignEngine::release_near_ship() {
    Bodies& b = world_.scene.bodies;
    const double reach = b.velocity[kShip].norm() * world_.parameters.time_step;
    const Polygon hull = place(hull_, b.rotation[kShip], b.position[kShip]);
    for (std::size_t i = 1; i < b.size(); ++i) {
        const auto group = static_cast<std::size_t>(b.group[i]);
        if (!b.held[i] || world_.parameters.floes[group].hold == Hold::always) continue;
        const Polygon& outline = outlines_[static_cast<std::size_t>(b.shape[i])];
        if (distance(hull, place(outline, b.rotation[i], b.position[i])) > reach) continue;
        release(b, i);
        release_floe(i);
    }
}

void ForeignEngine::take_over(std::size_t i) {
    Bodies& b = world_.scene.bodies;
    const PlaneState s = state(i);
    b.position[i] = Vec3(s.position.x(), 0.0, s.position.y());
    b.orientation[i] = Quaternion(Eigen::AngleAxisd(-s.angle, Vec3::UnitY()));
    b.momentum[i] = b.mass[i] * Vec3(s.velocity.x(), 0.0, s.velocity.y());
    b.angular_momentum[i] = Vec3(0.0, -b.inertia(i)(1, 1) * s.turn, 0.0);
    update_derived(b, i);
}

Vec3 ForeignEngine::step() {
    World& w = world_;
    Bodies& b = w.scene.bodies;
    const double dt = w.parameters.time_step;
    w.scene.ship_velocity = Vec3(w.parameters.ship_speed(w.time + 0.5 * dt), 0.0, 0.0);
    b.velocity[kShip] = w.scene.ship_velocity;
    release_near_ship();

    measure_loads(w.scene, w.parameters, w.loads);
    Vec2 unexplained = Vec2::Zero();  // load and contact impulses less the change of momentum
    for (std::size_t k = 0; k < b.moving.size(); ++k) {
        const auto i = static_cast<std::size_t>(b.moving[k]);
        const Vec2 force(w.loads[k].force.x(), w.loads[k].force.z());
        push(i, force, -w.loads[k].moment.y());
        unexplained += dt * force + Vec2(b.momentum[i].x(), b.momentum[i].z());
    }
    const Impulses impulses = solve(dt);
    for (std::size_t i = 1; i < b.size(); ++i) {
        if (b.held[i]) continue;
        take_over(i);
        unexplained -= Vec2(b.momentum[i].x(), b.momentum[i].z());
    }
    unexplained -= impulses.on_ship + impulses.on_held;
    imbalance_ = std::max(imbalance_, unexplained.norm() / dt);

    b.position[kShip] += dt * b.velocity[kShip];
    ++w.steps;
    w.time = static_cast<double>(w.steps) * dt;
    return {impulses.on_ship.x(), 0.0, impulses.on_ship.y()};
}

}  // namespace ice::peers
