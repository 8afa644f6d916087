// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/step/describe_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "common/formats/spheres_file.hpp"
#include "solver/record/particulars.hpp"
#include "solver/scene/ice_extent.hpp"
#include "solver/step/check_course.hpp"

namespace ice {

namespace {

std::string ship_line(const World& w, const ShipParticulars& ship) {
    const Shape& hull = w.scene.shapes[0];
    std::string out = fmt::format("  ship       {:.4g} m long", ship.length);
    if (w.scene.dimension == 3) out += fmt::format(", {:.4g} m broad", ship.breadth);
    out += fmt::format(", draught {:.4g} m of {:.4g} m depth", ship.draught,
                       hull.mesh.vertices.empty() ? 0.0 : box_of(w.scene, kShip).sizes().z());
    if (w.scene.dimension == 3)
        out += fmt::format(", displacement {:.4g} t", 1e-3 * ship.displacement);
    if (std::isfinite(ship.stem_angle_deg))
        out += fmt::format(", stem {:.0f} deg, entrance {:.0f} deg", ship.stem_angle_deg,
                           ship.entrance_angle_deg);
    return out;
}

std::string ice_line(const World& w, const IceParticulars& ice) {
    std::string out = fmt::format("  ice        {} floes", ice.floes);
    if (ice.floes > 0)
        out += fmt::format(" of {:.3g} to {:.3g} m", ice.floe_size_min, ice.floe_size_max);
    out += fmt::format(", {:.3g} m thick", ice.thickness);
    if (std::isfinite(ice.concentration))
        out += fmt::format(", cover {:.0f} %", 100.0 * ice.concentration);
    const auto fixed = static_cast<std::int64_t>(w.scene.bodies.size()) - 1 - ice.floes;
    if (fixed > 0) out += fmt::format("; {} pieces of unbroken ice", fixed);
    return out + fmt::format("; held: {}", fmt::join(ice.hold, ", "));
}

std::string distance_text(double distance) {
    return std::isfinite(distance) ? fmt::format("{:.3g} m", distance) : "none";
}

std::string course_line(const World& w, const ShipParticulars& ship, const Course& course) {
    const Case& p = w.parameters;
    const TravelParticulars travel = measure_travel(p, ship, p.duration);
    return fmt::format(
        "  course     {:.4g} m, {:.2f} ship lengths, in {} steps of {:g} s; averaged over {}, "
        "from {:g} s\n"
        "  clearance  {} to the first ice, {} to unbroken ice",
        travel.distance, travel.lengths, std::llround(p.duration / p.time_step), p.time_step,
        averaged_text(travel.averaged_lengths), p.average_from, distance_text(course.clearance),
        distance_text(course.clearance_fixed));
}

std::string spheres_line(const World& w) {
    const Shape& hull = w.scene.shapes[0];
    std::string out = fmt::format("  spheres    hull {:.3g} m, {:.3g} m apart", hull.largest_radius,
                                  hull.spacing);
    if (w.scene.shapes.size() > 1)
        out += fmt::format("; ice {:.3g} m, {:.3g} m apart", w.scene.shapes[1].largest_radius,
                           w.scene.shapes[1].spacing);
    return out;
}

// What spherize's certificate says of the hull where the ice meets it.
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
        "{}\n{}\n{}\n{}{}\n  contact    crushing {}, friction {:g} on the hull and {:g} between "
        "floes",
        ship_line(w, ship), ice_line(w, measure_ice(w.scene, p)),
        course_line(w, ship, measure_course(w)), spheres_line(w), belt_line(w),
        pressure_text(p.crushing_pressure), p.friction_ship_ice, p.friction_ice_ice);
}

std::string describe_rules(const Summary& s) {
    return fmt::format("floes held: {}; crushing {}; averaged over {}", fmt::join(s.ice.hold, ", "),
                       pressure_text(s.ice.crushing_pressure),
                       averaged_text(s.travel.averaged_lengths));
}

}  // namespace ice
