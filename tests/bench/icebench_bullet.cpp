// SPDX-License-Identifier: GPL-3.0-or-later
// Bullet, single precision, as it comes but for what the scene asks for: no deactivation,
// restitution threshold 0, 10 iterations, friction and restitution of the case by pair. A body is
// a compound of spheres; in a second row a floe is a box and the hull the convex hull of its mesh.
#include <btBulletDynamicsCommon.h>

#include <algorithm>

#include "tests/bench/icebench_peer.hpp"

namespace ice::bench {

namespace {

const Case* pair_law = nullptr;  // of the scene that is stepping: Bullet's hooks are global

btScalar pair_friction(const btCollisionObject* a, const btCollisionObject* b) {
    const bool ship = a->isStaticOrKinematicObject() || b->isStaticOrKinematicObject();
    return static_cast<btScalar>(ship ? pair_law->contact.friction_ship_ice
                                      : pair_law->contact.friction_ice_ice);
}

btScalar pair_restitution(const btCollisionObject*, const btCollisionObject*) {
    return static_cast<btScalar>(pair_law->contact.restitution);
}

btVector3 to_bullet(const Vec3& v) {
    return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()),
            static_cast<btScalar>(v.z())};
}

Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

Mat3 from_bullet(const btMatrix3x3& m) {
    Mat3 out;
    for (int i = 0; i < 3; ++i) out.row(i) = from_bullet(m[i]);
    return out;
}

class BulletPeer final : public Peer {
public:
    BulletPeer(const BenchScene& scene, bool convex)
        : parameters_(scene.world.parameters), water_(scene.floe_size, parameters_) {
        bullet_.setGravity(btVector3(0, 0, 0));
        bullet_.getSolverInfo().m_numIterations = 10;
        bullet_.getSolverInfo().m_restitutionVelocityThreshold = 0;
        const Bodies& b = scene.world.scene.bodies;
        if (convex) {
            hull_ = convex_hull(scene.hull.mesh);
            floe_ = std::make_unique<btBoxShape>(to_bullet(0.5 * scene.floe_size));
        } else {
            hull_ = compound(scene.hull, hull_ball_);
            floe_ = compound(scene.floe, floe_ball_);
        }
        for (std::size_t i = 0; i < b.size(); ++i) add_body(b, i);
    }

    ~BulletPeer() override {
        for (const auto& body : bodies_) bullet_.removeRigidBody(body.get());
    }

    void step() override {
        const auto dt = static_cast<btScalar>(parameters_.time_step);
        pair_law = &parameters_;
        gCalculateCombinedFrictionCallback = pair_friction;
        gCalculateCombinedRestitutionCallback = pair_restitution;
        move_ship(dt);
        for (std::size_t i = 1; i < bodies_.size(); ++i) {
            btRigidBody& body = *bodies_[i];
            const btTransform& pose = body.getWorldTransform();
            const WaterLoad load = water_.load(pose.getOrigin().z(), from_bullet(pose.getBasis()),
                                               from_bullet(body.getLinearVelocity()),
                                               from_bullet(body.getAngularVelocity()));
            body.applyCentralForce(to_bullet(load.force));
            body.applyTorque(to_bullet(load.moment));
        }
        bullet_.stepSimulation(dt, 0);  // 0: one step of dt
    }

    Contacts contacts() const override {
        Contacts out;
        for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
            const btPersistentManifold& manifold =
                *const_cast<btCollisionDispatcher&>(dispatcher_).getManifoldByIndexInternal(m);
            for (int k = 0; k < manifold.getNumContacts(); ++k) {
                const double overlap = -manifold.getContactPoint(k).getDistance();
                if (overlap < 0.0) continue;
                ++out.count;
                out.max_overlap = std::max(out.max_overlap, overlap);
            }
        }
        return out;
    }

    double kinetic_energy() const override {
        double sum = 0.0;
        for (std::size_t i = 1; i < bodies_.size(); ++i) {
            const btRigidBody& body = *bodies_[i];
            const Mat3 rotation = from_bullet(body.getWorldTransform().getBasis());
            const Vec3 v = from_bullet(body.getLinearVelocity());
            const Vec3 w = rotation.transpose() * from_bullet(body.getAngularVelocity());
            sum += 0.5 * mass_ * v.squaredNorm() + 0.5 * w.dot(inertia_.cwiseProduct(w));
        }
        return sum;
    }

