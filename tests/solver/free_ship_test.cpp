// SPDX-License-Identifier: GPL-3.0-or-later
// A free ship, without ice: periods, stability, damping, thrust, lines.
//
// Tolerances: 5e-4 is half of the last printed digit of a period; 1e-3 is sin x against x at 0.01
// rad; 1e-9 is where the search for the equilibrium stops; 1e-6 m/s is what an exponential approach
// leaves after 20 times its constant; 1e-12 is rounding of some thousand sums.
#include "solver/ship/free_ship.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "common/base/error.hpp"
#include "solver/flow/added_mass.hpp"
#include "solver/ship/delivered_power.hpp"
#include "solver/ship/ship_matrix.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/make_ships.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

constexpr double kPi = std::numbers::pi;
const double kOmega = std::sqrt(Barge::kGravity / Barge::kDraught);  // of heave

// Symplectic Euler's period is shorter by (w dt)^2 / 24 to the fourth order of w dt.
double period_of_steps(double period, double dt) {
    const double swing = 2.0 * kPi / period * dt;
    return period * (1.0 - swing * swing / 24.0);
}

double height(const World& w) {
    return w.scene.bodies.position[kShip].z() - w.ship.rig().equilibrium.height;
}

// from a small offset of one motion
std::vector<double> decay(World& w, Freedom motion, double offset, int steps) {
    const double level = w.ship.rig().equilibrium.height;
    ShipAngles angles = w.ship.rig().equilibrium.angles;
    if (motion != heave) angles[motion - roll] += offset;
    w.ship.place(w.scene, level + (motion == heave ? offset : 0.0), angles);
    return record(w, steps,
                  [&] { return motion == heave ? height(w) : w.ship.angles()[motion - roll]; });
}

}  // namespace

TEST_CASE("a barge heaves, rolls and pitches with the periods of linear theory", "[ship]") {
    const double dt = 0.01;
    SECTION("heave 2 pi sqrt(T / g), without and with as much added mass as mass") {
        for (const double added : {0.0, 1.0}) {
            Case p = barge_case({heave}, dt);
            p.ship.added_mass[heave] = added;
            World w = barge_world(p);
            const double expected = 2.0 * kPi / kOmega * std::sqrt(1.0 + added);
            CHECK(expected == Near(added == 0.0 ? 2.407 : 3.404).epsilon(5e-4));
            const double found = period_of(decay(w, heave, 0.01, 3000), dt);
            // linear but for rounding; the crossings' straight lines are good to (w dt)^2 / 8
            CHECK(found == Near(period_of_steps(expected, dt)).epsilon(2e-6));
        }
    }
    SECTION("roll 3.239 s and pitch 2.446 s") {
        for (const auto& [motion, inertia, gm, expected] :
             {std::tuple(roll, Barge::kI44, 4.0 / (12.0 * Barge::kDraught), 3.239),
              std::tuple(pitch, Barge::kI55, 100.0 / (12.0 * Barge::kDraught), 2.446)}) {
            World w = barge_world(barge_case({motion}, dt));
            const double linear =
                2.0 * kPi * std::sqrt(inertia / (Barge::kMass * Barge::kGravity * gm));
            CHECK(linear == Near(expected).epsilon(5e-4));
            // at 1e-4 rad the righting arm is linear to 1e-8
            const double found = period_of(decay(w, motion, 1e-4, 3000), dt);
            CHECK(found == Near(period_of_steps(linear, dt)).epsilon(2e-6));
        }
    }
}

TEST_CASE("the barge's metacentric heights are B^2 and L^2 over 12 T", "[ship]") {
    const World w = barge_world(barge_case({heave, roll, pitch}));
    const Equilibrium& e = w.ship.rig().equilibrium;
    // differences over 1e-4 rad are good to 1e-8 of the radius
    CHECK(e.gm_transverse == Near(4.0 / (12.0 * 1.44)).epsilon(1e-7));
    CHECK(e.gm_longitudinal == Near(100.0 / (12.0 * 1.44)).epsilon(1e-6));
    CHECK(e.stiffness[heave] == Near(1000.0 * 9.81 * 20.0).epsilon(1e-9));
    CHECK(e.volume == Near(28.8).epsilon(1e-12));
    CHECK(w.scene.bodies.position[kShip].z() == Near(0.0).margin(1e-9));
}

