// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/run/lay_level_ice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "common/base/error.hpp"
#include "common/base/interpolate.hpp"
#include "common/base/part_file.hpp"
#include "common/base/state_hash.hpp"
#include "common/cli/console.hpp"
#include "common/cli/sibling_program.hpp"
#include "common/formats/field_file.hpp"
#include "common/formats/spheres_file.hpp"
#include "solver/bending/ice_plate.hpp"
#include "solver/level_ice/break_pattern.hpp"
#include "solver/scene/place_hull.hpp"

namespace ice {

namespace {

namespace fs = std::filesystem;

// Of the fields' content: to be raised where equal cases get other ice, so that old files are not
// read.
constexpr std::uint64_t kSheetFields = 3;

constexpr double kTileLength = 4.0;   // of the ice that never moves, in radii at rest
constexpr double kSheetMargin = 2.0;  // breadth of it beyond the pieces, likewise
constexpr double kSmallest = 0.5;     // piece, in thicknesses
constexpr double kHolds = 0.26;  // thicknesses inwards from a piece's sides, where something is
constexpr double kClear = 0.25;  // of the sides, of points between cracks
constexpr int kTimes = 1000;     // at which the course is looked at

// How fast the ship is where: (distance gone [m], speed [m/s]).
std::vector<std::pair<double, double>> course_of(const Case& p) {
    std::vector<std::pair<double, double>> course;
    for (int k = 0; k <= kTimes; ++k) {
        const double time = p.duration * k / kTimes, gone = p.ship_travel(0.0, time);
        if (course.empty() || gone > course.back().first)
            course.emplace_back(gone, std::abs(p.ship_speed(time)));
    }
    return course;
}

double length_of_plate(const Case& p) {
    return characteristic_length({p.level_ice.thickness, p.bending.flexural_strength,
                                  p.bending.elastic_modulus, p.bending.poisson_ratio,
                                  p.water_density * p.gravity});
}

Passage passage_of(const Case& p, const TriangleMesh& hull) {
    const LevelIce& ice = p.level_ice;
    const Vec3 place = hull_place(p, hull);
    const double top = (1.0 - p.ice_density / p.water_density) * ice.thickness;
    Passage passage;
    passage.outline = section_outline(hull, top - place.z());
    for (Vec2& corner : passage.outline) corner += place.head<2>();
    passage.length = length_of_plate(p);
    // what stands between two cracks keeps clear of the ship's sides
    if (passage.outline.size() >= 3)
        passage.outline =
            shrunk(passage.outline, -kClear * ice.length_factor * passage.length, 0.0).at(0);
    passage.law = {
        ice.length_factor, ice.speed_factor, ice.scatter,
        static_cast<std::uint64_t>(ice.seed) * 1000003u + static_cast<std::uint64_t>(p.seed)};
    auto course = course_of(p);
    // pieces lie ready beyond the last place of the ship; a free one may go all the way
    passage.distance = course.back().first + 2.0 * ice.length_factor * passage.length;
    if (p.ship.free[surge] && !passage.outline.empty()) {
        double bow = passage.outline[0].x();
        for (const Vec2& corner : passage.outline) bow = std::max(bow, corner.x());
        passage.distance = std::max(passage.distance, ice.extent[1] - bow);
    }
    passage.speed_at = [course = std::move(course)](double gone) {
        return interpolate(course, gone);
    };
    return passage;
}

std::uint64_t hash_of_passage(const Case& p, const Passage& passage) {
    const LevelIce& ice = p.level_ice;
    StateHash hash;
    hash.add(kSheetFields);
    hash.add(passage.law.seed);
    for (const double value : {ice.thickness, ice.extent[0], ice.extent[1], ice.extent[2],
                               ice.extent[3], ice.spacing, ice.gap, ice.length_factor,
                               ice.speed_factor, ice.scatter, passage.length, passage.distance})
        hash.add(value);
    for (const auto& [gone, speed] : course_of(p)) {
        hash.add(gone);
        hash.add(speed);
    }
    for (const Vec2& corner : passage.outline) {
        hash.add(corner.x());
        hash.add(corner.y());
    }
    return hash.value();
}

// Polygons as a field of floes with spheres, by icefield.
Field fill(const LevelIce& ice, const std::vector<Loop>& loops, const fs::path& stem) {
    const fs::path table = stem.string() + ".csv", specification = stem.string() + ".toml",
                   made = stem.string() + ".h5";
    std::string rows = "floe,x,y\n";
    for (std::size_t k = 0; k < loops.size(); ++k)
        for (const Vec2& p : loops[k]) rows += fmt::format("{},{},{}\n", k + 1, p.x(), p.y());
    write_text_file(table, rows);
    write_text_file(specification,
                    fmt::format("title = \"Level ice\"\npattern = \"polygons\"\n[ice]\n"
                                "thickness = {}\n[spheres]\nspacing = {}\n[floes]\nfile = \"{}\"\n",
                                ice.thickness, ice.spacing, table.filename().string()));
    const auto code = run_sibling("icefield", {"-q", specification.string(), "-o", made.string()});
    if (code != 0)
        throw run_failed("level_ice",
                         code ? fmt::format("icefield ended with code {}", *code)
                              : std::string("icefield does not lie beside icesolve"),
                         fmt::format("see its message above; it reads {}", specification.string()));
    Field field = read_field(made);
    std::error_code ignored;
    for (const fs::path& file : {table, specification, made}) fs::remove(file, ignored);
    return field;
}

// The floes of `other` behind those of `field`, as ice that never moves.
void add_fixed(Field& field, Field other) {
    const auto first = static_cast<std::int32_t>(field.shapes.size());
    for (FieldFloe floe : other.floes) {
        floe.shape += first;
        floe.fixed = true;
        field.floes.push_back(floe);
    }
    for (SphereSet& shape : other.shapes) field.shapes.push_back(std::move(shape));
}

// Loops half a gap smaller, without those that hold no sphere of icefield's: `lost` is their area.
std::vector<Loop> all_shrunk(const std::vector<Loop>& loops, const LevelIce& ice, double smallest,
                             double& lost) {
    std::vector<Loop> out;
    for (const Loop& loop : loops)
        for (Loop& part : shrunk(loop, 0.5 * ice.gap, smallest)) {
            if (shrunk(part, kHolds * ice.thickness, 0.0).empty())
                lost += area_of(part);
            else
                out.push_back(std::move(part));
        }
    return out;
}

// Size of cracks and channel beside what is seen on ships: ranges as later papers print them, not
// read in their sources.
std::string describe_breaking(const BrokenSheet& broken, const Passage& passage, double thickness) {
    CuspLaw mean = passage.law;
    mean.scatter = 0.0;
    const double radius = cusp_radius(mean, passage.length, passage.speed_at(0.0), 0);
    Eigen::AlignedBox2d ship, channel;
    double area = broken.brash;
    for (const Vec2& corner : passage.outline) ship.extend(corner);
    for (const Loop& piece : broken.pieces) {
        area += area_of(piece);
        for (const Vec2& corner : piece) channel.extend(corner);
    }
    return fmt::format(
        "level ice: cracks {:.2g} m from the load, {:.2g} characteristic lengths (ships: 0.1 to "
        "0.4), {:.2g} thicknesses (3 to 10); channel {:.3g} m broad for an outline of {:.3g} m",
        radius, radius / passage.length, radius / thickness, area / channel.sizes().x(),
        ship.sizes().y());
}

void make_field(const Case& p, const Passage& passage, const fs::path& file) {
    const LevelIce& ice = p.level_ice;
    const Eigen::AlignedBox2d extent(Vec2(ice.extent[0], ice.extent[2]),
                                     Vec2(ice.extent[1], ice.extent[3]));
    const double smallest = kSmallest * ice.thickness, radius = ice.length_factor * passage.length;
    say("breaking the level ice along the course");
    BrokenSheet broken = break_sheet(IceSheet(extent, smallest), passage);
    if (broken.pieces.empty())
        throw bad_input(p.file.string() + ": level_ice.extent",
                        "the ship does not reach the ice on its course",
                        "move the ice or the ship, or lengthen simulation.duration");
    const std::vector<Loop> tiles =
        tile_rest(broken.rest, broken.pieces, kSheetMargin * radius, kTileLength * radius);
    const fs::path stem = fs::path(file).replace_extension();
    Field field = fill(ice, all_shrunk(broken.pieces, ice, smallest, broken.brash),
                       stem.string() + ".pieces");
    double kept = 0.0;  // slivers of the sheet that never moves are no brash
    const std::vector<Loop> rest = all_shrunk(tiles, ice, smallest, kept);
    if (!rest.empty()) add_fixed(field, fill(ice, rest, stem.string() + ".rest"));
    write_field(file, field);
    say(fmt::format("level ice: {} pieces, {} of ice that never moves; {:.2g} m2 of brash left out",
                    broken.pieces.size(), rest.size(), broken.brash));
    say(describe_breaking(broken, passage, ice.thickness));
}

}  // namespace

Case with_level_ice(const Case& parameters) {
    if (!parameters.has_level_ice()) return parameters;
    const SphereSet hull = read_spheres(parameters.hull_spheres);
    place_hull(parameters, hull.mesh);  // refuses what does not float
    const Passage passage = passage_of(parameters, hull.mesh);
    if (passage.outline.size() < 3)
        throw bad_input(parameters.file.string() + ": level_ice",
                        "the hull does not reach the height of the ice",
                        "change hull.draught or level_ice.thickness");
    const fs::path file = parameters.hull_spheres.parent_path() /
                          fmt::format("level-ice.{:016x}.h5", hash_of_passage(parameters, passage));
    if (!fs::exists(file)) make_field(parameters, passage, file);
    Case out = parameters;
    FloeGroup pieces;
    pieces.pattern = Pattern::file;
    pieces.file = file;
    pieces.hold = Hold::until_bent;
    out.floes.push_back(pieces);
    pieces.unbroken_part = true;
    pieces.hold = Hold::always;
    out.floes.push_back(pieces);
    return out;
}

}  // namespace ice
