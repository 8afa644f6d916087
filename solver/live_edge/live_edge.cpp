// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/live_edge/live_edge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "solver/bending/breaking_load.hpp"
#include "solver/live_edge/edge_plan.hpp"
#include "solver/live_edge/hull_outlines.hpp"
#include "solver/live_edge/slot_shapes.hpp"
#include "solver/live_edge/strip.hpp"

namespace ice {

namespace {

using Box = Eigen::AlignedBox2d;

// Depth to which crushed ice stays in the polygon, in thicknesses [-]: spheres that lie deeper in
// their body by as much still represent its edge. Where the hull is twice as deep, the ice is taken
// away. Smaller renews the edge more often; larger lets spheres be pushed far into a tile that the
// polygon still has.
constexpr double kCrushed = 0.125;

// There are tiles this far aside of the hull [radii of a crack at rest]. Larger lays more of them
// and takes more slots; smaller lets cracks from the hull's sides reach ice without tiles.
constexpr double kReachAside = 3.0;

// The opening angle of the ice inside a crack [rad]: of the sector with its area, at most that of a
// straight edge (docs/method.md, section 5).
double angle_of(double area, double radius) {
    return std::min(2.0 * area / (radius * radius), std::numbers::pi);
}

}  // namespace

bool LiveEdge::is_tile(std::int32_t body) const {
    const auto i = static_cast<std::size_t>(body);
    return i >= first_ && slots_[i - first_].use == Use::tile;
}

// Sheet, tiles and cracks lie in axes that drift with the ice: ice that drifts past a ship then
// breaks like ice that a ship passes.
Vec2 LiveEdge::ship_in_ice(const Scene& scene) const {
    return scene.bodies.position[kShip].head<2>() - drifted_;
}

std::vector<Loop> LiveEdge::hull_in_ice(const Scene& scene) const {
    const double top = (1.0 - share_) * thickness_;
    std::vector<Loop> out = hull_outlines(scene, top, top - thickness_);
    for (Loop& loop : out) {
        for (Vec2& p : loop) p -= drifted_;
        if (is_strip_) loop = across_strip(std::move(loop), thickness_);
    }
    return out;
}

// The region that a crack cuts out.
Loop LiveEdge::region_of(const Vec2& at, const Vec2& inwards, double radius) const {
    return is_strip_ ? strip_crack(at.x(), radius) : crack_outline(at, inwards, radius);
}

IceAreas LiveEdge::areas() const {
    IceAreas out = gone_;
    out.sheet = sheet_.area();
    return out;
}

std::int64_t LiveEdge::alive() const {
    return std::count_if(slots_.begin(), slots_.end(),
                         [](const Slot& s) { return s.use == Use::piece; });
}

// Pieces and lost parts of the sheet, from memory and file.
std::vector<IcePiece> LiveEdge::all_rows() const {
    std::vector<IcePiece> out = pieces_;
    out.insert(out.end(), lost_.begin(), lost_.end());
    gone_pieces_.read(out);
    return out;
}

std::vector<IcePiece> LiveEdge::lost() const {
    std::vector<IcePiece> out = all_rows();
    std::erase_if(out, [](const IcePiece& p) { return p.number > 0; });
    return out;
}

std::vector<IcePiece> LiveEdge::pieces() const {
    std::vector<IcePiece> out = all_rows();
    std::erase_if(out, [](const IcePiece& p) { return p.number == 0; });
    std::sort(out.begin(), out.end(),
              [](const IcePiece& l, const IcePiece& r) { return l.number < r.number; });
    return out;
}

void LiveEdge::keep_gone_in(const std::filesystem::path& folder) {
    // pieces that are gone so far go into the file, too: memory holds those in the scene alone
    std::vector<IcePiece> all = all_rows();
    gone_pieces_.open(folder);
    pieces_.clear();
    lost_.clear();
    for (IcePiece& piece : all) {
        if (std::isinf(piece.gone))
            pieces_.push_back(std::move(piece));
        else
            gone_pieces_.add(piece);
    }
}

Box LiveEdge::reach(const Scene& scene) const {
    // in axes that drift with the ice: a box around the hull's turned box, longer ahead and
    // aside
    const Bodies& b = scene.bodies;
    const Eigen::AlignedBox3d& hull = scene.shapes[0].box;
    const Vec3 half = b.rotation[kShip].cwiseAbs() * (0.5 * hull.sizes());
    const Vec2 middle = ship_in_ice(scene) + (b.rotation[kShip] * hull.center()).head<2>();
    const double aside = kReachAside * radius_;
    return {Vec2(middle.x() - half.x() - astern_, middle.y() - half.y() - aside),
            Vec2(middle.x() + half.x() + ahead_, middle.y() + half.y() + aside)};
}

void LiveEdge::find(const Case& parameters, const std::vector<Contact>& contacts,
                    const std::vector<Constraint>& constraints) {
    if (!has_sheet()) return;
    // Every contact of a tile is a load (26): the ship's, and those of floes that it pushes.
    loads_.clear();
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const Constraint& c = constraints[k];
        if (c.total_normal() <= 0.0) continue;
        // impulses act on b, their opposites on a
        for (const auto& [body, sign] : {std::pair(c.b, 1.0), std::pair(c.a, -1.0)}) {
            if (!is_tile(body)) continue;
            const double up = c.total_normal() * c.normal.z() + c.total_tangent().z();
            loads_.push_back({contacts[k].point.head<2>() - drifted_, -sign * up, c.total_normal(),
                              c.total_normal() * std::max(-c.approach, 0.0),
                              sign * c.total_normal() * c.normal.head<2>()});
        }
    }
    const auto windows =
        is_strip_ ? tip_window(loads_, tip_of(sheet_), radius_) : edge_windows(loads_, radius_);
    // Each window by itself: R of (30) with its closing speed, the angle 2 A / R^2 with the ice
    // that is there, P_f of (29) times f(v_n). A window at its load opens a crack in the next
    // step.
    for (const EdgeWindow& window : windows) {
        const double radius =
            crack_size(law_, length_, window.normal_speed, crack_number_ + cracks_.size());
        const double area = sheet_.area_in(region_of(window.at, window.inwards, radius));
        const double bears = breaking_load(angle_of(area, radius), thickness_, parameters) *
                             speed_factor(parameters.bending, window.closing);
        const double load = window.down / parameters.time_step;
        if (load >= bears) cracks_.push_back({window.at, window.inwards, radius, load});
    }
}