TEST_CASE("the righting arm of a wall-sided ship is exact while its deck is dry", "[ship]") {
    const World w = barge_world(barge_case({heave, roll}));
    const ShipBody& body = w.ship.rig().body;
    const double gm = 4.0 / (12.0 * 1.44);
    for (const double heel : {0.05, 0.2, 0.4, 0.7}) {
        const Mat3 rotation = orientation_of(ShipAngles(heel, 0, 0)).toRotationMatrix();
        const auto force = [&](double z) {
            return floating_force(w.scene.shapes[0], body, rotation, z, 1000.0, 9.81);
        };
        double low = -1.0, high = 1.0;  // deep and high
        for (int k = 0; k < 100; ++k) {
            const double middle = 0.5 * (low + high);
            (force(middle).lift > 0.0 ? low : high) = middle;
        }
        const double arm = -force(0.5 * (low + high)).moment.x() / (Barge::kMass * 9.81);
        const double tangent = std::tan(heel);
        const double expected = std::sin(heel) * (gm + 0.5 * gm * tangent * tangent);
        CAPTURE(heel);
        CHECK(arm == Near(expected).margin(1e-9));
    }
}

TEST_CASE("a trimmed ship is put where it floats, and one that would capsize is refused",
          "[ship]") {
    SECTION("a centre of gravity ahead of the middle trims by the bow") {
        Case p = barge_case({heave, pitch});
        p.ship.centre_of_gravity.x() = 0.05;
        const World w = barge_world(p);
        const ShipAngles& angles = w.ship.rig().equilibrium.angles;
        // small angles: x_G / GM_L
        CHECK(angles[1] == Near(0.05 / (100.0 / (12.0 * 1.44))).epsilon(1e-3));
        World moved = barge_world(p);
        for (int k = 0; k < 100; ++k) step(moved);
        CHECK(moved.ship.angles()[1] == Near(angles[1]).margin(1e-9));
        CHECK(height(moved) == Near(0.0).margin(1e-9));
    }
    SECTION("a heavier one sinks") {
        Case p = barge_case({heave});
        p.ship.mass = 30000.0;
        const World w = barge_world(p);
        CHECK(w.ship.rig().equilibrium.height == Near(-0.06).epsilon(1e-9));
        CHECK(w.scene.bodies.position[kShip].z() == Near(-0.06).epsilon(1e-9));
    }
    SECTION("no stability, no water below it") {
        Case p = barge_case({roll});
        p.ship.centre_of_gravity.z() += 0.3;
        CHECK_THROWS_WITH(barge_world(p), Catch::Contains("GM") && Catch::Contains("lower the z"));
        Case heavy = barge_case({heave});
        heavy.ship.mass = 70000.0;
        CHECK_THROWS_WITH(barge_world(heavy), Catch::Contains("finds no equilibrium"));
    }
    SECTION("a spring that a step is too long for") {
        Case p = barge_case({surge});
        p.mooring.stiffness[surge] = 1e9;
        CHECK_THROWS_WITH(barge_world(p), Catch::Contains("too long") && Catch::Contains("use"));
    }
    SECTION("a damper of the tow that a step is too long for") {
        Case p = barge_case({surge});
        p.tow.damping = 1e9;
        CHECK_THROWS_WITH(barge_world(p), Catch::Contains("in surge, with tow.damping"));
    }
}

TEST_CASE("heave decays with the logarithmic decrement of its damping ratio", "[ship]") {
    for (const double zeta : {0.05, 0.1}) {
        Case p = barge_case({heave});
        p.ship.damping[heave] = zeta;
        World w = barge_world(p);
        const std::vector<double> z = decay(w, heave, 0.1, 2000);
        std::vector<double> peaks{0.1};
        for (std::size_t k = 1; k + 1 < z.size() && peaks.size() < 6; ++k)
            if (z[k] > z[k - 1] && z[k] > z[k + 1]) peaks.push_back(z[k]);
        REQUIRE(peaks.size() == 6);
        const double found = std::log(peaks[1] / peaks[5]) / 4.0;
        const double expected = 2.0 * kPi * zeta / std::sqrt(1.0 - zeta * zeta);
        CHECK(found == Near(expected).epsilon(0.01));
    }
}

