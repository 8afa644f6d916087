// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/case/ship_schema.hpp"

#include "solver/case/stored_value.hpp"

namespace ice {

namespace {

using namespace stored;

using D = Dimension;
using G = FloeGroup;

constexpr std::string_view kFreedomNames = "surge|sway|heave|roll|pitch|yaw";
constexpr std::string_view kAddedMasses = "none|computed";
constexpr std::string_view kHeadings = "free|hold";
// Largest mass, force, stiffness or damping, in its SI unit: no ship has as much, so that a larger
// number is a lost unit. A larger value lets such numbers pass.
constexpr double kHuge = 1e15;

std::vector<CaseKey> body_keys() {
    return {
        // "free" first: which other keys have an effect follows from it
        {"ship.free", Kind::words, D::none, "[]", 0, 0, 0, kFreedomNames,
         "Motions in which forces move the ship; in the others it keeps its course (hull.speed, "
         "upright). Empty: the ship keeps its prescribed course.",
         [](Case& c, G&, const Value& v) {
             c.ship.free.fill(false);
             for (const std::string& word : std::get<std::vector<std::string>>(v))
                 c.ship.free[static_cast<std::size_t>(place_in(word, kFreedomNames))] = true;
         }},
        {"ship.mass", Kind::number, D::mass, "-", 1e-9, kHuge, 0, "",
         "Mass of the ship; default: the displacement at hull.draught or hull.position.",
         [](Case& c, G&, const Value& v) { c.ship.mass = number(v); }},
        {"ship.centre_of_gravity", Kind::vector, D::length, "-", -1e4, 1e4, 3, "",
         "In the hull mesh's axes; default: the centre of buoyancy. Its height decides how the "
         "ship rolls.",
         [](Case& c, G&, const Value& v) { c.ship.centre_of_gravity = vector3(v); }},
        {"ship.gyration", Kind::vector, D::length, "-", 1e-6, 1e4, 3, "",
         "Radii of gyration about x, y, z; default 0.35 of the breadth and twice 0.25 of the "
         "length.",
         [](Case& c, G&, const Value& v) { c.ship.gyration = vector3(v); }},
        {"ship.added_mass", Kind::choice_or_vector, D::none, "\"none\"", 0, 100, 6, kAddedMasses,
         "Added mass: shares of the mass in surge, sway, heave and of the moments of inertia in "
         "roll, pitch, yaw; or computed for the hull in ideal water, in 3D.",
         [](Case& c, G&, const Value& v) {
             c.ship.added_mass = {};
             c.ship.computes_added_mass =
                 std::holds_alternative<std::string>(v) && place_in(text(v), kAddedMasses) == 1;
             if (std::holds_alternative<std::vector<double>>(v)) c.ship.added_mass = vector6(v);
         }},
        {"ship.matrix", Kind::path, D::none, "-", 0, 0, 0, "",
         "File of added mass and damping, 6 x 6, that another program computed, as "
         "examples/ship_matrix.py writes it; relative to the case file. In 3D, without "
         "ship.added_mass; its damping adds to ship.damping.",
         [](Case& c, G&, const Value& v) { c.ship.matrix = text(v); }},
        // the unit depends on the motion: a critical damping exists only with a restoring
        // force
        {"ship.damping", Kind::vector, D::none, "[0.0, 0.0, 0.0, 0.0, 0.0, 0.0]", 0, kHuge, 6, "",
         "Linear damping of surge to yaw: share of the critical damping where water, mooring or "
         "tow has a stiffness, else N s/m (N m s).",
         [](Case& c, G&, const Value& v) { c.ship.damping = vector6(v); }},
    };
}

std::vector<CaseKey> propulsion_keys() {
    return {
        // Five forms of the thrust; a case has one (check_ship.cpp). Net thrust is less the
        // open-water resistance already; the other forms are gross and may take a
        // resistance_table.
        {"propulsion.thrust", Kind::number, D::force, "-", -kHuge, kHuge, 0, "",
         "Constant thrust along the ship; give one of thrust, thrust_table, bollard_pull, power, "
         "hold_speed.",
         [](Case& c, G&, const Value& v) { c.propulsion.thrust = number(v); }},
        {"propulsion.thrust_table", Kind::curve, D::force, "-", -kHuge, kHuge, 0, "",
         "Rows [U, T]: thrust at speed U [m/s] through the water, linear between rows.",
         [](Case& c, G&, const Value& v) {
             c.propulsion.thrust_table = std::get<std::vector<std::pair<double, double>>>(v);
         }},
        {"propulsion.bollard_pull", Kind::number, D::force, "-", 1e-9, kHuge, 0, "",
         "Net thrust T (1 - U/(3 U_ow) - 2/3 (U/U_ow)^2) from this pull T and open_water_speed "
         "U_ow. T is net: open-water resistance is already subtracted.",
         [](Case& c, G&, const Value& v) { c.propulsion.bollard_pull = number(v); }},
        {"propulsion.power", Kind::number, D::power, "-", 1e-9, kHuge, 0, "",
         "Delivered power, for a bollard pull of K (P D)^(2/3) with propeller_diameter D; in place "
         "of bollard_pull.",
         [](Case& c, G&, const Value& v) { c.propulsion.power = number(v); }},
        {"propulsion.propeller_diameter", Kind::number, D::length, "-", 1e-6, 100, 0, "",
         "With propulsion.power; with bollard_pull or hold_speed for the power that the thrust "
         "takes.",
         [](Case& c, G&, const Value& v) { c.propulsion.propeller_diameter = number(v); }},
        {"propulsion.screws", Kind::integer, D::none, "1", 1, 3, 0, "",
         "Number of propellers, with propulsion.propeller_diameter.",
         [](Case& c, G&, const Value& v) { c.propulsion.screws = integer(v); }},
        {"propulsion.open_water_speed", Kind::number, D::speed, "-", 1e-6, 50, 0, "",
         "Speed at which the net thrust is zero, with bollard_pull or power; with hold_speed for "
         "the power that the thrust takes.",
         [](Case& c, G&, const Value& v) { c.propulsion.open_water_speed = number(v); }},
        {"propulsion.hold_speed", Kind::number, D::speed, "-", -50, 50, 0, "",
         "Speed that the thrust is steered to hold: the thrust is a result.",
         [](Case& c, G&, const Value& v) { c.propulsion.hold_speed = number(v); }},
        {"propulsion.heading", Kind::choice, D::none, "\"free\"", 0, 0, 0, kHeadings,
         "Of a ship free in yaw. free: forces alone turn it; hold: it is steered back to its "
         "heading.",
         [](Case& c, G&, const Value& v) {
             c.propulsion.hold_heading = place_in(text(v), kHeadings) == 1;
         }},
        {"propulsion.resistance_table", Kind::curve, D::force, "-", -kHuge, kHuge, 0, "",
         "Rows [U, R]: resistance in open water at speed U [m/s], where the thrust is not net.",
         [](Case& c, G&, const Value& v) {
             c.propulsion.resistance_table = std::get<std::vector<std::pair<double, double>>>(v);
         }},
    };
}

std::vector<CaseKey> line_keys() {
    return {
        // tow and mooring are springs in world axes, zero by default
        {"tow.point", Kind::vector, D::length, "[0.0, 0.0, 0.0]", -1e4, 1e4, 3, "",
         "Where the ship is towed, in the hull mesh's axes; the carriage moves at hull.speed.",
         [](Case& c, G&, const Value& v) { c.tow.point = vector3(v); }},
        {"tow.stiffness", Kind::number, D::none, "0.0", 0, kHuge, 0, "",
         "Stiffness of the level spring between carriage and ship [N/m]; 0: no tow.",
         [](Case& c, G&, const Value& v) { c.tow.stiffness = number(v); }},
        {"tow.damping", Kind::number, D::none, "0.0", 0, kHuge, 0, "",
         "Damping coefficient of the damper beside the spring [N s/m].",
         [](Case& c, G&, const Value& v) { c.tow.damping = number(v); }},
        {"mooring.stiffness", Kind::vector, D::none, "[0.0, 0.0, 0.0, 0.0, 0.0, 0.0]", 0, kHuge, 6,
         "", "Stiffness in surge to yaw about the pose at the start, world axes [N/m, N m/rad].",
         [](Case& c, G&, const Value& v) { c.mooring.stiffness = vector6(v); }},
        {"mooring.pretension", Kind::vector, D::none, "[0.0, 0.0, 0.0, 0.0, 0.0, 0.0]", -kHuge,
         kHuge, 6, "", "Force and moment of the mooring on the ship in that pose [N, N m].",
         [](Case& c, G&, const Value& v) { c.mooring.pretension = vector6(v); }},
    };
}

}  // namespace

std::vector<CaseKey> ship_keys() {
    std::vector<CaseKey> all = body_keys();
    for (const auto& part : {propulsion_keys(), line_keys()})
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace ice
