// SPDX-License-Identifier: GPL-3.0-or-later
// The ledger on the paper's cases: the ship's work is accounted for.
#include <catch2/catch.hpp>

#include "tests/validation/paper_case.hpp"
#include "tests/validation/table.hpp"

using namespace ice;

namespace {

// Share of the ship's work that the ledger does not explain after a travel [m]. The whole of each
// case is held to the same bound by its expected.toml.
double unexplained(World w, double travel) {
    const double start = w.scene.bodies.position[kShip].x();
    while (w.scene.bodies.position[kShip].x() - start < travel) step(w);
    REQUIRE(w.ledger.ship_work > 1000.0);
    return w.ledger.residual(potential_energy(w.scene, w.parameters)) / w.ledger.ship_work;
}

const char* const kWhy = "work = motion + height + losses";

}  // namespace

TEST_CASE("the ledger explains the ship's work in the paper's 2D case", "[validation]") {
    const std::string speed = GENERATE("0.2", "0.5", "0.8", "1.0");
    const std::string normal = GENERATE("centres", "surface");
    CAPTURE(speed, normal);
    test::validate(
        {"paper's 2D case, four speeds, both normals: share of the ship's work not in "
         "the energy ledger",
         "", 0.0,
         unexplained(test::paper_2d({"hull.speed=" + speed, "contact.normal=" + normal}), 6.0),
         test::within(0.005), kWhy});
}

TEST_CASE("the ledger explains the ship's work in the paper's 3D case", "[validation]") {
    const std::string buoyancy = GENERATE("centre", "distributed");
    CAPTURE(buoyancy);
    test::validate(
        {"paper's 3D case, both models of buoyancy: share of the ship's work not in the energy "
         "ledger",
         "", 0.0, unexplained(test::paper_3d({"buoyancy.model=" + buoyancy}), 6.0),
         test::within(0.005), kWhy});
}
