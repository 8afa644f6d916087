// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "tests/peers/engine.hpp"

namespace ice::peers {

namespace {

class OwnEngine : public Engine {
public:
    explicit OwnEngine(World world) : world_(std::move(world)) {}

    Vec3 step() override {
        const Bodies& b = world_.scene.bodies;
        const double dt = world_.parameters.time_step;
        Vec3 unexplained = momentum_of_free();  // held floes have none
        ice::step(world_);
        for (const FloeLoad& load : world_.loads) unexplained += dt * load.force;
        Vec3 on_ship = Vec3::Zero();
        for (const Constraint& c : world_.constraints) {
            const Vec3 impulse = c.total_normal() * c.normal + c.total_tangent();
            const bool ship = c.a == static_cast<std::int32_t>(kShip);
            if (ship) on_ship -= impulse;
            if (!ship && !b.held[c.a]) unexplained -= impulse;
            if (!b.held[c.b]) unexplained += impulse;
        }
        unexplained -= momentum_of_free();
        imbalance_ = std::max(imbalance_, unexplained.norm() / dt);
        return on_ship;
    }

    const World& world() const override { return world_; }
    double imbalance() const override { return imbalance_; }

private:
    Vec3 momentum_of_free() const {
        const Bodies& b = world_.scene.bodies;
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 1; i < b.size(); ++i)
            if (!b.held[i]) sum += b.momentum[i];
        return sum;
    }

    World world_;
    double imbalance_ = 0.0;
};

}  // namespace

std::unique_ptr<Engine> make_own_engine(World world) {
    return std::make_unique<OwnEngine>(std::move(world));
}

}  // namespace ice::peers
