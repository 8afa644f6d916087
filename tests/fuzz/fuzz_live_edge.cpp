// SPDX-License-Identifier: GPL-3.0-or-later
// Loads on the edge of level ice. Five bytes are one load: the tile, its corner, the direction, and
// the ship's way before the load. After each the area is kept, polygons are simple, and no piece
// lies in the sheet; a crack that opens changes bodies.
#include <algorithm>
#include <numbers>

#include "solver/scene/build_scene.hpp"
#include "tests/fuzz/input_folder.hpp"
#include "tests/support/edge_checks.hpp"
#include "tests/support/make_filled_sets.hpp"
#include "tests/support/make_prisms.hpp"

using namespace ice;

namespace {

constexpr double kWhole = 16.0 * 10.0;  // area of the sheet [m2]
constexpr std::size_t kBytes = 5;       // of a load
constexpr std::size_t kMostLoads = 20;  // of an input

struct Ice {
    Case parameters;
    Scene scene;
    LiveEdge edge;
};

// A ship of 6 m whose stem leans forward, in ice 0.3 m thick, the sheet all around it.
Ice make_ice() {
    const auto mesh = test::make_ring_mesh(
        {{-3, -0.7, -0.8}, {1, -0.7, -0.8}, {1.8, 0, -0.8}, {1, 0.7, -0.8}, {-3, 0.7, -0.8}},
        {{-3, -1, 0.6}, {1, -1, 0.6}, {3, 0, 0.6}, {1, 1, 0.6}, {-3, 1, 0.6}});
    Ice ice;
    Case& p = ice.parameters;
    p.time_step = 0.02;
    p.contact.crushing_pressure = 1e6;
    test::lay_weak_ice(p, {0.0, 16.0, -5.0, 5.0}, 0.3);
    p.hull_position = Vec3(4.0, 0.0, 0.0);
    ice.scene = make_scene(build_shape(test::fill_surface(mesh, 0.3, 0.5), false), p.hull_position,
                           Vec3::UnitX());
    ice.edge.begin(ice.scene, p);
    return ice;
}

void try_load(Ice& ice, const std::uint8_t* load, double time) {
    Vec3& ship = ice.scene.bodies.position[kShip];
    ship.x() = std::min(ship.x() + 0.002 * load[4], 12.0);
    const std::size_t seen = ice.edge.pieces().size();
    const auto tiles = test::tiles_of(ice.edge, ice.scene.bodies);
    if (tiles.empty()) return;
    test::press_edge(ice.edge, ice.scene, ice.parameters,
                     tiles[(load[0] + 256U * (load[1] & 1U)) % tiles.size()], load[2],
                     2.0 * std::numbers::pi * load[3] / 256.0);
    if (!ice.edge.is_due(ice.scene))
        fuzz::report_finding("a load that no ice bears opens no crack");
    if (!ice.edge.renew(ice.scene, ice.parameters, time))
        fuzz::report_finding("a crack changes no body");
    const std::string fault = test::edge_fault(ice.edge, kWhole, seen, true);
    if (!fault.empty()) fuzz::report_finding(fault);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Ice start = make_ice();
    Ice ice = start;
    const std::size_t loads = std::min(size / kBytes, kMostLoads);
    for (std::size_t k = 0; k < loads; ++k)
        try_load(ice, data + k * kBytes, 0.02 * static_cast<double>(k + 1));
    return 0;
}
