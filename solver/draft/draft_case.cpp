// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/draft/draft_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/error.hpp"
#include "common/formats/spheres_file.hpp"
#include "solver/record/measure_particulars.hpp"
#include "solver/run/check_course.hpp"
#include "solver/scene/build_scene.hpp"
#include "solver/scene/ice_extent.hpp"

namespace ice {

namespace {

// Guesses that a drafted case begins with; the user changes them in its text, so that each affects
// the draft alone.

// Density of sea water [kg/m3]. A larger value makes buoyancy and drag larger.
constexpr double kWaterDensity = 1025.0;
// Draught over the hull's depth [-]. A larger value lets more of the hull meet ice and water.
constexpr double kDraughtShare = 0.6;
// Froude number V / sqrt(g L) [-]: 4 kn at 100 m. A larger value makes the ship faster and steps
// shorter; waves, which are not modelled, begin to matter.
constexpr double kFroude = 0.0657;
// Travel after the first ice in ship's lengths [-]. More gives better means and takes longer.
constexpr double kLengths = 2.2;
// Travel in the ice before forces are averaged, in ship's lengths [-]: with 1 floes lie along the
// whole hull. With less the resistance still rises in the averaged time: by 40 % of its mean from
// half a length on (the paper's hull). More leaves less to average.
constexpr double kSettled = 1.0;
// Travel in a step over the smallest radius [-]. A larger value takes fewer steps, and bodies enter
// each other more deeply; a smaller one takes longer.
constexpr double kStepShare = 0.2;
// Travel over the path through the field at most [-]. With 1 and more the hull leaves the ice, a
// smaller value uses less of the field.
constexpr double kFieldShare = 0.95;
// Travel in ship's lengths [-] below which no case is drafted. A larger value refuses more fields,
// a smaller one drafts runs whose means are uncertain.
constexpr double kShortestTravel = 0.1;

// The number rounded to a count of digits.
double rounded(double x, int digits) { return std::stod(fmt::format("{:.{}g}", x, digits)); }

// Rounded down to 1, 2 or 5 of a decade.
double round_step(double x) {
    const double decade = std::pow(10.0, std::floor(std::log10(x)));
    const double lead = x / decade * (1.0 + 1e-12);
    return rounded(decade * (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0), 1);
}

// A case that can build the scene before draught, place and times are known.
Case first_case(const std::filesystem::path& hull, const std::filesystem::path& field) {
    Case p;
    p.file = "--new";
    p.hull_spheres = hull;
    p.water_density = kWaterDensity;
    p.duration = 1.0;
    p.speed_table = {{0.0, 1.0}};
    p.floes.resize(2);
    // the field twice: its loose floes, and its unbroken ice, which is held
    for (FloeGroup& group : p.floes) {
        group.pattern = Pattern::file;
        group.file = field;
        group.hold = Hold::never;
    }
    p.floes[1].unbroken_part = true;
    p.floes[1].hold = Hold::always;
    return p;
}

double smallest_radius(const Scene& scene) {
    double least = std::numeric_limits<double>::infinity();
    for (const Shape& shape : scene.shapes)
        for (const double radius : shape.radius) least = std::min(least, radius);
    return least;
}

// Draught from the mesh: its own water line, or a share of the depth.
void guess_draught(const TriangleMesh& hull, Draft& draft) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : hull.vertices) box.extend(v);
    const double keel = box.min().z(), depth = box.sizes().z();
    // A mesh whose z = 0 lies well within its depth has its water line there; of
    // another one the draught is unknown.
    draft.draught_from_mesh = -keel > 0.05 * depth && -keel < 0.95 * depth;
    draft.draught = rounded(draft.draught_from_mesh ? -keel : kDraughtShare * depth, 3);
}