private:
    static std::unique_ptr<btCollisionShape> compound(const SphereSet& set,
                                                      std::unique_ptr<btSphereShape>& ball) {
        ball = std::make_unique<btSphereShape>(static_cast<btScalar>(set.radius));
        auto out = std::make_unique<btCompoundShape>();
        for (const Vec3& c : set.centers)
            out->addChildShape(btTransform(btQuaternion::getIdentity(), to_bullet(c)), ball.get());
        return out;
    }

    // Bullet rounds a hull outwards by its margin: 1 mm here instead of 4 cm.
    static std::unique_ptr<btCollisionShape> convex_hull(const TriangleMesh& mesh) {
        auto out = std::make_unique<btConvexHullShape>();
        for (const Vec3& v : mesh.vertices) out->addPoint(to_bullet(v), false);
        out->recalcLocalAabb();
        out->setMargin(btScalar(0.001));
        return out;
    }

    void add_body(const Bodies& b, std::size_t i) {
        const bool ship = i == kShip;
        btVector3 inertia(0, 0, 0);
        if (!ship) {
            mass_ = b.mass[i];
            inertia_ = b.inertia(i).diagonal();  // of a box, in its axes
            inertia = to_bullet(inertia_);
        }
        btRigidBody::btRigidBodyConstructionInfo info(static_cast<btScalar>(b.mass[i]), nullptr,
                                                      (ship ? hull_ : floe_).get(), inertia);
        const Quaternion& q = b.orientation[i];
        info.m_startWorldTransform =
            btTransform(btQuaternion(static_cast<btScalar>(q.x()), static_cast<btScalar>(q.y()),
                                     static_cast<btScalar>(q.z()), static_cast<btScalar>(q.w())),
                        to_bullet(b.position[i]));
        bodies_.push_back(std::make_unique<btRigidBody>(info));
        btRigidBody& body = *bodies_.back();
        body.setActivationState(DISABLE_DEACTIVATION);
        body.setLinearVelocity(to_bullet(b.velocity[i]));
        if (ship)
            body.setCollisionFlags(body.getCollisionFlags() |
                                   btCollisionObject::CF_KINEMATIC_OBJECT);
        bullet_.addRigidBody(&body);
    }

    // Bullet takes the speed of a prescribed body from where it was a step ago.
    void move_ship(btScalar dt) {
        btRigidBody& ship = *bodies_[kShip];
        const btTransform before = ship.getWorldTransform();
        btTransform now = before;
        now.getOrigin().setX(before.getOrigin().x() +
                             dt * static_cast<btScalar>(parameters_.ship_speed(0.0)));
        ship.setInterpolationWorldTransform(before);
        ship.setWorldTransform(now);
    }

    Case parameters_;
    BoxWater water_;
    double mass_ = 0.0;
    Vec3 inertia_ = Vec3::Zero();
    std::unique_ptr<btSphereShape> hull_ball_, floe_ball_;
    std::unique_ptr<btCollisionShape> hull_, floe_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld bullet_{&dispatcher_, &broadphase_, &solver_, &configuration_};
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace

std::unique_ptr<Peer> make_bullet(const BenchScene& scene) {
    return std::make_unique<BulletPeer>(scene, false);
}

std::unique_ptr<Peer> make_bullet_convex(const BenchScene& scene) {
    return std::make_unique<BulletPeer>(scene, true);
}

}  // namespace ice::bench
