// SPDX-License-Identifier: GPL-3.0-or-later
// Tiles and pieces become bodies.
#include <algorithm>
#include <limits>
#include <utility>

#include "common/base/assert.hpp"
#include "common/base/error.hpp"
#include "common/base/parallel.hpp"
#include "solver/live_edge/edge_plan.hpp"
#include "solver/live_edge/edge_tiles.hpp"
#include "solver/live_edge/put_ice.hpp"
#include "solver/live_edge/slot_shapes.hpp"
#include "solver/live_edge/strip.hpp"
#include "solver/scene/set_added_mass.hpp"

namespace ice {

namespace {

using Box = Eigen::AlignedBox2d;

// Length of the parts in which the rest of the sheet is drawn, in radii [-]. Only pictures depend
// on it. A larger value draws fewer, longer parts.
constexpr double kRestLength = 8.0;

}  // namespace

bool LiveEdge::Precedes::operator()(const Loop& l, const Loop& r) const {
    return std::lexicographical_compare(
        l.begin(), l.end(), r.begin(), r.end(), [](const Vec2& p, const Vec2& q) {
            return std::pair(p.x(), p.y()) < std::pair(q.x(), q.y());
        });
}

// Boxes around floes that may move, where they come until tiles are laid again: that is when the
// ship has come a cell farther, and it pushes no floe farther than that.
std::vector<Box> LiveEdge::floes_in_ice(const Scene& scene) const {
    const Bodies& b = scene.bodies;
    std::vector<Box> out;
    for (std::size_t i = kShip + 1; i < b.size(); ++i) {
        if (b.inverse_mass[i] == 0.0) continue;
        const Eigen::AlignedBox3d& box = scene.shape_of(static_cast<std::int32_t>(i)).box;
        const double far = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).norm() + radius_;
        const Vec2 at = b.position[i].head<2>() - drifted_;
        out.emplace_back(Vec2(at.array() - far), Vec2(at.array() + far));
    }
    return out;
}

// Tiles that stay as they are keep their bodies and crushed depths.
void LiveEdge::lay_tiles(const Scene& scene, Plan& plan) {
    auto last = std::exchange(cell_bodies_, {});
    const auto bodies = [&](const Loop& part) -> const std::vector<Loop>& {
        const auto known = cell_bodies_.find(part);
        if (known != cell_bodies_.end()) return known->second;
        auto kept = last.extract(part);
        return kept.empty() ? cell_bodies_.emplace(part, bodies_of(part)).first->second
                            : cell_bodies_.insert(std::move(kept)).position->second;
    };
    const auto tiles =
        is_strip_ ? strip_tiles(sheet_, extent_.min().x(), radius_)
                  : edge_tiles(sheet_, {extent_.min(), radius_}, reach(scene), floes_in_ice(scene),
                               [&](const Loop& part) { return !bodies(part).empty(); });
    std::vector<Loop> wanted;
    for (const Loop& tile : tiles)
        // a tile whose outline is unchanged stays with its body, its notches and its contacts
        wanted.insert(wanted.end(), bodies(tile).begin(), bodies(tile).end());
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
    const PrismSpec prism = prism_spec(p);
    parallel_tasks(plan.bodies.size(), true, [&](std::size_t k) {
        const Plan::Body& body = plan.bodies[k];
        plan.bodies[k].shape = shape_of(body.outline, prism, kind_of(body.is_tile));
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
    // a small shape: an empty body would be a case of its own in every stage.
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
    std::vector<Loop> gone;
    std::vector<Box> boxes;
    for (IcePiece& part : lost()) {
        Box box;
        for (const Vec2& p : part.outline) box.extend(p);
        boxes.push_back(box);
        gone.push_back(std::move(part.outline));
    }
    // in strips along x, so that no polygon has all corners of a long sheet
    std::vector<Loop> out;
    const double step = kRestLength * radius_;
    for (double x = extent_.min().x(); x < extent_.max().x(); x += step) {
        const Box strip(Vec2(x, extent_.min().y()),
                        Vec2(std::min(x + step, extent_.max().x()), extent_.max().y()));
        std::vector<Loop> within;
        for (std::size_t k = 0; k < gone.size(); ++k)
            if (strip.intersects(boxes[k])) within.push_back(gone[k]);
        for (Loop& part : parts_without({loop_of(strip)}, within)) out.push_back(std::move(part));
    }
    return out;
}

void LiveEdge::restore(Scene& scene, const Case& p) const {
    // Shapes are made anew from outlines, by the same code: a checkpoint does not hold meshes.
    std::vector<std::optional<Shape>> shapes(slots_.size());
    parallel_tasks(slots_.size(), true, [&](std::size_t k) {
        if (slots_[k].use != Use::free)
            shapes[k] =
                shape_of(slots_[k].outline, prism_spec(p), kind_of(slots_[k].use == Use::tile));
    });
    Bodies& b = scene.bodies;
    for (std::size_t k = 0; k < slots_.size(); ++k) {
        const bool is_piece = slots_[k].use == Use::piece, is_tile = slots_[k].use == Use::tile;
        put_shape(scene, first_ + k, shapes[k] ? std::move(*shapes[k]) : Shape(empty_), density_);
        if (b.have_added_mass() && is_piece) add_water(scene, first_ + k, density_ / share_);
        b.group[first_ + k] = is_piece ? piece_group_ : tile_group_;
        b.breaking_load[first_ + k] = is_tile ? std::numeric_limits<double>::max() : kNever;
    }
}

}  // namespace ice