bool LiveEdge::is_due(const Scene& scene) const {
    if (!has_sheet()) return false;
    if (!cracks_.empty()) return true;
    // hull and sheet are compared each time the ship has moved by an eighth of a thickness
    return (ship_in_ice(scene) - looked_at_).norm() >= kCrushed * thickness_;
}

bool LiveEdge::renew(Scene& scene, const Case& parameters, double time) {
    const std::vector<Loop> hull = hull_in_ice(scene);
    looked_at_ = ship_in_ice(scene);
    const IceSheet before = sheet_;
    // First the ice that the hull has crushed through, then the cracks: pieces are cut from the
    // sheet that is left.
    bool is_new = crush_through(hull);
    changed_.clear();
    Plan plan;
    for (const Crack& crack : std::exchange(cracks_, {})) {
        break_off(crack, hull, plan);
        is_new = true;
    }
    if (is_new) keep_lost(before, time);
    // without new ice tiles are laid only when the ship has come a cell farther
    if (!is_new && (looked_at_ - laid_at_).norm() < radius_) return false;
    laid_at_ = looked_at_;
    // Ice and floes astern of the reach are never met again: both are counted and given up.
    const double behind = reach(scene).min().x();
    drop_behind(behind);
    for (std::size_t k = 0; k < slots_.size(); ++k)
        if (slots_[k].use == Use::piece &&
            scene.bodies.position[first_ + k].x() - drifted_.x() < behind)
            retire(k, time, plan);
    // Outlines first, then all fills at once by all threads, then the bodies in the order of
    // the plan.
    lay_tiles(scene, plan);
    fill(parameters, plan);
    put(scene, time, plan);
    changed_ = std::move(plan.changed);
    std::sort(changed_.begin(), changed_.end());
    changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
    return !changed_.empty();
}

// For pictures of the sheet as it was. What is left astern is no loss, so it is dropped after this.
void LiveEdge::keep_lost(const IceSheet& before, double time) {
    for (Loop& loop : parts_without(before.loops(), sheet_.loops())) {
        IcePiece part{0, 0, time, time, 0.0, 0.0, Vec2::Zero(), std::move(loop)};
        if (gone_pieces_.is_open())
            gone_pieces_.add(part);
        else
            lost_.push_back(std::move(part));
    }
}

