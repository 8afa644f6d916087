// SPDX-License-Identifier: GPL-3.0-or-later
/// Random bodies with contacts among them, for tests of what the solver makes of these.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "solver/contact/contact_rows.hpp"

namespace ice::test {

/// Bodies of about a ton; body 0 and every tenth are immovable.
inline Bodies make_bodies(std::size_t count, std::mt19937& random) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto vector = [&] { return Vec3(unit(random), unit(random), unit(random)); };
    Bodies out;
    for (std::size_t k = 0; k < count; ++k) {
        const bool free = k % 10 != 0;
        out.shape.push_back(0);
        out.position.push_back(3.0 * vector());
        out.velocity.push_back(vector());
        out.angular_velocity.push_back(vector());
        out.inverse_mass.push_back(free ? 1e-3 * (2.0 + unit(random)) : 0.0);
        const Mat3 turn =
            Quaternion(Eigen::AngleAxisd(unit(random), vector().normalized())) * Mat3::Identity();
        const Vec3 inertia =
            free ? Vec3(1e-2 * (vector() + Vec3::Constant(2.0))) : Vec3(Vec3::Zero());
        out.inverse_inertia_world.push_back(turn * inertia.asDiagonal() * turn.transpose());
    }
    return out;
}

/// What added mass takes off their inverse masses: up to four fifths, in directions of each body.
inline void add_water(Bodies& bodies, std::mt19937& random) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (const double inverse_mass : bodies.inverse_mass) {
        const Vec3 axis(unit(random), unit(random), unit(random));
        const Mat3 share = Mat3::Identity() / 2.0 + 0.3 * axis * axis.transpose() / axis.dot(axis);
        bodies.inverse_mass_excess.push_back(-inverse_mass * share);
    }
}

/// Contacts of random pairs, up to `most` each, ordered by pair.
inline std::vector<Constraint> make_constraints(const Bodies& bodies, std::size_t pairs, int most,
                                                std::mt19937& random) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::uniform_int_distribution<std::int32_t> body(0, static_cast<int>(bodies.size()) - 1);
    std::uniform_int_distribution<int> count(1, most);
    std::vector<std::pair<std::int32_t, std::int32_t>> chosen;
    while (chosen.size() < pairs) {
        const std::int32_t a = body(random), b = body(random);
        if (a < b) chosen.emplace_back(a, b);
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    std::vector<Contact> contacts;
    for (const auto& [a, b] : chosen)
        for (int k = count(random); k > 0; --k) {
            Contact c{};
            c.a = a;
            c.b = b;
            c.point = 0.5 * (bodies.position[a] + bodies.position[b]) +
                      0.1 * Vec3(unit(random), unit(random), unit(random));
            c.normal = Vec3(unit(random), unit(random), unit(random)).normalized();
            contacts.push_back(c);
        }
    ContactLaw law;
    law.crushing_pressure = std::numeric_limits<double>::infinity();
    std::vector<Constraint> out;
    build_constraints(bodies, contacts, law, 0.0, out);
    return out;
}

/// Some of the contacts, in rows.
struct ContactProblem {
    Bodies bodies;
    std::vector<Constraint> constraints;
    std::vector<std::int32_t> which;  ///< constraints that take part
    ContactRows contacts;

    /// @param water  the bodies have added mass
    ContactProblem(std::size_t pairs, int most, unsigned seed, bool water = false) {
        std::mt19937 random(seed);
        bodies = make_bodies(pairs / 2 + 5, random);
        if (water) add_water(bodies, random);
        constraints = make_constraints(bodies, pairs, most, random);
        for (std::size_t k = 0; k < constraints.size(); ++k)
            if (constraints[k].normal.x() < 0.7) which.push_back(static_cast<std::int32_t>(k));
        contacts.build(bodies, constraints, which);
    }
    void begin() {
        contacts.begin_stage(bodies, constraints, &Constraint::rest_normal,
                             &Constraint::rest_tangent, [](const Constraint& c) {
                                 return ContactRows::Target{0.1, 400.0 * c.normal.y()};
                             });
    }
};

}  // namespace ice::test
