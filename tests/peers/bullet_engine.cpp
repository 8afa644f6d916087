// SPDX-License-Identifier: GPL-3.0-or-later
// Bullet 3.24, double precision. Set-up against its defaults:
//
//   no deactivation; restitution threshold 0; iterations as in the case
//   overlap of any depth is removed by split impulses: the default of shallow overlap, a velocity,
//   adds energy and would enter the reported forces
//   contact points count from touching on: before it Bullet stops a floe at the face without the
//   bounce, so that of the restitution 0.3 nearly nothing is left
//   friction from the case's pair table
//
// Bodies are prisms of 1 m breadth that move in Bullet's x-y plane only; with the breadth along
// its z the first friction direction lies in the plane also where nothing slides. The hull is a
// compound of convex parts cut from corner to corner: no face has a seam for floes to catch on.
#include <btBulletDynamicsCommon.h>

#include "tests/peers/foreign_engine.hpp"

namespace ice::peers {

namespace {

constexpr double kBreadth = 1.0;  // [m]
// Bullet rounds the hull outwards by its margin where it measures distances [m]; contact points are
// clipped from the exact faces.
constexpr double kMargin = 0.001;

const World* pair_table = nullptr;  // of the engine that is stepping: Bullet's hooks are global

btScalar pair_friction(const btCollisionObject* a, const btCollisionObject* b) {
    const Case& p = pair_table->parameters;
    const bool ship = a->getUserIndex() == 0 || b->getUserIndex() == 0;
    return ship ? p.contact.friction_ship_ice : p.contact.friction_ice_ice;
}

btScalar pair_restitution(const btCollisionObject*, const btCollisionObject*) {
    return pair_table->parameters.contact.restitution;
}

Vec2 from_bullet(const btVector3& v) { return {v.x(), v.y()}; }

class BulletEngine final : public ForeignEngine {
public:
    explicit BulletEngine(World world) : ForeignEngine(std::move(world)) {
        bullet_.setGravity(btVector3(0, 0, 0));
        btContactSolverInfo& info = bullet_.getSolverInfo();
        info.m_numIterations = world_.parameters.contact.iterations;
        info.m_restitutionVelocityThreshold = 0.0;
        info.m_splitImpulse = true;
        info.m_splitImpulsePenetrationThreshold = 0.0;
        for (std::size_t i = 0; i < world_.scene.bodies.size(); ++i) add_body(i);
    }

    ~BulletEngine() override {
        for (const auto& body : bodies_) bullet_.removeRigidBody(body.get());
    }

private:
    std::unique_ptr<btCollisionShape> hull_shape() {
        auto compound = std::make_unique<btCompoundShape>();
        for (const Polygon& part : convex_parts(hull_)) {
            auto prism = std::make_unique<btConvexHullShape>();
            for (const Vec2& p : part)
                for (const double side : {-0.5, 0.5})
                    prism->addPoint(btVector3(p.x(), p.y(), side * kBreadth), false);
            prism->recalcLocalAabb();
            prism->setMargin(kMargin);
            prism->initializePolyhedralFeatures();
            compound->addChildShape(btTransform::getIdentity(), prism.get());
            shapes_.push_back(std::move(prism));
        }
        return compound;
    }

    std::unique_ptr<btCollisionShape> box_shape(const Vec2& half) {
        auto box = std::make_unique<btBoxShape>(btVector3(half.x(), half.y(), 0.5 * kBreadth));
        box->setMargin(kMargin);
        box->initializePolyhedralFeatures();
        return box;
    }

    btTransform pose_of(const PlaneState& s) const {
        return btTransform(btQuaternion(btVector3(0, 0, 1), s.angle),
                           btVector3(s.position.x(), s.position.y(), 0.0));
    }

