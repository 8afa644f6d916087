// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/case/check_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/case/check_ship.hpp"

namespace ice {

namespace {

// Steps of a run at most [-]: at a millisecond each a day. More is a slip in time_step or duration.
constexpr double kMostSteps = 1e8;

// Spacing of contact spheres above which a sheet is refused, in thicknesses [-]. In 0.2 m of ice
// the mean of a 60 m ship was 41 kN with 0.7, 38 with 1, 52 with 1.5 and 153 with 2.5 thicknesses.
constexpr double kWidestInIce = 1.5;

// Density below which water is a slip in a case with a sheet [kg/m3]: ice is 850 and more. It
// decides which of two keys a complaint names.
constexpr double kLightestIce = 850.0;

// 2D is motion in the plane y = 0: nothing may lean or move out of it
template <class Wrong>
void check_plane(const FloeGroup& group, const Wrong& wrong) {
    const std::string out = "leaves the plane y = 0 of a 2D case";
    if (group.count[1] != 1) wrong("count", "has more than one row along y in a 2D case");
    if (group.position.y() != 0.0) wrong("position", out);
    if (group.velocity.y() != 0.0) wrong("velocity", out);
    if (group.orientation.x() != 0.0 || group.orientation.z() != 0.0) wrong("orientation", out);
    if (group.angular_velocity.x() != 0.0 || group.angular_velocity.z() != 0.0)
        wrong("angular_velocity", out);
}

// Keys of one [[floes]] table against each other. @param g  from 0; texts count from 1
void check_group(FloeGroup& group, std::size_t g, int dimension, const Values& values,
                 const Complaints& complaints) {
    const auto label = [&](const char* key) { return fmt::format("floes.{}.{}", g, key); };
    const auto wrong = [&](const char* key, const std::string& what) {
        complaints.add_at(label(key), fmt::format("floes.{}.{} {}", g + 1, key, what));
    };
    // a 2D set is a section, and fields are filled in 3D
    if (group.pattern == Pattern::file && dimension == 2)
        wrong("pattern", "= \"file\" is for cases of dimension 3");
    if (group.pattern == Pattern::single && !values.contains(label("position")))
        wrong("position", "is missing: pattern \"single\" needs it");
    if (group.orientation.norm() < 1e-6)
        wrong("orientation", "is zero");
    else
        group.orientation.normalize();
    const bool moves = !group.velocity.isZero(0.0) || !group.angular_velocity.isZero(0.0);
    if (moves && group.hold != Hold::never)
        wrong("velocity", "is given, but a held floe does not move; set hold = \"never\"");
    if (dimension == 2) check_plane(group, wrong);
}

// What ice held until it bends needs. Crushing bounds the load: F of (26) against rigid ice is not
// finite. l of (28) grows without bound as g goes to zero. Kashtelyan's formula has an opening
// angle, which a section has not.
void check_bending(const Case& checked, std::size_t groups, const Complaints& complaints) {
    const auto check = [&](const std::string& label, const std::string& what) {
        const auto wrong = [&](const std::string& why) {
            complaints.add_at(label, what + " " + why);
        };
        if (checked.contact.is_rigid())
            wrong(
                "needs a finite contact.crushing_pressure: the force of the ship on rigid ice "
                "that is held has no value; 1 MPa is the default in 3D");
        if (checked.gravity == 0.0)
            wrong("needs environment.gravity above 0: water without weight bears no ice");
        if (checked.dimension == 2 && checked.bending.model == BendingModel::kashtelyan)
            complaints.add_at("bending.model",
                              "bending.model = \"kashtelyan\" is for cases of dimension 3; in 2D "
                              "ice is a beam: use \"wedge\"");
    };
    // the defaults stand among the values: a number that has no effect is one that is not the
    // default
    const auto of_wedge = [&](const std::string& key, bool given, const std::string& takes) {
        if (given) complaints.add_at(key, key + " is given, but " + takes + ": leave it out");
    };
    if (checked.has_bending()) {
        const BendingLaw& law = checked.bending;
        const bool is_beam = checked.dimension == 2;
        of_wedge("bending.load_length",
                 law.load_length != 0.0 && (is_beam || law.model != BendingModel::wedge),
                 is_beam ? "in 2D the load acts on the end of a beam"
                         : "only bending.model = \"wedge\" takes it");
        of_wedge("bending.opening_angle", is_beam && !std::isnan(law.opening_angle),
                 "in 2D ice is a beam, which has no angle");
        if (law.factor == 0.0)
            complaints.add_at("bending.factor",
                              "bending.factor = 0: ice without strength would break by itself; "
                              "give a factor above 0");
    }
    // floes laid beforehand, and the sheet of [level_ice], bend by the same laws
    for (std::size_t g = 0; g < groups; ++g)
        if (checked.floes[g].hold == Hold::until_bent)
            check(fmt::format("floes.{}.hold", g),
                  fmt::format("floes.{}.hold = \"until-bent\"", g + 1));
    if (checked.has_level_ice()) check("level_ice.thickness", "level_ice.thickness");
}

// A sheet has to float and to have an area; in 2D pieces follow from the beam, (30a).
void check_level_ice(const Case& checked, const Complaints& complaints) {
    if (!checked.has_level_ice()) return;
    const auto& [from, to, starboard, port] = checked.level_ice.extent;
    // the defaults stand among the values, so a default that was given is not seen
    const auto is_given = [&](const std::string& key, double LevelIce::*value) {
        if (checked.dimension == 2 && checked.level_ice.*value != LevelIce{}.*value)
            complaints.add_at(key, key +
                                       " is for cases of dimension 3; in 2D the length of a piece "
                                       "is that of a beam: leave it out");
    };
    is_given("level_ice.length_factor", &LevelIce::length_factor);
    is_given("level_ice.speed_factor", &LevelIce::speed_factor);
    if (!(from < to) || (checked.dimension == 3 && !(starboard < port)))
        complaints.add_at("level_ice.extent",
                          "level_ice.extent is empty: give smallest and largest x, then smallest "
                          "and largest y");
    if (checked.level_ice.spacing > kWidestInIce * checked.level_ice.thickness)
        complaints.add_at(
            "level_ice.spacing",
            fmt::format("level_ice.spacing = {:g} m is more than {:g} thicknesses of the ice, and "
                        "the resistance would be a multiple of the true one: leave it out for "
                        "{:.3g} m",
                        checked.level_ice.spacing, kWidestInIce,
                        kLevelIceSpacing * checked.level_ice.thickness));
    // as heavy as water it would sink, and the sheet's height comes from the share that floats
    if (checked.ice_density >= checked.water_density) {
        // water lighter than any ice is the slip, most likely t/m3
        const bool water = checked.water_density < kLightestIce;
        complaints.add_at(
            water ? "environment.water_density" : "ice.density",
            fmt::format("ice.density = {:g} kg/m3 is not below environment.water_density = {:g} "
                        "kg/m3: the sheet has no floating equilibrium{}",
                        checked.ice_density, checked.water_density,
                        water && checked.water_density >= 1.0 && checked.water_density < 2.0
                            ? fmt::format("; if {0:g} t/m3 is meant, write \"{0:g} t/m3\"",
                                          checked.water_density)
                            : ""));
    }
}

}  // namespace

void check_case(Case& checked, std::size_t groups, const Values& values,
                const Complaints& complaints) {
    // All complaints at once, in the order of the tables in a case: a user mends a case in one go.
    check_ship(checked, values, complaints);
    for (std::size_t g = 0; g < groups; ++g)
        check_group(checked.floes[g], g, checked.dimension, values, complaints);
    take_drift(checked, groups, values, complaints);
    check_bending(checked, groups, complaints);
    check_level_ice(checked, complaints);
    if (checked.average_from >= checked.duration)
        complaints.add_at("output.average_from",
                          "output.average_from is not before the end (simulation.duration)");
    if (checked.time_step > checked.duration)
        complaints.add_at("simulation.time_step",
                          "simulation.time_step is longer than simulation.duration");
    if (checked.duration / checked.time_step > kMostSteps)
        complaints.add_at(
            "simulation.time_step",
            fmt::format("simulation.duration / time_step needs more than {:g} steps", kMostSteps));
    if (checked.flow_pressure && checked.flow == FlowModel::none)
        complaints.add_at("flow.pressure",
                          "flow.pressure needs a flow: flow.model = \"double-body\" or \"file\"");
    if (checked.dimension == 2 && checked.floes_move_water)
        complaints.add_at("flow.added_mass",
                          "flow.added_mass is computed in 3D only; leave it out of a 2D case");
    if (checked.dimension == 2 && checked.current[1] != 0.0)
        complaints.add_at("flow.current", "flow.current leaves the plane y = 0 of a 2D case");
    // a floe tracked twice would have two histories of one name
    std::vector<int> track = checked.track;
    std::sort(track.begin(), track.end());
    const auto twice = std::adjacent_find(track.begin(), track.end());
    if (twice != track.end())
        complaints.add_at("output.track", fmt::format("output.track names floe {} twice", *twice));
}

}  // namespace ice