void LiveEdge::drop_behind(double x) {
    if (x > extent_.min().x())
        gone_.astern += sheet_.take(
            loop_of({extent_.min() - Vec2(1.0, 1.0), Vec2(x, extent_.max().y() + 1.0)}));
}

// Removes ice that the hull has crushed through at both faces. A strip stays: its spheres store the
// crushed depth.
bool LiveEdge::crush_through(const std::vector<Loop>& hull) {
    if (hull.size() < 2) return false;
    bool any = false;
    const double breadth = is_strip_ ? 1.0 : thickness_;
    // Common to both faces: where the section at the upper and at the lower face overlap, the
    // whole thickness is gone. It must be deep, and more than a sliver, before the polygon
    // changes.
    for (const Loop& core : common_part(hull[0], hull[1]))
        for (const Loop& deep : shrunk(core, 2.0 * kCrushed * thickness_, 0.0, kNearest)) {
            if (sheet_.area_in(deep) <= kCrushed * thickness_ * breadth) continue;
            for (const Loop& gone : shrunk(core, kCrushed * thickness_, 0.0, kNearest))
                gone_.crushed += sheet_.take(gone);
            any = true;
        }
    return any;
}

// The ice around a crack is laid anew, and the hull's notch in it is gone through all of its
// thickness: the new tiles do not overlap with the hull.
void LiveEdge::break_off(const Crack& crack, const std::vector<Loop>& hull, Plan& plan) {
    ++crack_number_;
    const Loop outline = region_of(crack.at, crack.inwards, crack.radius);
    const IceSheet::Broken broken = sheet_.break_off(outline);
    gone_.brash += broken.brash;
    for (const Loop& piece : broken.pieces) add_piece(piece, crack, hull, plan);
    // The box of grid cells around the crack: these cells are laid anew, so the hull's notch
    // must be cut out of them.
    Box around;
    for (const Vec2& corner : outline)
        for (int d = 0; d < 2; ++d) {
            const double cell = (corner[d] - extent_.min()[d]) / radius_;
            Vec2 line = corner;
            line[d] = extent_.min()[d] + radius_ * std::floor(cell);
            around.extend(line);
            line[d] = extent_.min()[d] + radius_ * std::ceil(cell);
            around.extend(line);
        }
    for (const Loop& loop : hull)
        for (const Loop& notch : common_part(loop, loop_of(around)))
            gone_.crushed += sheet_.take(notch);
}

void LiveEdge::add_piece(const Loop& piece, const Crack& crack, const std::vector<Loop>& hull,
                         Plan& plan) {
    // the piece without the hull's outlines at both faces
    std::vector<Loop> parts{piece};
    for (const Loop& loop : hull) {
        std::vector<Loop> left;
        for (const Loop& part : parts)
            for (Loop& rest : without(part, loop)) left.push_back(std::move(rest));
        parts = std::move(left);
    }
    // Its area is crushed ice, less the parts that are left. These are brash until put() makes
    // bodies of them and counts their area as pieces.
    gone_.crushed += area_of(piece);
    for (const Loop& part : parts) {
        gone_.crushed -= area_of(part);
        gone_.brash += area_of(part);  // until it is filled
        std::vector<Loop> bodies = bodies_of(part);
        if (bodies.empty()) continue;
        Plan::Body body{std::move(bodies[0]), false, crack.load, crack.radius, area_of(part), {}};
        plan.bodies.push_back(std::move(body));
        for (std::size_t k = 1; k < bodies.size(); ++k)
            plan.bodies.push_back({std::move(bodies[k]), false, crack.load, crack.radius, 0.0, {}});
    }
}

bool LiveEdge::can_be_filled(const Loop& outline) const {
    return ice::can_be_filled(outline, thickness_);
}

EdgeBody LiveEdge::kind_of(bool is_tile) const {
    if (is_strip_) return EdgeBody::strip;
    return is_tile ? EdgeBody::tile : EdgeBody::piece;
}

std::vector<Loop> LiveEdge::bodies_of(const Loop& part) const {
    if (is_strip_) return strip_bodies(part, gap_, kSmallestPiece * thickness_);
    std::vector<Loop> out;
    // Corners that change the outline by less than a quarter of the gap are left out: of two
    // neighbours neither comes to the other.
    const double half = 0.5 * gap_;
    for (Loop& loop :
         shrunk(part, half, kSmallestPiece * thickness_, std::max(kNearest, 0.25 * gap_)))
        if (can_be_filled(loop)) out.push_back(std::move(loop));
    return out;
}

}  // namespace ice
