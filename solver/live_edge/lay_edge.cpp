// SPDX-License-Identifier: GPL-3.0-or-later
// Tiles and pieces become bodies.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/base/assert.hpp"
#include "common/base/error.hpp"
#include "common/base/parallel.hpp"
#include "preprocess/field/fill_prism.hpp"
#include "solver/bending/breaking_load.hpp"
#include "solver/live_edge/edge_plan.hpp"
#include "solver/live_edge/edge_tiles.hpp"
#include "solver/live_edge/hull_outlines.hpp"
#include "solver/live_edge/put_ice.hpp"
#include "solver/live_edge/strip.hpp"
#include "solver/scene/added_mass_of_floes.hpp"
#include "solver/scene/build_scene.hpp"

namespace ice {

namespace {

using Box = Eigen::AlignedBox2d;

// Radius of the spheres, in thicknesses [-]: icefield's default. Two of them fill the thickness.
// Smaller gives more spheres to a body, and a longer search; larger ones do not fit.
constexpr double kRadius = 0.25;

// Ice is filled if something is left of its outline this far inwards, in thicknesses [-]: a radius,
// and a little more, so that the sphere does not just touch. Larger makes more brash.
constexpr double kHolds = 0.26;

// The box in which there are tiles and pieces: so far ahead of the hull, in radii of a crack at
// rest, and so far astern, in the hull's lengths. A larger box has more bodies and more slots. With
// a shorter one ahead, cracks reach ice without tiles; with a shorter one astern, pieces leave the
// scene that may still touch the hull.
constexpr double kAhead = 2.0, kAstern = 0.5;

// From the sheet to slots without ice [m]: beyond every neighbour list. Nothing else depends on it.
constexpr double kParked = 1000.0;

// Share of half a disc that a piece has, at least, when slots are counted. Less makes more slots,
// which take memory only; with more, pieces leave the scene early for want of a slot.
constexpr double kCover = 0.25;

// Length of the parts in which the rest of the sheet is drawn, in radii [-]. Only pictures depend
// on it.
constexpr double kRestLength = 8.0;

constexpr double kNever = std::numeric_limits<double>::infinity();

PrismForm prism_form(const Case& p) {
    const LevelIce& ice = p.level_ice;
    const double radius = kRadius * ice.thickness;
    // a corner's disc stands for its radius of both faces: finer discs, finer sections
    return {ice.thickness, 0.0, p.dimension == 2 ? std::min(radius, ice.spacing) : radius,
            ice.spacing, true};
}

// About its centroid; none where no sphere fits, or a corner gets none. An Error here is no fault
// of the case: such ice is brash.
std::optional<Shape> shape_of(const Loop& outline, const PrismForm& form, bool is_strip) {
    Loop centred;
    const Vec2 centre = centroid_of(outline);
    for (const Vec2& p : outline) centred.push_back(p - centre);
    try {
        return build_shape(
            is_strip ? fill_strip(strip_length(outline), form) : fill_prism(centred, form), true);
    } catch (const Error&) {
        return std::nullopt;
    }
}

// Where a slot without ice is: one beside the other, beyond the sheet.
Vec2 parked_at(const Box& sheet, double thickness, std::size_t slot) {
    return {sheet.max().x() + kParked + 2.0 * thickness * static_cast<double>(slot), 0.0};
}

std::int32_t add_group(Case& p, Hold hold) {
    FloeGroup group;
    group.pattern = Pattern::single;
    group.hold = hold;
    p.floes.push_back(group);
    return static_cast<std::int32_t>(p.floes.size()) - 1;
}

}  // namespace

bool can_be_filled(const Loop& outline, double thickness) {
    return !shrunk(outline, kHolds * thickness, 0.0).empty();
}

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
    law_ = {ice.length_factor, ice.speed_factor, ice.scatter,
            static_cast<std::uint64_t>(ice.seed) * 1000003u + static_cast<std::uint64_t>(p.seed)};
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

// As many as pieces of a quarter of a half disc can lie in the channel within reach, and the tiles
// on both sides of it.
void LiveEdge::add_slots(Scene& scene, const Case& p) {
    // Room for everything that may lie within reach: pieces of a quarter of a half disc, pi / 2
    // R^2, and tiles along the channel's sides and ends.
    const Vec2 size = reach(scene).sizes();
    const double pieces = size.x() * size.y() / (kCover * 1.57 * radius_ * radius_);
    const double tiles = 6.0 * size.x() / radius_ + 4.0 * size.y() / radius_;
    const double half = 0.5 * thickness_;
    const Loop square = loop_of(Box(Vec2(-half, -half), Vec2(half, half)));
    if (std::optional<Shape> shape = shape_of(square, prism_form(p), is_strip_))
        empty_ = std::move(*shape);
    else
        throw bad_input(
            p.file.string() + ": level_ice.spacing",
            "no contact sphere fits into ice of that thickness",
            fmt::format("give a spacing of at most half the thickness, {:.3g} m", half));
    const double height = (0.5 - share_) * thickness_;
    first_ = scene.bodies.size();
    slots_.resize(static_cast<std::size_t>(std::ceil(pieces + tiles)));
    // Each slot is a body with a form of its own from the start: the number of bodies is
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

void LiveEdge::begin(Scene& scene, Case& p) {
    set_up(scene, p);
    const std::vector<Loop> hull = hull_in_ice(scene);
    if (hull.empty())
        throw bad_input(p.file.string() + ": level_ice",
                        "the hull does not reach the height of the ice",
                        "change hull.draught or level_ice.thickness");
    // half a gap is cut off both ends of a body: the shortest piece must be left
    const double longest_gap = radius_ * (1.0 - law_.scatter) - kSmallestPiece * thickness_;
    if (is_strip_ && gap_ > longest_gap)
        throw bad_input(p.file.string() + ": level_ice.gap",
                        fmt::format("{:.3g} m leave no ice of pieces that are {:.3g} m long", gap_,
                                    radius_ * (1.0 - law_.scatter)),
                        fmt::format("give at most {:.3g} m", std::max(longest_gap, 0.0)));
    const double least = kSmallestPiece * thickness_;
    sheet_ = IceSheet(extent_, is_strip_ ? std::sqrt(least) : least);  // as long, 1 m broad
    // the hull lies in the sheet from the start: its own place is taken out
    for (const Loop& loop : hull) gone_.crushed += sheet_.take(loop);
    if (is_strip_)  // ice behind the bow has no edge that could be met
        for (const Loop& loop : hull)
            for (const Vec2& corner : loop) drop_behind(corner.x());
    piece_group_ = add_group(p, Hold::until_bent);
    tile_group_ = add_group(p, Hold::always);
    add_slots(scene, p);
    scene.start = {extent_, true, true};
    looked_at_ = laid_at_ = ship_in_ice(scene);
    Plan plan;
    lay_tiles(scene, plan);
    fill(p, plan);
    put(scene, 0.0, plan);
}

// Tiles that stay as they are keep their bodies and crushed depths.
void LiveEdge::lay_tiles(const Scene& scene, Plan& plan) {
    std::vector<Loop> wanted;
    const auto tiles = is_strip_
                           ? strip_tiles(sheet_, extent_.min().x(), radius_)
                           : edge_tiles(sheet_, {extent_.min(), radius_}, reach(scene),
                                        [&](const Loop& part) { return !bodies_of(part).empty(); });
    for (const Loop& tile : tiles)
        // a tile whose outline is unchanged stays with its body, its notches and its contacts
        for (Loop& body : bodies_of(tile)) wanted.push_back(std::move(body));
    for (std::size_t k = 0; k < slots_.size(); ++k) {
        Slot& slot = slots_[k];
        if (slot.use != Use::tile) continue;
        const auto same = std::find(wanted.begin(), wanted.end(), slot.outline);
        if (same != wanted.end()) {
            wanted.erase(same);
            continue;
        }
        plan.notches.take(scene, static_cast<std::int32_t>(first_ + k));
        slot = {};  // a free one that is not used again is parked by put()
        plan.changed.push_back(static_cast<std::int32_t>(first_ + k));
    }
    for (Loop& outline : wanted)
        plan.bodies.push_back({std::move(outline), true, 0.0, 0.0, 0.0, {}});
}

void LiveEdge::fill(const Case& p, Plan& plan) const {
    const PrismForm form = prism_form(p);
    parallel_tasks(plan.bodies.size(), true, [&](std::size_t k) {
        plan.bodies[k].shape = shape_of(plan.bodies[k].outline, form, is_strip_);
    });
}

void LiveEdge::put(Scene& scene, double time, Plan& plan) {
    Bodies& b = scene.bodies;
    for (Plan::Body& body : plan.bodies) {
        if (!body.shape) continue;
        const std::size_t k = free_slot(scene, time, plan), i = first_ + k;
        // the outline is in the ice's axes; a body is where these have drifted to
        const Vec2 centre = centroid_of(body.outline);
        b.group[i] = body.is_tile ? tile_group_ : piece_group_;
        // a tile breaks where a window of the edge does, never as a whole
        b.breaking_load[i] = body.is_tile ? std::numeric_limits<double>::max() : kNever;
        put_ice(scene, i, std::move(*body.shape),
                {centre + drifted_, drift_, density_, share_, body.is_tile});
        plan.notches.give(scene, static_cast<std::int32_t>(i));
        if (b.have_added_mass() && !body.is_tile) {
            add_water(scene, i, density_ / share_);
            update_derived(b, i);
        }
        Slot& slot = slots_[k];
        slot = {body.is_tile ? Use::tile : Use::piece, std::move(body.outline), 0};
        plan.changed.push_back(static_cast<std::int32_t>(i));
        // from here on pieces only
        if (body.is_tile) continue;
        slot.piece = ++broken_;
        gone_.pieces += body.area;
        gone_.brash -= body.area;
        pieces_.push_back({slot.piece, static_cast<std::int32_t>(i), time, kNever, body.load,
                           body.radius, centre, slot.outline});
    }
    // Slots that were given up and not filled again are parked far away, without contacts, and with
    // a small form: an empty body would be a case of its own in every stage.
    for (const std::int32_t i : plan.changed) {
        const auto body = static_cast<std::size_t>(i);
        if (slots_[body - first_].use != Use::free) continue;
        b.group[body] = tile_group_;
        b.breaking_load[body] = kNever;
        put_ice(scene, body, empty_,
                {parked_at(extent_, thickness_, body - first_) + drifted_, drift_, density_, share_,
                 true});
    }
}

void LiveEdge::retire(std::size_t slot, double time, Plan& plan) {
    const auto piece =
        std::lower_bound(pieces_.begin(), pieces_.end(), slots_[slot].piece,
                         [](const IcePiece& p, std::int64_t number) { return p.number < number; });
    ICE_ASSERT(piece != pieces_.end() && piece->number == slots_[slot].piece);
    // the piece leaves the memory; its row is read back from the file at the end
    piece->gone = time;
    if (gone_pieces_.is_open()) {
        gone_pieces_.add(*piece);
        pieces_.erase(piece);
    }
    slots_[slot] = {};
    plan.changed.push_back(static_cast<std::int32_t>(first_ + slot));
}

// The first free one; where there is none, that of the floe furthest astern.
std::size_t LiveEdge::free_slot(const Scene& scene, double time, Plan& plan) {
    const auto found = std::find_if(slots_.begin(), slots_.end(),
                                    [](const Slot& s) { return s.use == Use::free; });
    if (found != slots_.end()) return static_cast<std::size_t>(found - slots_.begin());
    std::size_t last = slots_.size();
    for (std::size_t k = 0; k < slots_.size(); ++k)
        if (slots_[k].use == Use::piece &&
            (last == slots_.size() ||
             scene.bodies.position[first_ + k].x() < scene.bodies.position[first_ + last].x()))
            last = k;
    if (last == slots_.size())
        throw run_failed("level_ice", "its edge has more tiles than there is room for",
                         "this is a fault of the program: please report it");
    retire(last, time, plan);
    return last;
}

std::vector<Loop> LiveEdge::rest() const {
    Box box;
    for (const Loop& loop : sheet_.loops())
        for (const Vec2& p : loop) box.extend(p);
    // in parts along x, so that no polygon has all corners of a long sheet
    std::vector<Loop> out;
    const double step = kRestLength * radius_;
    for (double x = box.min().x(); x < box.max().x(); x += step)
        for (Loop& part : sheet_.parts_in(Box(
                 Vec2(x, box.min().y()), Vec2(std::min(x + step, box.max().x()), box.max().y()))))
            out.push_back(std::move(part));
    return out;
}

void LiveEdge::restore(Scene& scene, const Case& p) const {
    // Shapes are made anew from outlines, by the same code: a checkpoint does not hold meshes.
    std::vector<std::optional<Shape>> shapes(slots_.size());
    parallel_tasks(slots_.size(), true, [&](std::size_t k) {
        if (slots_[k].use != Use::free)
            shapes[k] = shape_of(slots_[k].outline, prism_form(p), is_strip_);
    });
    Bodies& b = scene.bodies;
    for (std::size_t k = 0; k < slots_.size(); ++k) {
        const bool is_piece = slots_[k].use == Use::piece, is_tile = slots_[k].use == Use::tile;
        put_form(scene, first_ + k, shapes[k] ? std::move(*shapes[k]) : Shape(empty_), density_);
        if (b.have_added_mass() && is_piece) add_water(scene, first_ + k, density_ / share_);
        b.group[first_ + k] = is_piece ? piece_group_ : tile_group_;
        b.breaking_load[first_ + k] = is_tile ? std::numeric_limits<double>::max() : kNever;
    }
}

}  // namespace ice
