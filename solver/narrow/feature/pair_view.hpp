// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/broad/find_pairs.hpp"
#include "solver/narrow/feature/measure_gap.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Two bodies seen from a: b's spheres are brought into a's axes, where a's grid lies.
struct PairView {
    const Scene& scene;
    BodyPair pair;
    const Shape& shape_a;
    const Shape& shape_b;
    Mat3 rotation_ab;     // b's axes to a's
    Vec3 translation_ab;  // b's origin in a's axes [m]

    PairView(const Scene& s, BodyPair p)
        : scene(s),
          pair(p),
          shape_a(s.shapes[static_cast<std::size_t>(s.bodies.shape[p.a])]),
          shape_b(s.shapes[static_cast<std::size_t>(s.bodies.shape[p.b])]),
          rotation_ab(s.bodies.rotation[p.a].transpose() * s.bodies.rotation[p.b]),
          translation_ab(s.bodies.rotation[p.a].transpose() *
                         (s.bodies.position[p.b] - s.bodies.position[p.a])) {}

    /// Present centre of a's sphere i, then of b's sphere j, both in a's axes [m].
    Vec3 center_a(std::int32_t i) const {
        return shape_a.center[i] + scene.crushed.displacement_of(pair.a, i);
    }
    Vec3 center_b(std::int32_t j) const {
        return rotation_ab * (shape_b.center[j] + scene.crushed.displacement_of(pair.b, j)) +
               translation_ab;
    }
    /// A point in b's axes [m].
    Vec3 to_b(const Vec3& in_a) const { return rotation_ab.transpose() * (in_a - translation_ab); }
    /// Has the sphere been driven right through its body?
    bool is_gone_a(std::int32_t i) const {
        return !scene.crushed.is_whole(pair.a) && !shape_a.box.contains(center_a(i));
    }
    bool is_gone_b(std::int32_t j) const {
        return !scene.crushed.is_whole(pair.b) &&
               !shape_b.box.contains(
                   Vec3(shape_b.center[j] + scene.crushed.displacement_of(pair.b, j)));
    }
    /// Spheres with their features, in a's axes.
    Feature sphere_a(std::int32_t i) const {
        return {center_a(i),           shape_a.radius[i],     shape_a.normal[i],
                shape_a.spread_cos[i], shape_a.spread_sin[i], shape_a.cone[i],
                shape_a.patch_radius};
    }
    Feature sphere_b(std::int32_t j) const {
        return {center_b(j),           shape_b.radius[j],     rotation_ab * shape_b.normal[j],
                shape_b.spread_cos[j], shape_b.spread_sin[j], shape_b.cone[j].turned(rotation_ab),
                shape_b.patch_radius};
    }
    /// support_point of sphere_a(i) and sphere_b(j), whose faces need not be turned for it, along
    /// the unit vector n, outward of that sphere; all in a's axes [m].
    Vec3 support_a(std::int32_t i, const Vec3& n) const {
        return center_a(i) +
               support_offset(shape_a.cone[i], shape_a.radius[i], shape_a.normal[i], n);
    }
    Vec3 support_b(std::int32_t j, const Vec3& n) const {
        return center_b(j) + support_offset(shape_b.cone[j], shape_b.radius[j],
                                            rotation_ab * shape_b.normal[j], n);
    }
};

/// Upper bound of the speed at which surface points of the two bodies approach [m/s]: by the
/// triangle inequality, |v_b - v_a| + |w_a| R_a + |w_b| R_b with the bounding radii R, of a free
/// ship from its centre of gravity.
inline double closing_speed(const Scene& scene, BodyPair pair) {
    const Bodies& b = scene.bodies;
    const auto turning = [&](std::int32_t i) {
        return b.angular_velocity[i].norm() *
               (scene.shape_of(i).bounding_radius + b.arm(i, b.position[i]).norm());
    };
    return (b.velocity[pair.b] - b.velocity[pair.a]).norm() + turning(pair.a) + turning(pair.b);
}

/// Two spheres that may touch.
struct Candidate {
    std::int32_t i, j;  // numbers of the spheres of a and b
    Gap gap;            // its normal in a's axes
    std::int32_t incident() const { return gap.reference_is_a ? j : i; }
};

}  // namespace ice