    void add_body(std::size_t i) {
        shapes_.push_back(i == kShip ? hull_shape() : box_shape(half_sizes_[i]));
        btRigidBody::btRigidBodyConstructionInfo info(0.0, nullptr, shapes_.back().get());
        const PlaneState start = start_of(i);
        info.m_startWorldTransform = pose_of(start);
        bodies_.push_back(std::make_unique<btRigidBody>(info));
        btRigidBody& body = *bodies_.back();
        body.setUserIndex(static_cast<int>(i));
        body.setActivationState(DISABLE_DEACTIVATION);
        body.setContactProcessingThreshold(0.0);
        if (i == kShip)
            body.setCollisionFlags(body.getCollisionFlags() |
                                   btCollisionObject::CF_KINEMATIC_OBJECT);
        else if (!world_.scene.bodies.held[i])
            make_free(i);
        bullet_.addRigidBody(&body);
    }

    void make_free(std::size_t i) {
        btRigidBody& body = *bodies_[i];
        const double inertia = world_.scene.bodies.inertia(i)(1, 1);
        body.setMassProps(world_.scene.bodies.mass[i], btVector3(inertia, inertia, inertia));
        body.updateInertiaTensor();
        body.setLinearFactor(btVector3(1, 1, 0));
        body.setAngularFactor(btVector3(0, 0, 1));
        const PlaneState start = start_of(i);
        body.setLinearVelocity(btVector3(start.velocity.x(), start.velocity.y(), 0.0));
        body.setAngularVelocity(btVector3(0.0, 0.0, start.turn));
    }

    void release_floe(std::size_t i) override {
        bullet_.removeRigidBody(bodies_[i].get());
        make_free(i);
        bullet_.addRigidBody(bodies_[i].get());
    }

    void push(std::size_t i, const Vec2& force, double moment) override {
        bodies_[i]->applyCentralForce(btVector3(force.x(), force.y(), 0.0));
        bodies_[i]->applyTorque(btVector3(0.0, 0.0, moment));
    }

    // Bullet takes the speed of a prescribed body from where it was a step ago.
    void place_ship(double dt) {
        const PlaneState ship = start_of(kShip);
        PlaneState before = ship;
        before.position -= dt * ship.velocity;
        bodies_[kShip]->setInterpolationWorldTransform(pose_of(before));
        bodies_[kShip]->setWorldTransform(pose_of(ship));
    }

    Impulses solve(double dt) override {
        pair_table = &world_;
        gCalculateCombinedFrictionCallback = pair_friction;
        gCalculateCombinedRestitutionCallback = pair_restitution;
        place_ship(dt);
        bullet_.stepSimulation(dt, 0);  // 0: one step of dt
        return collect();
    }

    Impulses collect() {
        Impulses out;
        for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
            const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(m);
            Vec2 on_a = Vec2::Zero();  // normals point from B to A
            for (int k = 0; k < manifold.getNumContacts(); ++k) {
                const btManifoldPoint& p = manifold.getContactPoint(k);
                // a point that was not solved for still has the impulse of an earlier step
                if (p.getDistance() > manifold.getContactProcessingThreshold()) continue;
                on_a += from_bullet(p.m_appliedImpulse * p.m_normalWorldOnB +
                                    p.m_appliedImpulseLateral1 * p.m_lateralFrictionDir1);
            }
            add(manifold.getBody0()->getUserIndex(), on_a, out);
            add(manifold.getBody1()->getUserIndex(), -on_a, out);
        }
        return out;
    }

    void add(int body, const Vec2& impulse, Impulses& out) const {
        const auto i = static_cast<std::size_t>(body);
        if (i == kShip)
            out.on_ship += impulse;
        else if (world_.scene.bodies.held[i])
            out.on_held += impulse;
    }

    PlaneState state(std::size_t i) const override {
        const btRigidBody& body = *bodies_[i];
        const btMatrix3x3& r = body.getWorldTransform().getBasis();
        return {from_bullet(body.getWorldTransform().getOrigin()),
                from_bullet(body.getLinearVelocity()), std::atan2(r[1][0], r[0][0]),
                body.getAngularVelocity().z()};
    }

    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld bullet_{&dispatcher_, &broadphase_, &solver_, &configuration_};
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace

std::unique_ptr<Engine> make_bullet_engine(World world) {
    return std::make_unique<BulletEngine>(std::move(world));
}

}  // namespace ice::peers
