// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/peers/engine.hpp"

namespace ice::peers {

namespace {

class OwnEngine : public Engine {
public:
    explicit OwnEngine(World world) : world_(std::move(world)) {}

    Vec3 step() override {
        ice::step(world_);
        Vec3 on_ship = Vec3::Zero();
        for (const Constraint& c : world_.constraints)
            if (c.a == static_cast<std::int32_t>(kShip))
                on_ship -= c.total_normal() * c.normal + c.total_tangent();
        return on_ship;
    }

    const World& world() const override { return world_; }

private:
    World world_;
};

}  // namespace

std::unique_ptr<Engine> make_own_engine(World world) {
    return std::make_unique<OwnEngine>(std::move(world));
}

}  // namespace ice::peers