// Bow before the first ice, on the centre line of the loose floes.
void place_ship(World& w, Draft& draft) {
    Vec3& place = w.scene.bodies.position[kShip];
    const Eigen::AlignedBox3d ship = box_of(w.scene, kShip);
    const Eigen::AlignedBox2d ice = w.scene.start.loose;
    place.y() += ice.center().y() - ship.center().y();
    place.x() += ice.min().x() - ship.max().x() - ship.sizes().x();  // a length before it
    const Course course = measure_course(w);
    if (!std::isfinite(course.clearance))
        throw bad_input("--new", "the ship never meets the field's ice",
                        "use a field with ice at the hull's height, across its centre line");
    const double gap = 2.0 * w.scene.shapes[0].spacing;
    draft.x = std::floor(100.0 * (place.x() + course.clearance - gap)) / 100.0;
    const double step =
        rounded(0.01 * ship.sizes().y(), 1);  // a hundredth of the breadth is exact enough
    draft.y = step * std::round(place.y() / step) + 0.0;  // no -0
    place.x() = draft.x;
    place.y() = draft.y;
}

void plan_course(const World& w, Draft& draft) {
    const ShipParticulars ship = measure_ship(w.scene, w.parameters);
    if (!(ship.length > 0.0))
        throw bad_input("--new", "the hull does not cross the water", "check its mesh");
    const Course course = measure_course(w);
    draft.length = ship.length;
    draft.clearance = course.clearance;
    const double room = kFieldShare * std::min(course.through, course.clearance_fixed);
    // The ice must last for the whole travel: the run ends before the hull leaves the field or
    // reaches ice that cannot move.
    const double travel = std::min(kLengths * ship.length + course.clearance, room);
    if (travel < kShortestTravel * ship.length)
        throw bad_input(
            "--new",
            fmt::format("the field has room for {:.3g} m of travel, {:.2g} of the "
                        "ship's {:.4g} m",
                        room, room / ship.length, ship.length),
            fmt::format("use a field of {:g} ship lengths or more (area.size)", kFieldLengths));
    // one Froude number for ships and models of any scale, too low for waves to matter
    draft.speed = rounded(kFroude * std::sqrt(w.parameters.gravity * ship.length), 2);
    // a share of the smallest radius per step keeps bodies from passing through each other
    draft.time_step = round_step(kStepShare * smallest_radius(w.scene) / draft.speed);
    draft.duration = draft.time_step * std::ceil(travel / (draft.speed * draft.time_step));
    draft.duration = rounded(draft.duration, 6);
    // From a ship length in the ice on. In a short field the averaged part is a ship length all the
    // same, or two thirds of a shorter travel: by then the bow is in the ice.
    const double averaged = std::max(travel - course.clearance - kSettled * ship.length,
                                     std::min(ship.length, travel * 2.0 / 3.0));
    draft.average_from = rounded(draft.duration - averaged / draft.speed, 3);
    draft.lengths = draft.speed * draft.duration / ship.length;
    draft.averaged_lengths = draft.speed * (draft.duration - draft.average_from) / ship.length;
    draft.settled_lengths =
        std::max(0.0, draft.speed * draft.average_from - course.clearance) / ship.length;
}

// Level ice that begins where the field does, long and broad enough for the same travel.
void plan_sheet(const World& w, Draft& draft) {
    const Eigen::AlignedBox3d ship = box_of(w.scene, kShip);
    const double half = 1.5 * ship.sizes().y();
    draft.thickness = rounded(w.scene.shapes[1].box.sizes().z(), 3);
    draft.ice_from = std::floor(10.0 * w.scene.start.loose.min().x()) / 10.0 + 0.0;
    draft.ice_to = std::ceil(ship.max().x() + draft.speed * draft.duration + draft.length / 4.0);
    draft.ice_starboard = std::floor(draft.y - half);
    draft.ice_port = std::ceil(draft.y + half);
}

}  // namespace

Draft draft_case(const std::filesystem::path& hull, const std::filesystem::path& field) {
    Draft draft;
    guess_draught(read_spheres(hull).mesh, draft);
    // water line, clearances and room are measured on a scene with the guessed draught
    World world;
    world.parameters = first_case(hull, field);
    world.parameters.hull_draught = draft.draught;
    world.scene = build_scene(world.parameters);
    place_ship(world, draft);
    plan_course(world, draft);
    plan_sheet(world, draft);
    return draft;
}

}  // namespace ice
