// SPDX-License-Identifier: GPL-3.0-or-later
/// One 2D case in several engines that differ in contact only.
#pragma once

#include <memory>

#include "solver/step/step.hpp"
#include "tests/peers/section.hpp"

namespace ice::peers {

/// A world that some contact solver advances.
class Engine {
public:
    virtual ~Engine() = default;
    /// Advances by the case's time step. @return impulse of the ice on the ship [N s per metre]
    virtual Vec3 step() = 0;
    virtual const World& world() const = 0;
    /// Largest difference so far, per step and as a force [N/m], between the change of momentum of
    /// the free floes and the impulses of water, ship and held floes.
    virtual double imbalance() const = 0;
};

/// The world in our own solver.
std::unique_ptr<Engine> make_own_engine(World world);

/// The world in Box2D: floes are boxes, the hull is a chain.
/// @param skin  radius [m] that rounds the convex corners of floes and hull; the faces stay where
///              they are. Box2D's own is kBox2dSkin.
std::unique_ptr<Engine> make_box2d_engine(World world, double skin);
extern const double kBox2dSkin;

/// The world in Bullet: floes are boxes of 1 m breadth, the hull is its convex parts.
std::unique_ptr<Engine> make_bullet_engine(World world);

}  // namespace ice::peers