TEST_CASE("the water that a hull's panels move along slows its heave and surge", "[ship]") {
    const double dt = 0.01;
    Case p = barge_case({surge, heave}, dt);
    p.ship.computes_added_mass = true;
    p.propulsion.thrust = 5000.0;
    World w = barge_world(p);
    const double water = -w.scene.bodies.position[kShip].z();
    const Mat6 added =
        ship_added_mass(w.scene.shapes[0].mesh, water, w.ship.rig().body.centre_of_gravity, 1000.0)
            .matrix;
    // of a half circle as broad in strips, pi / 8 rho B^2 L, and up to twice that for a box
    const double circle = kPi / 8.0 * 1000.0 * 4.0 * 10.0;
    CHECK((added(2, 2) > 0.8 * circle && added(2, 2) < 2.0 * circle));
    CHECK((added(0, 0) > 0.02 * Barge::kMass && added(0, 0) < 0.3 * Barge::kMass));
    const std::vector<double> z = decay(w, heave, 0.01, 3000);
    const double expected = 2.0 * kPi / kOmega * std::sqrt(1.0 + added(2, 2) / Barge::kMass);
    CHECK(period_of(z, dt) == Near(period_of_steps(expected, dt)).epsilon(2e-6));
    CHECK(w.scene.bodies.velocity[kShip].x() ==
          Near(5000.0 * 30.0 / (Barge::kMass + added(0, 0))).epsilon(1e-12));
}

TEST_CASE("a matrix about another point gives each motion the same energy", "[ship][analytic]") {
    const Mat6 random = Mat6::NullaryExpr([](int i, int j) { return std::sin(3 * i + 7 * j); });
    const Mat6 matrix = random * random.transpose();
    const Vec3 arm(0.7, -0.4, 1.1);  // from the old point to the new one
    const Mat6 there = moved(matrix, arm);
    for (int k = 0; k < 6; ++k) {
        const Eigen::Matrix<double, 6, 1> motion = random.col(k);
        Eigen::Matrix<double, 6, 1> old = motion;
        old.head<3>() -= Vec3(motion.tail<3>()).cross(arm);
        CHECK(motion.dot(there * motion) == Near(old.dot(matrix * old)).epsilon(1e-12));
    }
    Mat6 coupled = Mat6::Identity();
    coupled(1, 5) = coupled(5, 1) = 0.5;
    coupled(5, 5) = 4.0;
    CHECK(largest_coupling(coupled) == Near(0.25));
    CHECK(largest_coupling(Mat6::Zero()) == 0.0);
}

TEST_CASE("a ship heaves with the water of its matrix file", "[ship]") {
    const TempFolder folder;
    const double added = 1.5 * Barge::kMass, stiffness = 1000.0 * Barge::kGravity * 20.0;
    const double zeta = 0.05, damping = 2.0 * zeta * std::sqrt(stiffness * (Barge::kMass + added));
    std::string text = "about = [0.3, 0.0, 0.2]\n";
    for (const auto& [table, heaves] : {std::pair("added_mass", added), {"damping", damping}}) {
        text += fmt::format("[{}]\n", table);
        for (const char* row : {"surge", "sway", "heave", "roll", "pitch", "yaw"})
            text += fmt::format("{} = [0, 0, {}, 0, 0, 0]\n", row,
                                std::string_view(row) == "heave" ? heaves : 0.0);
    }
    write_bytes(folder / "ship.toml", text);
    Case p = barge_case({heave});
    p.ship.matrix = folder / "ship.toml";
    World w = barge_world(p);
    CHECK(w.ship.rig().body.added[pitch] == Near(0.3 * 0.3 * added).margin(1e-6));
    CHECK(w.ship.rig().body.coupling > 0.0);
    const std::vector<double> z = decay(w, heave, 0.1, 3000);
    const double period =
        2.0 * kPi * std::sqrt((Barge::kMass + added) / stiffness / (1.0 - zeta * zeta));
    CHECK(period_of(z, 0.01) == Near(period).epsilon(1e-4));
}

