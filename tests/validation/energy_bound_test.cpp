// SPDX-License-Identifier: GPL-3.0-or-later
// A slow, frictionless 2D stream of gap-free pieces: pushing each of them under costs its potential
// energy, whatever the bow; what the ship does beyond that must be in the ledger's losses.
#include <catch2/catch.hpp>
#include <cstdio>
#include <numbers>

#include "preprocess/fill/fill_spheres.hpp"
#include "tests/support/make_worlds.hpp"

using namespace ice;

namespace {

constexpr double kDraught = 1.2, kLength = 1.0, kThickness = 0.4;  // [m]
constexpr double kBottom = 6.0;                                    // length of the flat bottom [m]
constexpr double kRadius = 0.05;                                   // of all discs [m]

// A convex outline, anticlockwise in the x-z plane, as discs.
SphereSet discs(const std::vector<Vec3>& corner) {
    Section section;
    section.loops.emplace_back();
    for (std::size_t k = 0; k < corner.size(); ++k) {
        const Vec3 a = corner[k], b = corner[(k + 1) % corner.size()];
        const Vec3 along = (b - a).normalized();
        section.loops[0].push_back({a, b, Vec3(along.z(), 0, -along.x()), 0});
    }
    FillOptions options;
    options.radius = kRadius;
    options.spacing = kRadius;
    options.surface_only = true;
    SpheresReport report;
    return fill_discs(section, {"hull"}, options, report);
}

// The bow rises from the bottom at `slope`, the transom stands at x = 0; calm water at z = 0.
SphereSet hull(double slope) {
    constexpr double kFreeboard = 0.6;
    const double bow = kBottom + (kDraught + kFreeboard) / std::tan(slope);
    return discs({Vec3(0, 0, -kDraught), Vec3(kBottom, 0, -kDraught), Vec3(bow, 0, kFreeboard),
                  Vec3(0, 0, kFreeboard)});
}

World stream(double slope, double speed, double time_step, int pieces) {
    Case p = test::empty_space(time_step);
    p.dimension = 2;
    p.gravity = 9.81;
    p.buoyancy = BuoyancyModel::distributed;
    p.drag = DragModel::panel;
    p.friction_ship_ice = p.friction_ice_ice = 0.0;
    p.restitution = 0.3;
    p.iterations = 200;
    p.tolerance = 1e-5;
    p.speed_table = {{0.0, speed}};
    p.floes[0].hold = Hold::until_hull_contact;
    World w;
    w.parameters = p;
    const double top = kThickness * (1.0 - p.ice_density / p.water_density);
    const double reach = kBottom + (kDraught + top) / std::tan(slope);
    w.scene = make_scene(build_shape(hull(slope), false), Vec3(-reach - 0.01, 0, 0),
                         Vec3(speed, 0, 0));
    const double x = 0.5 * kLength, z = 0.5 * kThickness;
    const auto shape =
        test::add_shape(w, discs({Vec3(-x, 0, -z), Vec3(x, 0, -z), Vec3(x, 0, z), Vec3(-x, 0, z)}));
    for (int k = 0; k < pieces; ++k)
        add_floe(w.scene, shape, p.ice_density, Vec3((k + 0.5) * kLength, 0, top - z),
                 Quaternion::Identity(), 0, true);
    return w;
}

// The books at some travel of the ship.
struct Entry {
    EnergyLedger ledger;
    double potential = 0.0, travel = 0.0;
};

Entry entry_at(World& w, double travel) {
    const double start = w.parameters.ship_speed(0.0);
    while (w.time * start < travel - 1e-9) step(w);
    return {w.ledger, potential_energy(w.scene, w.parameters), w.time * start};
}

// Means over a travel of whole pieces, per metre of travel: newtons per metre of breadth.
struct Window {
    double resistance, potential, kinetic, losses, drag, restitution, separation;
};

Window between(const Entry& a, const Entry& b) {
    const double travel = b.travel - a.travel;
    const auto mean = [&](double EnergyLedger::*sum) {
        return (b.ledger.*sum - a.ledger.*sum) / travel;
    };
    Window out;
    out.resistance = mean(&EnergyLedger::ship_work);
    out.potential = (b.potential - a.potential) / travel;
    out.kinetic = mean(&EnergyLedger::kinetic);
    out.drag = mean(&EnergyLedger::drag);
    out.restitution = mean(&EnergyLedger::restitution);
    out.separation = mean(&EnergyLedger::separation);
    out.losses = out.drag + out.restitution + mean(&EnergyLedger::friction) +
                 mean(&EnergyLedger::crushing);
    return out;
}

}  // namespace

TEST_CASE("explore", "[.explore]") {
    for (const double dt : {0.01, 0.005})
        for (const double deg : {30.0, 45.0})
            for (const double speed : {0.1, 0.05}) {
                World w = stream(deg * std::numbers::pi / 180.0, speed, dt, 16);
                const double bound = 0.1 * 9810 * kThickness * (kDraught + 0.05 * kThickness);
                const Entry a = entry_at(w, 3), b = entry_at(w, 7), c = entry_at(w, 9),
                            d = entry_at(w, 13);
                for (const Window& i : {between(a, b), between(c, d)})
                    std::printf("dt %g beta %g u %g: R %.2f bound %.2f pot %.2f kin %.2f losses "
                                "%.2f drag %.2f rest %.2f sep %.2f  excess-losses+sep %.3f\n",
                                dt, deg, speed, i.resistance, bound, i.potential, i.kinetic,
                                i.losses, i.drag, i.restitution, i.separation,
                                i.resistance - bound - i.losses + i.separation);
            }
}
