// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "tests/peers/engine.hpp"

namespace ice::peers {

/// How a body lies and moves in an engine's plane: (x, z) of the world become its (x, y), hence its
/// angle is the negative of ours about y.
struct PlaneState {
    Vec2 position, velocity;  ///< of the centre of mass [m], [m/s]
    double angle, turn;       ///< [rad], [rad/s], counter-clockwise
};

/// What the engines that are not ours share: the world's poses and loads are kept by our own code
/// (place, release, water), only contact and motion are the engine's.
class ForeignEngine : public Engine {
public:
    /// @throws Error (exit code 2) for a case that is not 2D, turns the ship or holds floes by
    ///         another rule than never, until-hull-contact or always; floes must be rectangles.
    explicit ForeignEngine(World world);

    Vec3 step() final;
    const World& world() const final { return world_; }
    double imbalance() const final { return imbalance_; }

protected:
    /// Sums over one step [N s per metre], in the engine's plane.
    struct Impulses {
        Vec2 on_ship = Vec2::Zero();
        Vec2 on_held = Vec2::Zero();  ///< of the free floes on the held ones
    };

    virtual void release_floe(std::size_t floe) = 0;
    virtual void push(std::size_t floe, const Vec2& force, double moment) = 0;
    /// Advances by dt; the ship starts at its place in world() and goes with its velocity.
    virtual Impulses solve(double dt) = 0;
    virtual PlaneState state(std::size_t floe) const = 0;

    PlaneState start_of(std::size_t body) const;
    double friction(std::size_t a, std::size_t b) const;

    World world_;
    Polygon hull_;                   ///< outline in the ship frame
    std::vector<Vec2> half_sizes_;   ///< per body; the ship's unused
    std::vector<Polygon> outlines_;  ///< per shape

private:
    void release_near_ship();
    void take_over(std::size_t floe);

    double imbalance_ = 0.0;
};

}  // namespace ice::peers