TEST_CASE("thrust accelerates mass and added mass", "[ship]") {
    Case p = barge_case({surge});
    p.ship.added_mass[surge] = 0.05;
    p.propulsion.thrust = 5000.0;
    World w = barge_world(p);
    for (int k = 0; k < 100; ++k) step(w);
    // a hundred sums
    CHECK(w.scene.bodies.velocity[kShip].x() ==
          Near(5000.0 / (1.05 * Barge::kMass)).epsilon(1e-13));
    CHECK(w.scene.bodies.velocity[kShip].tail<2>().isZero(0.0));
    CHECK(w.scene.bodies.orientation[kShip].vec().isZero(0.0));
}

TEST_CASE("a ship goes on until thrust is resistance", "[ship]") {
    Case p = barge_case({surge}, 0.05);
    SECTION("a table against a table") {
        p.propulsion.thrust_table = {{0.0, 8000.0}, {10.0, 0.0}};
        p.propulsion.resistance_table = {{0.0, 0.0}, {10.0, 24000.0}};
        World w = barge_world(p);
        for (int k = 0; k < 4000; ++k) step(w);
        CHECK(w.scene.bodies.velocity[kShip].x() == Near(2.5).margin(1e-6));
    }
    SECTION("net thrust ends at the open-water speed, and with a linear loss where both meet") {
        p.propulsion.bollard_pull = 20000.0;
        p.propulsion.open_water_speed = 6.0;
        World w = barge_world(p);
        for (int k = 0; k < 4000; ++k) step(w);
        CHECK(w.scene.bodies.velocity[kShip].x() == Near(6.0).margin(1e-6));
        p.ship.damping[surge] = 3000.0;
        World slower = barge_world(p);
        for (int k = 0; k < 4000; ++k) step(slower);
        const double u = slower.scene.bodies.velocity[kShip].x();
        CHECK(20000.0 * (1.0 - u / 18.0 - 2.0 / 3.0 * u * u / 36.0) ==
              Near(3000.0 * u).margin(1e-2));
        CHECK(u < 5.0);
    }
    SECTION("a held speed needs the resistance as thrust") {
        p.propulsion.hold_speed = 2.0;
        p.propulsion.resistance_table = {{0.0, 0.0}, {10.0, 24000.0}};
        World w = barge_world(p);
        for (int k = 0; k < 4000; ++k) step(w);
        CHECK(w.scene.bodies.velocity[kShip].x() == Near(2.0).margin(1e-6));
        CHECK(w.ship.loads().thrust == Near(4800.0).margin(1e-2));
    }
    SECTION("a tow pulls with the resistance") {
        p.speed_table = {{0.0, 2.0}};
        p.tow.stiffness = 1e5;
        p.tow.damping = 2e4;
        p.propulsion.resistance_table = {{0.0, 0.0}, {10.0, 24000.0}};
        World w = barge_world(p);
        for (int k = 0; k < 4000; ++k) step(w);
        CHECK(w.scene.bodies.velocity[kShip].x() == Near(2.0).margin(1e-9));
        CHECK(w.ship.loads().tow.force.x() == Near(4800.0).margin(1e-4));
    }
}

TEST_CASE("bollard pull of a power is K (P D)^(2/3)", "[ship]") {
    Propulsion p;
    p.power = 10e6;
    p.propeller_diameter = 4.0;
    p.open_water_speed = 8.0;
    for (const auto& [screws, k] : {std::pair(1, 0.78), std::pair(2, 0.98), std::pair(3, 1.12)}) {
        p.screws = screws;
        CHECK(bollard_pull(p) == Near(1e3 * k * std::pow(40000.0, 2.0 / 3.0)));
    }
    CHECK(delivered_power(p, 1.0, 3.0) == 10e6);
    Propulsion held;  // the power that its thrust takes
    CHECK(std::isnan(delivered_power(held, 1e5, 3.0)));
    held.propeller_diameter = 4.0;
    held.open_water_speed = 8.0;
    held.screws = 3;
    for (const double u : {-1.0, 0.0, 3.0})
        CHECK(delivered_power(held, thrust_at(p, u), u) == Near(10e6).epsilon(1e-12));
    CHECK(delivered_power(held, -1.0, 3.0) == 0.0);
    CHECK(std::isinf(delivered_power(held, 1.0, 8.0)));
    CHECK(thrust_at(p, 8.0) == Near(0.0).margin(1e-6));
    CHECK(thrust_at(p, -1.0) == bollard_pull(p));
    CHECK(thrust_at(p, 4.0) == Near(bollard_pull(p) * (1.0 - 1.0 / 6.0 - 1.0 / 6.0)));
}

