// SPDX-License-Identifier: GPL-3.0-or-later
// ODE with QuickStep and its 20 iterations, as it comes but for what the scene asks for: no
// disabling, bounce threshold 0, friction as a pyramid's coefficient. A body is a space of spheres.
#include <ode/ode.h>

#include <algorithm>

#include "tests/bench/icebench_peer.hpp"

namespace ice::bench {

namespace {

constexpr int kIterations = 20;

Vec3 from_ode(const dReal* v) { return {v[0], v[1], v[2]}; }

Mat3 rotation_from(const dReal* m) {  // 3 x 4, by rows
    Mat3 out;
    for (int i = 0; i < 3; ++i) out.row(i) = from_ode(m + 4 * i);
    return out;
}

class OdePeer final : public Peer {
public:
    explicit OdePeer(const BenchScene& scene)
        : parameters_(scene.world.parameters), water_(scene.floe_size, parameters_) {
        dInitODE2(0);
        world_ = dWorldCreate();
        space_ = dHashSpaceCreate(nullptr);
        joints_ = dJointGroupCreate(0);
        dWorldSetQuickStepNumIterations(world_, kIterations);
        dWorldSetAutoDisableFlag(world_, 0);
        const Bodies& b = scene.world.scene.bodies;
        for (std::size_t i = 0; i < b.size(); ++i)
            add_body(b, i, i == kShip ? scene.hull : scene.floe);
    }

    OdePeer(const OdePeer&) = delete;
    OdePeer& operator=(const OdePeer&) = delete;
    ~OdePeer() override {
        dJointGroupDestroy(joints_);
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
        dCloseODE();
    }

    void step() override {
        for (std::size_t i = 1; i < bodies_.size(); ++i) {
            const dBodyID body = bodies_[i];
            const WaterLoad load =
                water_.load(dBodyGetPosition(body)[2], rotation_from(dBodyGetRotation(body)),
                            from_ode(dBodyGetLinearVel(body)), from_ode(dBodyGetAngularVel(body)));
            dBodyAddForce(body, load.force.x(), load.force.y(), load.force.z());
            dBodyAddTorque(body, load.moment.x(), load.moment.y(), load.moment.z());
        }
        contacts_ = {};
        dSpaceCollide(space_, this, &OdePeer::meet);
        dWorldQuickStep(world_, parameters_.time_step);
        dJointGroupEmpty(joints_);
    }

    Contacts contacts() const override { return contacts_; }

    double kinetic_energy() const override {
        double sum = 0.0;
        for (std::size_t i = 1; i < bodies_.size(); ++i) {
            const Vec3 v = from_ode(dBodyGetLinearVel(bodies_[i]));
            const Vec3 w = rotation_from(dBodyGetRotation(bodies_[i])).transpose() *
                           from_ode(dBodyGetAngularVel(bodies_[i]));
            sum += 0.5 * mass_ * v.squaredNorm() + 0.5 * w.dot(inertia_.cwiseProduct(w));
        }
        return sum;
    }

private:
    void add_body(const Bodies& b, std::size_t i, const SphereSet& set) {
        const dBodyID body = dBodyCreate(world_);
        bodies_.push_back(body);
        const Vec3 &x = b.position[i], &v = b.velocity[i];
        const Quaternion& q = b.orientation[i];
        const dQuaternion turn{q.w(), q.x(), q.y(), q.z()};
        dBodySetPosition(body, x.x(), x.y(), x.z());
        dBodySetQuaternion(body, turn);
        if (i == kShip) {
            dBodySetKinematic(body);
        } else {
            mass_ = b.mass[i];
            inertia_ = b.inertia(i).diagonal();  // of a box, in its axes
            dMass mass;
            dMassSetParameters(&mass, mass_, 0, 0, 0, inertia_.x(), inertia_.y(), inertia_.z(), 0,
                               0, 0);
            dBodySetMass(body, &mass);
        }
        dBodySetLinearVel(body, v.x(), v.y(), v.z());
        const dSpaceID spheres = dSimpleSpaceCreate(space_);
        for (const Vec3& c : set.centers) {
            const dGeomID sphere = dCreateSphere(spheres, set.radius);
            dGeomSetBody(sphere, body);
            dGeomSetOffsetPosition(sphere, c.x(), c.y(), c.z());
        }
    }

    static void meet(void* self, dGeomID a, dGeomID b) {
        if (dGeomIsSpace(a) || dGeomIsSpace(b)) {
            dSpaceCollide2(a, b, self, &OdePeer::meet);
            return;
        }
        static_cast<OdePeer*>(self)->touch(a, b);
    }

    void touch(dGeomID a, dGeomID b) {
        const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
        dContact contact{};
        if (body_a == body_b || dCollide(a, b, 1, &contact.geom, sizeof(dContact)) == 0) return;
        const bool ship = body_a == bodies_[kShip] || body_b == bodies_[kShip];
        contact.surface.mode = dContactBounce | dContactApprox1;
        contact.surface.mu =
            ship ? parameters_.contact.friction_ship_ice : parameters_.contact.friction_ice_ice;
        contact.surface.bounce = parameters_.contact.restitution;
        contact.surface.bounce_vel = 0.0;
        dJointAttach(dJointCreateContact(world_, joints_, &contact), body_a, body_b);
        ++contacts_.count;
        contacts_.max_overlap = std::max(contacts_.max_overlap, double{contact.geom.depth});
    }

    Case parameters_;
    BoxWater water_;
    double mass_ = 0.0;
    Vec3 inertia_ = Vec3::Zero();
    dWorldID world_;
    dSpaceID space_;
    dJointGroupID joints_;
    std::vector<dBodyID> bodies_;
    Contacts contacts_;
};

}  // namespace

std::unique_ptr<Peer> make_ode(const BenchScene& scene) { return std::make_unique<OdePeer>(scene); }

}  // namespace ice::bench
