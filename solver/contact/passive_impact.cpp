// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/contact/passive_impact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace ice {

namespace {

// Free bodies connected by contacts share the smallest of their numbers.
std::vector<std::int32_t> find_islands(const Bodies& bodies,
                                       const std::vector<Constraint>& constraints) {
    std::vector<std::int32_t> parent(bodies.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::int32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const Constraint& c : constraints) {
        if (bodies.inverse_mass[c.a] == 0.0 || bodies.inverse_mass[c.b] == 0.0) continue;
        const std::int32_t a = root(c.a), b = root(c.b);
        parent[std::max(a, b)] = std::min(a, b);
    }
    for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = root(static_cast<std::int32_t>(i));
    return parent;
}

std::int32_t island_of(const Bodies& bodies, const std::vector<std::int32_t>& islands,
                       const Constraint& c) {
    return islands[bodies.inverse_mass[c.a] > 0.0 ? c.a : c.b];
}

Vec3 relative_in(const ImpactState& state, const Constraint& c) {
    return state.velocity[c.b] + state.angular_velocity[c.b].cross(c.arm_b) - state.velocity[c.a] -
           state.angular_velocity[c.a].cross(c.arm_a);
}

// Per island: the gain of energy of impulses J that lead from `start` to `end`.
std::vector<double> island_gains(const Bodies& bodies, const std::vector<Constraint>& constraints,
                                 const std::vector<std::int32_t>& islands, const ImpactState& start,
                                 const ImpactState& end) {
    std::vector<double> gain(bodies.size(), 0.0);
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const Constraint& c = constraints[k];
        if (c.normal_mass == 0.0) continue;
        const Vec3 j = end.normal[k] * c.normal + end.tangent[k];
        gain[island_of(bodies, islands, c)] +=
            0.5 * j.dot(relative_in(start, c) + relative_in(end, c));
    }
    return gain;
}

// Largest s in [0, 1] where a convex parabola through its values at 0, 1/2 and 1 is at most 0.
double largest_share(double at_zero, double at_half, double at_one) {
    if (at_one <= 0.0) return 1.0;
    const double curve = 2.0 * (at_zero - 2.0 * at_half + at_one);
    const double slope = at_one - at_zero - curve;
    if (at_zero > 0.0) return 0.0;
    if (curve <= 0.0) return std::clamp(-at_zero / (at_one - at_zero), 0.0, 1.0);
    const double root = std::sqrt(std::max(slope * slope - 4.0 * curve * at_zero, 0.0));
    return std::clamp((-slope + root) / (2.0 * curve), 0.0, 1.0);
}

ImpactState half_way(const ImpactState& a, const ImpactState& b) {
    ImpactState out = a;
    const auto mix = [](auto& x, const auto& y) {
        for (std::size_t k = 0; k < x.size(); ++k) x[k] = 0.5 * (x[k] + y[k]);
    };
    mix(out.velocity, b.velocity);
    mix(out.angular_velocity, b.angular_velocity);
    mix(out.normal, b.normal);
    mix(out.tangent, b.tangent);
    return out;
}

}  // namespace

void ImpactState::save(const Bodies& bodies, const std::vector<Constraint>& constraints) {
    velocity = bodies.velocity;
    angular_velocity = bodies.angular_velocity;
    normal.clear();
    tangent.clear();
    for (const Constraint& c : constraints) {
        normal.push_back(c.impact_normal);
        tangent.push_back(c.impact_tangent);
    }
}

void ImpactState::restore(Bodies& bodies, std::vector<Constraint>& constraints) const {
    bodies.velocity = velocity;
    bodies.angular_velocity = angular_velocity;
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        constraints[k].impact_normal = normal[k];
        constraints[k].impact_tangent = tangent[k];
    }
}

double energy_gain(const Bodies& bodies, const std::vector<Constraint>& constraints,
                   const ImpactState& start) {
    ImpactState now;
    now.save(bodies, constraints);
    const auto gains =
        island_gains(bodies, constraints, find_islands(bodies, constraints), start, now);
    return *std::max_element(gains.begin(), gains.end());
}

void limit_rebound(Bodies& bodies, std::vector<Constraint>& constraints, const ImpactState& start,
                   const ImpactState& plastic) {
    ImpactState full;
    full.save(bodies, constraints);
    const auto islands = find_islands(bodies, constraints);
    const auto gain = [&](const ImpactState& end) {
        return island_gains(bodies, constraints, islands, start, end);
    };
    const auto at_zero = gain(plastic), at_one = gain(full);
    const auto at_half = gain(half_way(plastic, full));
    const auto share = [&](std::int32_t island) {
        return largest_share(at_zero[island], at_half[island], at_one[island]);
    };
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const double s = share(islands[i]);
        if (s == 1.0) continue;
        bodies.velocity[i] = plastic.velocity[i] + s * (full.velocity[i] - plastic.velocity[i]);
        bodies.angular_velocity[i] = plastic.angular_velocity[i] +
                                     s * (full.angular_velocity[i] - plastic.angular_velocity[i]);
    }
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        Constraint& c = constraints[k];
        const double s = share(island_of(bodies, islands, c));
        if (s == 1.0 || c.normal_mass == 0.0) continue;
        c.impact_normal = plastic.normal[k] + s * (full.normal[k] - plastic.normal[k]);
        c.impact_tangent = plastic.tangent[k] + s * (full.tangent[k] - plastic.tangent[k]);
    }
}

}  // namespace ice
