// SPDX-License-Identifier: GPL-3.0-or-later
// The sheet and its slots as a run begins.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/error.hpp"
#include "solver/bending/breaking_load.hpp"
#include "solver/live_edge/edge_plan.hpp"
#include "solver/live_edge/slot_shapes.hpp"
#include "solver/live_edge/strip.hpp"
#include "solver/scene/build_scene.hpp"

namespace ice {

namespace {

using Box = Eigen::AlignedBox2d;

// The box in which there are tiles and pieces: so far ahead of the hull, in radii of a crack at
// rest [-], and so far astern, in the hull's lengths [-]. A larger box has more bodies and more
// slots. With a shorter one ahead, cracks reach ice without tiles; with a shorter one astern,
// pieces leave the scene that may still touch the hull.
constexpr double kAhead = 2.0, kAstern = 0.5;

// Share of half a disc that a piece has, at least [-], when slots are counted. Less makes more
// slots, which take memory only; with more, pieces leave the scene early for want of a slot.
constexpr double kCover = 0.25;

// Slots above which a sheet is refused [-], as many as a group of floes may have. A larger bound
// lets a modulus in a wrong unit fill the memory; a smaller one refuses long runs in thin ice.
constexpr double kMostSlots = 1e5;
// Area of half a disc over its radius squared [-], pi / 2 rounded: the number of slots depends on
// these digits.
constexpr double kHalfDisc = 1.57;
// Slots for tiles: so many per radius of a crack at rest, along the box and across it [-]. More
// take memory only; with fewer, pieces leave the scene early, and at last a tile has no slot, which
// ends the run.
constexpr double kTilesAlong = 6.0, kTilesAcross = 4.0;

// Weight of level_ice.seed beside simulation.seed in the seed of the cracks' scatter [-]: larger
// than simulation.seed mostly is, so that two pairs of seeds rarely give the same sum. Another one
// gives other random radii of the same law.
constexpr std::uint64_t kSeedWeight = 1000003;

std::int32_t add_group(Case& p, Hold hold) {
    FloeGroup group;
    group.pattern = Pattern::single;
    group.hold = hold;
    p.floes.push_back(group);
    return static_cast<std::int32_t>(p.floes.size()) - 1;
}

}  // namespace

void LiveEdge::set_up(const Scene& scene, const Case& p) {
    const LevelIce& ice = p.level_ice;
    is_strip_ = p.dimension == 2;
    thickness_ = ice.thickness;
    gap_ = ice.gap;
    const IcePlate plate = plate_of(ice.thickness, p);
    length_ = characteristic_length(plate);
    density_ = p.ice_density;
    share_ = p.ice_density / p.water_density;
    extent_ = {Vec2(ice.extent[0], ice.extent[2]), Vec2(ice.extent[1], ice.extent[3])};
    const std::uint64_t seed =
        static_cast<std::uint64_t>(ice.seed) * kSeedWeight + static_cast<std::uint64_t>(p.seed);
    law_ = {ice.length_factor, ice.speed_factor, ice.scatter, seed};
    if (is_strip_) {
        // (30a) is (30) with C_l l = pi / (4 lambda), the length of a beam, and C_v = 0
        extent_ = strip_extent(ice.extent[0], ice.extent[1]);
        law_.length_factor = beam_breaking_length(plate) / length_;
        law_.speed_factor = 0.0;
    }
    radius_ = crack_size({law_.length_factor}, length_, 0.0, 0);
    drift_ = Vec2(p.drift_velocity[0], p.drift_velocity[1]);
    ahead_ = kAhead * radius_;
    astern_ = kAstern * scene.shapes[0].box.sizes().x();
}

void LiveEdge::add_slots(Scene& scene, const Case& p) {
    // Slots for the pieces, each of a share of a half disc, and for the tiles along the channel's
    // sides and ends that the hull can reach.
    const Vec2 size = reach(scene).sizes();
    const double pieces = size.x() * size.y() / (kCover * kHalfDisc * radius_ * radius_);
    const double tiles = kTilesAlong * size.x() / radius_ + kTilesAcross * size.y() / radius_;
    if (pieces + tiles > kMostSlots)
        throw bad_input(
            p.file.string() + ": level_ice.extent",
            fmt::format("up to {:.2g} pieces at a time would break off near the hull, with cracks "
                        "{:.3g} m from the edge; {:g} are the most",
                        pieces + tiles, radius_, kMostSlots),
            "check bending.elastic_modulus and level_ice.thickness, or narrow level_ice.extent");
    const double half = 0.5 * thickness_;
    const Loop square = loop_of(Box(Vec2(-half, -half), Vec2(half, half)));
    if (std::optional<Shape> shape = shape_of(square, prism_spec(p), kind_of(true)))
        empty_ = std::move(*shape);
    else
        throw bad_input(
            p.file.string() + ": level_ice.spacing",
            "no contact sphere fits into ice of that thickness",
            fmt::format("give a spacing of at most half the thickness, {:.3g} m", half));
    const double height = (0.5 - share_) * thickness_;
    first_ = scene.bodies.size();
    slots_.resize(static_cast<std::size_t>(std::ceil(pieces + tiles)));
    // Each slot is a body with a shape of its own from the start: the number of bodies is
    // constant, and lists and checkpoints need no new rows.
    for (std::size_t k = 0; k < slots_.size(); ++k) {
        scene.shapes.push_back(empty_);
        FloeStart start;
        start.position = Vec3(parked_at(extent_, thickness_, k).x(), 0.0, height);
        start.hold = Hold::always;
        start.velocity.head<2>() = drift_;
        add_floe(scene, static_cast<std::int32_t>(scene.shapes.size()) - 1, density_, start,
                 tile_group_);
    }
    scene.bodies.breaking_load.resize(scene.bodies.size(), kNever);
}

// Cracks have to be in the sheet, and gaps have to leave ice between them.
void LiveEdge::check_cracks(const Case& p) const {
    const Vec2 size = extent_.sizes();
    const double room = is_strip_ ? size.x() : size.minCoeff();
    if (radius_ > room)
        throw bad_input(p.file.string() + ": level_ice",
                        fmt::format("cracks {:.3g} m from the load are longer than the sheet, "
                                    "which is {:.3g} m {}",
                                    radius_, room, room == size.x() ? "long" : "broad"),
                        is_strip_
                            ? "make level_ice.extent longer, or check bending.elastic_modulus"
                            : "make level_ice.extent larger, or check level_ice.length_factor "
                              "and bending.elastic_modulus");
    // Half a gap is cut off all sides of a body: of a strip's shortest piece a piece must be left,
    // of a whole cell a tile that holds a sphere.
    const double whole = is_strip_ ? radius_ * (1.0 - law_.scatter) : radius_;
    const double longest_gap =
        whole - (is_strip_ ? kSmallestPiece : 2.0 * kLeastHalfBreadth) * thickness_;
    if (longest_gap <= 0.0)
        throw bad_input(p.file.string() + ": level_ice",
                        fmt::format("cracks {:.3g} m from the load leave no piece of ice {:.3g} m "
                                    "thick that holds a contact sphere",
                                    radius_, thickness_),
                        is_strip_ ? "check bending.elastic_modulus and level_ice.scatter"
                                  : "check bending.elastic_modulus and level_ice.length_factor");
    if (gap_ > longest_gap)
        throw bad_input(p.file.string() + ": level_ice.gap",
                        fmt::format("{:.3g} m leave no ice of {} that are {:.3g} m long", gap_,
                                    is_strip_ ? "pieces" : "the parts of the edge", whole),
                        fmt::format("give at most {:.3g} m", longest_gap));
}

void LiveEdge::begin(Scene& scene, Case& p) {
    set_up(scene, p);
    const std::vector<Loop> hull = hull_in_ice(scene);
    if (hull.empty())
        throw bad_input(p.file.string() + ": level_ice",
                        "the hull does not reach the height of the ice",
                        "change hull.draught or level_ice.thickness");
    const double least = kSmallestPiece * thickness_;
    sheet_ = IceSheet(extent_, is_strip_ ? std::sqrt(least) : least);  // as long, 1 m broad
    const IceSheet whole = sheet_;
    // the hull lies in the sheet from the start: its own place is taken out
    for (const Loop& loop : hull) gone_.crushed += sheet_.take(loop);
    if (is_strip_)  // ice behind the bow has no edge that could be met
        for (const Loop& loop : hull)
            for (const Vec2& corner : loop) drop_behind(corner.x());
    keep_lost(whole, -kNever);
    piece_group_ = add_group(p, Hold::until_bent);
    tile_group_ = add_group(p, Hold::always);
    add_slots(scene, p);
    check_cracks(p);
    scene.start = {extent_, true, true};
    looked_at_ = laid_at_ = ship_in_ice(scene);
    Plan plan;
    lay_tiles(scene, plan);
    fill(p, plan);
    put(scene, 0.0, plan);
}

}  // namespace ice
