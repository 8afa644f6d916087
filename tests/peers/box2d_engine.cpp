// SPDX-License-Identifier: GPL-3.0-or-later
// Box2D 2.4. Set-up against its defaults:
//
//   sleeping off; restitution threshold 0; velocity iterations as in the case
//   continuous collision off: it would solve sub-steps of its own, and nothing here moves a
//   thickness per step
//   friction from the case's pair table, set before each solve
//
// The hull is one chain: its edges know their neighbours, so floes that slide along a face do not
// catch on the ends of edges, as they would on the seams of convex parts. Box2D wants a skin around
// every shape; it lies inside the faces here: the shapes inside are smaller by it.
#include <box2d/box2d.h>

#include <map>

#include "tests/peers/foreign_engine.hpp"

namespace ice::peers {

namespace {

constexpr int kPositionIterations = 10;  // of overlap removal, as in our solver

b2Vec2 to_box2d(const Vec2& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }

Vec2 from_box2d(const b2Vec2& v) { return {v.x, v.y}; }

std::size_t body_of(b2Fixture* fixture) { return fixture->GetBody()->GetUserData().pointer; }

class Box2dEngine final : public ForeignEngine, private b2ContactListener {
public:
    Box2dEngine(World world, double skin)
        : ForeignEngine(std::move(world)), skin_(skin), box2d_(b2Vec2(0.0f, 0.0f)) {
        box2d_.SetAllowSleeping(false);
        box2d_.SetContinuousPhysics(false);
        box2d_.SetContactListener(this);
        for (std::size_t i = 0; i < world_.scene.bodies.size(); ++i) add_body(i);
    }

private:
    void add_body(std::size_t i) {
        const PlaneState start = start_of(i);
        b2BodyDef def;
        const bool free = i != kShip && !world_.scene.bodies.held[i];
        def.type = i == kShip ? b2_kinematicBody : free ? b2_dynamicBody : b2_staticBody;
        def.position = to_box2d(start.position);
        def.angle = static_cast<float>(start.angle);
        if (free || i == kShip) {
            def.linearVelocity = to_box2d(start.velocity);
            def.angularVelocity = static_cast<float>(start.turn);
        }
        def.userData.pointer = i;
        bodies_.push_back(box2d_.CreateBody(&def));
        if (i == kShip)
            add_hull();
        else
            add_box(i);
        if (free) set_mass(i);
    }

    b2Fixture& add_fixture(std::size_t i, const b2Shape& shape) {
        b2FixtureDef def;
        def.shape = &shape;
        def.restitution = static_cast<float>(world_.parameters.contact.restitution);
        def.restitutionThreshold = 0.0f;
        return *bodies_[i]->CreateFixture(&def);
    }

    void add_hull() {
        std::vector<b2Vec2> corners;
        for (const Vec2& p : inset(hull_, skin_)) corners.push_back(to_box2d(p));
        b2ChainShape chain;
        chain.CreateLoop(corners.data(), static_cast<int32>(corners.size()));
        // a fixture copies the chain but not its radius
        add_fixture(kShip, chain).GetShape()->m_radius = static_cast<float>(skin_);
    }

    void add_box(std::size_t i) {
        const b2Vec2 half = to_box2d(half_sizes_[i] - Vec2(skin_, skin_));
        b2PolygonShape box;
        box.SetAsBox(half.x, half.y);
        box.m_radius = static_cast<float>(skin_);
        add_fixture(i, box);
    }

    void set_mass(std::size_t i) {
        b2MassData mass;
        mass.mass = static_cast<float>(world_.scene.bodies.mass[i]);
        mass.I = static_cast<float>(world_.scene.bodies.inertia(i)(1, 1));
        mass.center.SetZero();
        bodies_[i]->SetMassData(&mass);
    }

    void release_floe(std::size_t i) override {
        bodies_[i]->SetType(b2_dynamicBody);
        set_mass(i);
    }

    void push(std::size_t i, const Vec2& force, double moment) override {
        bodies_[i]->ApplyForceToCenter(to_box2d(force), true);
        bodies_[i]->ApplyTorque(static_cast<float>(moment), true);
    }

    Impulses solve(double dt) override {
        const PlaneState ship = start_of(kShip);
        bodies_[kShip]->SetLinearVelocity(to_box2d(ship.velocity));
        impulses_ = {};
        normals_.clear();
        box2d_.Step(static_cast<float>(dt), world_.parameters.contact.iterations,
                    kPositionIterations);
        return impulses_;
    }

    PlaneState state(std::size_t i) const override {
        const b2Body& b = *bodies_[i];
        return {from_box2d(b.GetPosition()), from_box2d(b.GetLinearVelocity()), b.GetAngle(),
                b.GetAngularVelocity()};
    }

    void PreSolve(b2Contact* contact, const b2Manifold*) override {
        const std::size_t a = body_of(contact->GetFixtureA()), b = body_of(contact->GetFixtureB());
        contact->SetFriction(static_cast<float>(friction(a, b)));
        // the normal the impulses will have: PostSolve comes after the bodies have turned
        b2WorldManifold manifold;
        contact->GetWorldManifold(&manifold);
        normals_[contact] = manifold.normal;
    }

    void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override {
        const std::size_t a = body_of(contact->GetFixtureA()), b = body_of(contact->GetFixtureB());
        const b2Vec2 normal = normals_.at(contact), tangent = b2Cross(normal, 1.0f);
        Vec2 on_b = Vec2::Zero();
        for (int32 k = 0; k < impulse->count; ++k)
            on_b += static_cast<double>(impulse->normalImpulses[k]) * from_box2d(normal) +
                    static_cast<double>(impulse->tangentImpulses[k]) * from_box2d(tangent);
        add(a, -on_b);
        add(b, on_b);
    }

    void add(std::size_t body, const Vec2& impulse) {
        if (body == kShip)
            impulses_.on_ship += impulse;
        else if (world_.scene.bodies.held[body])
            impulses_.on_held += impulse;
    }

    double skin_;
    b2World box2d_;
    std::vector<b2Body*> bodies_;
    std::map<b2Contact*, b2Vec2> normals_;  ///< of this step's contacts, from A to B
    Impulses impulses_;
};

}  // namespace

const double kBox2dSkin = static_cast<double>(b2_polygonRadius);

std::unique_ptr<Engine> make_box2d_engine(World world, double skin) {
    return std::make_unique<Box2dEngine>(std::move(world), skin);
}

}  // namespace ice::peers
