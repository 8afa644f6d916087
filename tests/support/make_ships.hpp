// SPDX-License-Identifier: GPL-3.0-or-later
/// A free box barge, whose motions are known in closed form.
#pragma once

#include "tests/support/make_worlds.hpp"

namespace ice::test {

/// 10 x 2 m, draught 1.44 m, 28 800 kg: its centre of gravity in its centre of buoyancy.
struct Barge {
    static constexpr double kLength = 10.0, kBreadth = 2.0, kDraught = 1.44, kDepth = 2.88;
    static constexpr double kMass = 28800.0, kGravity = 9.81;
    static constexpr double kI44 = 17376.0, kI55 = 247776.0;
};

inline Case barge_case(std::initializer_list<Freedom> free, double dt = 0.01) {
    Case p = empty_space(dt);
    p.gravity = Barge::kGravity;
    p.water_density = 1000.0;
    for (const Freedom k : free) p.ship.free[k] = true;
    p.ship.mass = Barge::kMass;
    // of a box about its own middle
    p.ship.centre_of_gravity = Vec3(0, 0, 0.5 * Barge::kDraught - 0.5 * Barge::kDepth);
    p.ship.gyration =
        Vec3(std::sqrt(Barge::kI44 / Barge::kMass), std::sqrt(Barge::kI55 / Barge::kMass), 2.5);
    return p;
}

inline World barge_world(const Case& p) {
    World w = plate_world(p, Vec3(Barge::kLength, Barge::kBreadth, Barge::kDepth), 0.1, 0.5,
                          -Barge::kDraught);
    w.ship.begin(w.parameters, w.scene);
    return w;
}

/// Mean time between every other crossing of zero of a series at steps of dt, between samples by a
/// straight line.
inline double period_of(const std::vector<double>& series, double dt) {
    double first = -1.0, last = 0.0;
    int crossings = 0;
    for (std::size_t k = 1; k < series.size(); ++k) {
        if ((series[k - 1] < 0.0) == (series[k] < 0.0)) continue;
        last = dt * (static_cast<double>(k) - series[k] / (series[k] - series[k - 1]));
        if (first < 0.0)
            first = last;
        else
            ++crossings;
    }
    return 2.0 * (last - first) / crossings;
}

/// A motion's offset from equilibrium after each of so many steps.
template <class Offset>
std::vector<double> record(World& w, int steps, const Offset& offset) {
    std::vector<double> out{offset()};
    for (int k = 0; k < steps; ++k) {
        step(w);
        out.push_back(offset());
    }
    return out;
}

}  // namespace ice::test
