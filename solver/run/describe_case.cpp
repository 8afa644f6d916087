// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/run/describe_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/base/units.hpp"
#include "common/formats/spheres_file.hpp"
#include "solver/bending/breaking_load.hpp"
#include "solver/record/measure_particulars.hpp"
#include "solver/run/check_course.hpp"
#include "solver/scene/ice_extent.hpp"

namespace ice {

namespace {

// Lines of one subject each, with the numbers in which a wrong unit or draught shows at a glance.
std::string ship_line(const World& w, const ShipParticulars& ship) {
    const Shape& hull = w.scene.shapes[0];
    std::string out = fmt::format("  ship       {:.4g} m long", ship.length);
    if (w.scene.dimension == 3) out += fmt::format(", {:.4g} m broad", ship.breadth);
    out += fmt::format(", draught {:.4g} m of {:.4g} m depth", ship.draught,
                       hull.mesh.vertices.empty() ? 0.0 : box_of(w.scene, kShip).sizes().z());
    if (w.scene.dimension == 3)
        out += fmt::format(", displacement {:.4g} t", 1e-3 * ship.displacement);
    if (std::isfinite(ship.stem_angle_deg))
        out += fmt::format(", stem {:.0f} deg, half entrance {:.0f} deg", ship.stem_angle_deg,
                           ship.entrance_angle_deg);
    else if (w.scene.dimension == 3)  // as of a hull whose stern points ahead
        out += ", no stem angle: its forward end is blunt";
    return out;
}

// A free ship: its free motions and its equilibrium.
std::string motion_line(const World& w) {
    if (!w.ship.is_free()) return {};
    constexpr const char* kNames[] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
    const ShipRig& rig = w.ship.rig();
    std::vector<std::string> free;
    for (std::size_t k = 0; k < kFreedoms; ++k)
        if (rig.body.free[k]) free.emplace_back(kNames[k]);
    std::string out =
        fmt::format("\n  free       {}: {:.4g} t", fmt::join(free, ", "), 1e-3 * rig.body.mass);
    if (rig.body.coupling > 0.0)
        out += fmt::format(
            "; ship.matrix couples motions by up to {:.2g} of their masses, which is left out",
            rig.body.coupling);
    if (!rig.body.floats()) return out;
    const Equilibrium& e = rig.equilibrium;
    out += fmt::format(" floats with {:.4g} t displaced, trim {:.3g} deg by the bow",
                       // + 0.0: no "-0" in the text
                       1e-3 * w.parameters.water_density * e.volume, e.angles[1] / kDegree + 0.0);
    if (w.scene.dimension == 3)
        out += fmt::format(", heel {:.3g} deg, GM {:.4g} m", e.angles[0] / kDegree + 0.0,
                           e.gm_transverse);
    return out + fmt::format(", longitudinal GM {:.4g} m", e.gm_longitudinal);
}

// Level ice has no floes yet; its line has the size of cracks, by which a wrong strength shows.
std::string ice_line(const World& w, const IceParticulars& ice) {
    if (w.edge.has_sheet()) {
        const auto& extent = w.parameters.level_ice.extent;
        if (w.edge.is_strip())
            return fmt::format(
                "  ice        level, {:.3g} m thick, x from {:g} to {:g} m; cracks {:.3g} m from "
                "the tip, under {:.3g} kN/m",
                w.edge.thickness(), extent[0], extent[1], w.edge.radius(),
                1e-3 * breaking_load(0.0, w.edge.thickness(), w.parameters));
        return fmt::format(
            "  ice        level, {:.3g} m thick, x from {:g} to {:g} m, y from {:g} "
            "to {:g} m; cracks {:.3g} m from the load at rest",
            w.edge.thickness(), extent[0], extent[1], extent[2], extent[3], w.edge.radius());
    }
    std::string out = fmt::format("  ice        {} floes", ice.floes);
    // of no loose floes there is no size
    if (ice.floes > 0)
        out += fmt::format(" of {:.3g} to {:.3g} m", ice.floe_size_min, ice.floe_size_max);
    out += fmt::format(", {:.3g} m thick", ice.thickness);
    if (std::isfinite(ice.concentration))
        out += fmt::format(", cover {:.0f} %", 100.0 * ice.concentration);
    // bodies that are no loose floes, without the ship
    const auto fixed = static_cast<std::int64_t>(w.scene.bodies.size()) - 1 - ice.floes;
    if (fixed > 0) out += fmt::format("; {} pieces of unbroken ice", fixed);
    return out + fmt::format("; held: {}", release_rule_in_words(ice));
}

std::string distance_text(double distance) {
    return std::isfinite(distance) ? fmt::format("{:.3g} m", distance) : "none";
}

std::string clearance_line(const World& w, const Course& course) {
    // a sheet is unbroken ice and gives way
    if (w.edge.has_sheet())
        return fmt::format("\n  clearance  {} to the level ice", distance_text(course.clearance));
    const std::string first = distance_text(course.clearance);
    if (w.parameters.ship.free[surge])
        return fmt::format("\n  clearance  {} to the first ice", first);
    return fmt::format("\n  clearance  {} to the first ice, {} to unbroken ice", first,
                       distance_text(course.clearance_fixed));
}

// Duration and speed as lengths of the ship, since a mean needs some of these.
std::string course_line(const World& w, const ShipParticulars& ship, const Course& course) {
    const Case& p = w.parameters;
    // The distance of a ship that surges is a result of the run.
    if (p.ship.free[surge])
        return fmt::format(
            "  course     from {:g} m/s as thrust and ice make it, {} steps of {:g} s; averaged "
            "from {:g} s{}",
            p.ship_speed(0.0), std::llround(p.duration / p.time_step), p.time_step, p.average_from,
            clearance_line(w, course));
    const TravelParticulars travel = measure_travel(p, ship, p.duration);
    return fmt::format(
        "  course     {:.4g} m, {:.2f} ship lengths, in {} steps of {:g} s; averaged over {}, "
        "from {:g} s{}",
        travel.distance, travel.lengths, std::llround(p.duration / p.time_step), p.time_step,
        averaged_text(travel.averaged_lengths), p.average_from, clearance_line(w, course));
}

std::string spheres_line(const World& w) {
    const Shape& hull = w.scene.shapes[0];
    // The first ice shape represents all: a field's shapes share radius and spacing.
    std::string out = fmt::format("  spheres    hull {:.3g} m, {:.3g} m apart", hull.largest_radius,
                                  hull.spacing);
    if (w.scene.shapes.size() > 1)
        out += fmt::format("; ice {:.3g} m, {:.3g} m apart", w.scene.shapes[1].largest_radius,
                           w.scene.shapes[1].spacing);
    return out;
}

// The line of spherize's certificate on the hull's ice belt: what part of it has no spheres. None
// for a hull made in code.
std::string belt_line(const World& w) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(w.parameters.hull_spheres, none)) return {};  // made here
    const std::string belt = read_ice_belt(w.parameters.hull_spheres);
    return belt.empty() ? belt : "\n  ice belt   " + belt;
}

std::string pressure_text(double pressure) {
    return std::isfinite(pressure) ? fmt::format("{:.3g} MPa", 1e-6 * pressure) : "rigid";
}

}  // namespace

std::string describe_case(const World& w) {
    const ShipParticulars ship = measure_ship(w.scene, w.parameters);
    const Case& p = w.parameters;
    return fmt::format(
        "{}{}\n{}\n{}\n{}{}\n  contact    crushing {}, friction {:g} on the hull and {:g} between "
        "floes",
        ship_line(w, ship), motion_line(w), ice_line(w, measure_ice(w.scene, p)),
        course_line(w, ship, measure_course(w)), spheres_line(w), belt_line(w),
        pressure_text(p.contact.crushing_pressure), p.contact.friction_ship_ice,
        p.contact.friction_ice_ice);
}

std::string describe_rules(const Summary& s) {
    return fmt::format("floes held: {}; crushing {}; averaged over {}",
                       release_rule_in_words(s.ice), pressure_text(s.ice.crushing_pressure),
                       averaged_text(s.travel.averaged_lengths));
}

}  // namespace ice
