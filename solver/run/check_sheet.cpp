// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/run/check_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.hpp"
#include "common/formats/widest_spacing.hpp"
#include "solver/bending/breaking_load.hpp"
#include "solver/run/sheet_course.hpp"

namespace ice {

namespace {

// Depth of the hull in the ice that is no fault of the case, in thicknesses [-]: at twice
// LiveEdge's kCrushed a run takes crushed ice out of the sheet. A larger value passes ships that
// begin in the ice; a smaller one refuses a stem that touches it.
constexpr double kTouching = 0.25;
// Ice beside the hull, in radii of a crack at rest [-]: with less than the first, cracks at the
// ship's sides reach the sheet's own side, and such ice breaks under smaller loads; the second is
// the advice. In 0.6 m of ice the mean of a ship 14 m broad was 102 kN with 0.3 radii, 140 kN with
// 0.9 and with 2. Only the warning depends on them.
constexpr double kLeastBeside = 0.9, kBeside = 2.0;

// The ice that the run takes out of the hull's place before its first step [m2], in 2D [m].
double ice_in_hull(const World& w) {
    const IceAreas areas = w.edge.areas();
    // behind the bow a strip has no edge that could be met: it is given up as well
    return areas.crushed + (w.edge.is_strip() ? areas.astern : 0.0);
}

double direction_of(const Case& p) { return p.ship_travel(0.0, p.duration) < 0.0 ? -1.0 : 1.0; }

// What the user does with a hull that lies in the ice.
std::string way_out_of_ice(const World& w) {
    const double direction = direction_of(w.parameters);
    const SheetCourse course = measure_sheet_course(w, direction);
    const double x = w.scene.bodies.position[kShip].x() + course.to_clear;
    // rounded away from the ice
    const double clear = direction * std::floor(10.0 * direction * x) / 10.0;
    return fmt::format(
        "move the hull (hull.position): with x = {:g} m its {} lies before the ice; or move "
        "level_ice.extent; --allow-overlap runs it all the same",
        clear, direction > 0.0 ? "bow" : "stern");
}

void check_place(const World& w, bool allow_overlap, std::vector<Warning>& warnings) {
    const double depth = kTouching * w.edge.thickness(), area = ice_in_hull(w);
    const bool strip = w.edge.is_strip();
    if (area <= (strip ? depth : depth * depth)) return;
    const std::string text = fmt::format(
        "the hull lies in the level ice at the start: the run takes {:.3g} {} of the sheet out "
        "before its first step",
        area, strip ? "m" : "m2");
    if (!allow_overlap) throw bad_input(w.parameters.file.string(), text, way_out_of_ice(w));
    // its sides touch no ice until the ship has moved: the averages may begin later
    warnings.push_back({text, false});
}

// Overlaps do not show what wide spacings change: loads that act elsewhere, or on fewer spheres.
void warn_of_ice_spacing(const World& w, std::vector<Warning>& warnings) {
    const Case& p = w.parameters;
    const auto slot = w.scene.bodies.shape[w.edge.first_body()];
    const double h = p.level_ice.thickness;
    const double limit =
        kWidestSpacing * w.scene.shapes[static_cast<std::size_t>(slot)].largest_radius;
    if (p.level_ice.spacing <= limit * (1.0 + kSpacingRounding)) return;
    warnings.push_back(
        {fmt::format(
             "level_ice.spacing = {:.3g} m is {:.2g} times the ice's thickness: above {:.2g} "
             "corners pass between its contact spheres; leave it out for {:.3g} m, or give "
             "at most {:.3g} m",
             p.level_ice.spacing, p.level_ice.spacing / h, limit / h, kLevelIceSpacing * h, limit),
         true});
}

void warn_of_depth(const World& w, std::vector<Warning>& warnings) {
    const double below = 0.5 * w.edge.thickness() - w.edge.height();
    double keel = 0.0;
    const Bodies& b = w.scene.bodies;
    for (const Vec3& v : w.scene.shapes[kShip].mesh.vertices)
        keel = std::min(keel, (b.position[kShip] + b.rotation[kShip] * v).z());
    if (below <= -keel) return;
    warnings.push_back(
        {fmt::format("level_ice.thickness = {:g} m reaches {:.3g} m below the water, and the hull "
                     "{:.3g} m: no piece can pass below the hull; check both and hull.draught",
                     w.edge.thickness(), below, -keel),
         true});
}

void warn_of_breadth(const World& w, std::vector<Warning>& warnings) {
    if (w.edge.is_strip()) return;
    const SheetCourse course = measure_sheet_course(w, direction_of(w.parameters));
    if (course.beside) return;  // of that the course's warnings say more
    const auto& extent = w.parameters.level_ice.extent;
    const double low = course.hull.min().y(), high = course.hull.max().y();
    const double radius = w.edge.radius();
    if (extent[2] <= low - kLeastBeside * radius && extent[3] >= high + kLeastBeside * radius)
        return;
    const bool partly = extent[2] > low || extent[3] < high;
    const std::string why =
        partly ? "part of the hull passes beside the sheet"
               : fmt::format(
                     "cracks {:.3g} m from the load come to the sheet's side, where ice "
                     "breaks under smaller loads",
                     w.edge.radius());
    warnings.push_back(
        {fmt::format("level_ice.extent has ice from y = {:g} to {:g} m, and the hull reaches from "
                     "{:.3g} to {:.3g} m: {}; give it y from {:.3g} to {:.3g} m or more",
                     extent[2], extent[3], low, high, why, std::floor(low - kBeside * radius),
                     std::ceil(high + kBeside * radius)),
         true});
}

}  // namespace

std::vector<Warning> check_sheet(const World& world, bool allow_overlap) {
    std::vector<Warning> warnings;
    if (!world.edge.has_sheet()) return warnings;
    check_place(world, allow_overlap, warnings);
    warn_of_ice_spacing(world, warnings);
    warn_of_depth(world, warnings);
    warn_of_breadth(world, warnings);
    return warnings;
}

std::optional<Warning> warn_of_whole_ice(const World& w) {
    if (!w.edge.has_sheet() || w.edge.broken() > 0) return std::nullopt;
    const double direction = direction_of(w.parameters);
    const SheetCourse course = measure_sheet_course(w, direction);
    // the sheet has drifted since the start
    const double deep = -direction * (course.to_clear + w.time * w.edge.drift().x());
    if (course.beside || deep <= w.edge.radius()) return std::nullopt;
    return Warning{
        fmt::format("no piece broke off, although the ship is {:.3g} m deep in the level ice: the "
                    "loads on the edge stay below its breaking load, {:.4g} {}, and the ship "
                    "crushes its way; check bending.factor, bending.flexural_strength and how "
                    "steep the bow is",
                    deep, 1e-3 * breaking_load(std::numbers::pi, w.edge.thickness(), w.parameters),
                    w.edge.is_strip() ? "kN/m" : "kN at a straight edge"),
        true};
}

}  // namespace ice