TEST_CASE("a moored ship is offset by F / k and swings with 2 pi sqrt((m + A) / k)", "[ship]") {
    Case p = barge_case({surge, sway, yaw});
    p.ship.added_mass = {0.1, 0.5, 0, 0, 0, 0.2};
    p.mooring.stiffness = {2e4, 3e4, 0, 0, 0, 4e5};
    SECTION("periods of surge, sway and yaw") {
        for (const Freedom motion : {surge, sway, yaw}) {
            World w = barge_world(p);
            const auto k = static_cast<std::size_t>(motion);
            if (motion == yaw)
                w.ship.place(w.scene, 0.0, ShipAngles(0, 0, 1e-3));
            else
                w.scene.bodies.position[kShip][motion] += 0.1;
            const std::vector<double> off = record(w, 5000, [&] {
                return motion == yaw ? w.ship.angles()[2] : w.scene.bodies.position[kShip][motion];
            });
            const double mass =
                (1.0 + p.ship.added_mass[k]) * Barge::kMass * (motion == yaw ? 2.5 * 2.5 : 1.0);
            const double expected = 2.0 * kPi * std::sqrt(mass / p.mooring.stiffness[k]);
            CHECK(period_of(off, 0.01) == Near(period_of_steps(expected, 0.01)).epsilon(1e-5));
        }
    }
    SECTION("offset under pretension") {
        p.mooring.pretension[surge] = 1000.0;
        p.ship.damping[surge] = 1.0;
        World w = barge_world(p);
        for (int k = 0; k < 6000; ++k) step(w);
        CHECK(w.scene.bodies.position[kShip].x() == Near(1000.0 / 2e4).epsilon(1e-9));
    }
}

TEST_CASE("a ship that turned keeps its heading when steered", "[ship]") {
    Case p = barge_case({surge, sway, yaw}, 0.05);
    p.propulsion.hold_heading = true;
    World w = barge_world(p);
    w.ship.place(w.scene, 0.0, ShipAngles(0, 0, 0.2));
    for (int k = 0; k < 4000; ++k) step(w);
    // it is set back to the heading of the start
    CHECK(w.ship.angles()[2] == Near(0.0).margin(1e-6));
}

TEST_CASE("a locked motion stays locked while the others swing", "[ship]") {
    World w = barge_world(barge_case({heave, roll, pitch}));
    w.ship.place(w.scene, 0.05, ShipAngles(0.2, 0.05, 0.0));
    for (int k = 0; k < 2000; ++k) {
        step(w);
        REQUIRE(w.ship.angles()[2] == 0.0);
        REQUIRE(w.scene.bodies.velocity[kShip].x() == 0.0);
    }
    CHECK(std::abs(w.ship.angles()[0]) < 0.3);
}

TEST_CASE("the energy of a swinging ship is kept, and its losses are entered", "[ship]") {
    Case p = barge_case({heave, roll, pitch, surge});
    p.propulsion.thrust = 3000.0;
    p.ship.damping = {500.0, 0, 0.05, 0.05, 0.05, 0};
    World w = barge_world(p);
    w.ship.place(w.scene, 0.1, ShipAngles(0.1, 0.03, 0.0));
    for (int k = 0; k < 3000; ++k) step(w);
    const ShipEnergies& e = w.ship.energies();
    const double kinetic = w.ship.kinetic_energy(w.scene.bodies) - *e.kinetic_start;
    const double potential = w.ship.potential_energy(w.scene, w.parameters) - *e.potential_start;
    CHECK(e.losses > 0.0);
    CHECK(e.thrust - e.losses - kinetic - potential == Near(0.0).margin(2e-3 * e.thrust));
}
