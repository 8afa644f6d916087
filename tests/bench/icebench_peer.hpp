// SPDX-License-Identifier: GPL-3.0-or-later
/// Other rigid-body engines on the scenes loose and packed. Same bodies, loads and steps, the same
/// spheres or exact boxes; contact and motion are theirs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/bench/icebench_scene.hpp"

namespace ice::bench {

/// A scene inside another engine.
class Peer {
public:
    virtual ~Peer() = default;
    /// Advances by the case's time step: loads, contacts, motion.
    virtual void step() = 0;
    /// Contact points of the last step that overlapped, and the deepest of them [m].
    struct Contacts {
        double count = 0.0, max_overlap = 0.0;
    };
    virtual Contacts contacts() const = 0;
    virtual double kinetic_energy() const = 0;  ///< of the floes [J]
};

struct PeerKind {
    std::string name;     ///< of the engine, with its version
    std::string package;  ///< Debian's
    /// Null where the package was not there when this was built.
    std::unique_ptr<Peer> (*make)(const BenchScene& scene);
};

/// Bullet and ODE with our spheres, and Bullet with a box per floe and a convex hull.
const std::vector<PeerKind>& peer_kinds();

/// Weight, buoyancy and drag of a box floe, cheap enough not to weigh in anybody's time.
///
/// With s = clamp(1/2 - z / h) the submerged share, e_d the box's axes, A_d its faces' areas and u,
/// w the velocities along e_d:
///
///     F = (rho_w g V s - m g) z - 1/2 rho_w C_d s sum A_d |u_d| u_d e_d
///     T = -1/2 rho_w C_d s sum c_d |w_d| w_d e_d,
///     c = (l_x l_y^4, l_y l_x^4, l_z (l_x^4 + l_y^4)) / 32
class BoxWater {
public:
    BoxWater(const Vec3& size, const Case& parameters);
    WaterLoad load(double height, const Mat3& rotation, const Vec3& velocity,
                   const Vec3& angular_velocity) const;

private:
    double thickness_, weight_, buoyancy_, drag_;
    Vec3 areas_, turning_;
};

}  // namespace ice::bench
