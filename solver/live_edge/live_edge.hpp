// SPDX-License-Identifier: GPL-3.0-or-later
/// The edge of level ice; the ship breaks pieces off it as it advances (docs/method.md, section 5).
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "solver/case/case.hpp"
#include "solver/contact/constraints.hpp"
#include "solver/level_ice/crack_size.hpp"
#include "solver/level_ice/ice_sheet.hpp"
#include "solver/live_edge/edge_window.hpp"
#include "solver/live_edge/gone_pieces.hpp"
#include "solver/live_edge/slot_shapes.hpp"
#include "solver/narrow/manifold/contact.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

class CheckpointFile;

/// The uses of a sheet's area [m2]; the five add up to the sheet's at the start.
struct IceAreas {
    double sheet = 0.0;    ///< unbroken, within reach and ahead
    double pieces = 0.0;   ///< floes that broke off, those far astern too
    double crushed = 0.0;  ///< where the hull was when ice broke or was crushed through
    double brash = 0.0;    ///< broken off, too small for a floe
    double astern = 0.0;   ///< unbroken, left behind
};

/// A sheet of level ice whose edge is contact geometry where the ship can meet it.
///
/// The sheet is a polygon. Its edge around the ship is laid out in tiles (edge_tiles), bodies that
/// are held: the hull crushes them. Loads near each other form a window (edge_windows). A crack
/// around its centre would cut out a piece. When the load reaches that piece's breaking load, the
/// piece becomes a floe (equations (26), (29) and (30)): the polygon loses it, and the tiles around
/// are laid anew. Rejected: cracks laid along the course before the run; two pieces then shared a
/// load between them (docs/design-notes.md).
///
/// Polygon, tiles and cracks are in the ice's own axes, which drift with it: places in the world
/// are theirs plus drift() times the time. A ship at rest in drifting ice therefore has the results
/// of a ship that advances in ice at rest.
///
/// In 2D the sheet is a strip (strip.hpp): areas are lengths, per metre of breadth.
///
/// In 3D pieces and tiles meet each other as solids that cannot be crushed (Shape::parts): what
/// presses them together comes from the ship, and there they crush.
///
/// Bodies come from a fixed number of slots; floes further astern than half a ship's length, or the
/// last one where no slot is left, are taken out of the scene.
///
/// Stages by source: begin_edge.cpp lays the sheet and its slots before the first step;
/// live_edge.cpp finds the cracks of a step and cuts pieces from the polygon (find, renew);
/// lay_edge.cpp makes tiles and pieces bodies; edge_state.cpp carries the state of checkpoints.
class LiveEdge {
public:
    /// Is there a sheet?
    bool has_sheet() const { return first_ > 0; }

    /// Lays the sheet of a case into a scene with or without other floes; adds the groups of its
    /// bodies to the case. The sheet has no ice where the ship is.
    /// @throws Error (exit code 2) naming level_ice where the hull does not reach the ice's height,
    ///         where cracks are longer than the sheet, or where gaps leave no ice between them
    void begin(Scene& scene, Case& parameters);

    /// Sets how long the ice has drifted [s]; called before is_due(), renew() and find() of a step.
    void drift_until(double time) { drifted_ = time * drift_; }
    /// Velocity of all the ice [m/s].
    const Vec2& drift() const { return drift_; }

    /// Does renew() have something to do?
    bool is_due(const Scene& scene) const;
    /// Breaks off the pieces of the last step's cracks, takes away the ice that the hull has
    /// crushed through, and lays the edge anew around the ship's new place.
    /// @param time  [s]
    /// @return whether bodies have another shape now: those of changed()
    bool renew(Scene& scene, const Case& parameters, double time);
    /// The bodies to which the last renew() gave another shape, sorted.
    const std::vector<std::int32_t>& changed() const { return changed_; }

    /// Sums the loads of the step just done and finds the cracks that they open.
    /// @pre the constraints hold the step's impulses
    void find(const Case& parameters, const std::vector<Contact>& contacts,
              const std::vector<Constraint>& constraints);

    /// Lays out the ice of a checkpoint. @pre state, poses and momenta are those of the saved
    /// run; the scene came from begin()
    void restore(Scene& scene, const Case& parameters) const;

    const IceSheet& sheet() const { return sheet_; }
    double thickness() const { return thickness_; }  ///< [m]
    /// Height of the middle of level ice afloat [m].
    double height() const { return (0.5 - share_) * thickness_; }
    double density() const { return density_; }  ///< [kg/m3]
    double length() const { return length_; }    ///< characteristic length of the plate [m]
    /// Cell size of the tiles = crack radius at rest [m]; in 2D the length from the tip to the
    /// crack.
    double radius() const { return radius_; }
    /// Is it a strip, in 2D?
    bool is_strip() const { return is_strip_; }
    /// The sheet that is left, also astern, in the ice's axes: in strips across it, in loops
    /// without holes.
    std::vector<Loop> rest() const;
    /// The other parts of the sheet, in the order in which they went: broken off or crushed at
    /// IcePiece::gone [s], -inf where the hull was at the start. Together with rest() they are the
    /// sheet. They have an outline in the ice's axes and no body; their number is 0.
    std::vector<IcePiece> lost() const;
    /// Body of the first slot, and the groups of floes and tiles in the case.
    std::size_t first_body() const { return first_; }
    std::int32_t piece_group() const { return piece_group_; }
    std::int32_t tile_group() const { return tile_group_; }
    IceAreas areas() const;
    /// All pieces that have broken off, by number; pieces that left the scene are read from the
    /// disk.
    std::vector<IcePiece> pieces() const;
    /// Size of the pieces that left the scene, on the disk and in a checkpoint [bytes].
    std::uint64_t bytes_of_gone() const { return gone_pieces_.bytes(); }
    /// How many have broken off.
    std::int64_t broken() const { return broken_; }
    /// Floes in the scene now.
    std::int64_t alive() const;
    /// Taken out of the scene.
    std::int64_t retired() const { return broken_ - alive(); }
    /// From now on pieces that are taken out of the scene are kept in a file of this folder, not in
    /// memory. @throws Error (exit code 1) where it cannot be created
    void keep_gone_in(const std::filesystem::path& folder);
    /// Is the body one of this edge's slots?
    bool has_slot(std::size_t body) const { return first_ > 0 && body >= first_; }

    /// Writes its state, or reads it: polygon, slots, cracks, pieces.
    void carry(CheckpointFile& file);

private:
    enum class Use : std::uint8_t { free, tile, piece };
    struct Slot {
        Use use = Use::free;
        Loop outline;            // of the body, as it was laid [m]
        std::int64_t piece = 0;  // its number
    };
    // Of the outlines' corners in turn, by x, then y.
    struct Precedes {
        bool operator()(const Loop& l, const Loop& r) const;
    };
    // A crack that the last step's loads opened.
    struct Crack {
        Vec2 at, inwards;     // ice's axes: place [m]; unit vector along the push
        double radius, load;  // [m]; [N], in 2D [N/m]
    };
    struct Plan;  // the bodies of one renewal

    void carry_pieces(CheckpointFile& file);
    void set_up(const Scene& scene, const Case& parameters);
    void check_cracks(const Case& parameters) const;
    void add_slots(Scene& scene, const Case& parameters);
    bool is_tile(std::int32_t body) const;
    Loop region_of(const Vec2& at, const Vec2& inwards, double radius) const;
    void drop_behind(double x);
    Vec2 ship_in_ice(const Scene& scene) const;
    std::vector<Loop> hull_in_ice(const Scene& scene) const;
    Eigen::AlignedBox2d reach(const Scene& scene) const;
    std::vector<Eigen::AlignedBox2d> floes_in_ice(const Scene& scene) const;
    bool crush_through(const std::vector<Loop>& hull);
    std::vector<IcePiece> all_rows() const;
    void keep_lost(const IceSheet& before, double time);
    void break_off(const Crack& crack, const std::vector<Loop>& hull, Plan& plan);
    void add_piece(const Loop& piece, const Crack& crack, const std::vector<Loop>& hull,
                   Plan& plan);
    void lay_tiles(const Scene& scene, Plan& plan);
    void fill(const Case& parameters, Plan& plan) const;
    void put(Scene& scene, double time, Plan& plan);
    void retire(std::size_t slot, double time, Plan& plan);
    std::size_t free_slot(const Scene& scene, double time, Plan& plan);
    bool can_be_filled(const Loop& outline) const;
    EdgeBody kind_of(bool is_tile) const;
    std::vector<Loop> bodies_of(const Loop& part) const;

    // from the case and the hull
    bool is_strip_ = false;
    std::size_t first_ = 0;  // body of slots_[0]; 0: there is no sheet
    double thickness_ = 0.0, gap_ = 0.0, length_ = 0.0, radius_ = 0.0;  // [m]
    double density_ = 0.0, share_ = 0.0;                                // [kg/m3]; below water [-]
    Vec2 drift_ = Vec2::Zero();
    Eigen::AlignedBox2d extent_;
    CrackLaw law_;
    Shape empty_;  // of slots without ice
    std::int32_t piece_group_ = 0, tile_group_ = 0;
    double ahead_ = 0.0, astern_ = 0.0;  // of the hull's box, that is within reach [m]

    // the state
    IceSheet sheet_{Eigen::AlignedBox2d(Vec2::Zero(), Vec2::Ones()), 1.0};
    std::vector<Slot> slots_;
    std::vector<Crack> cracks_;
    std::vector<IcePiece> pieces_;  // by number: those in the scene, and gone ones without a file
    std::vector<IcePiece> lost_;    // only without a file
    std::int64_t broken_ = 0;
    std::uint64_t crack_number_ = 0;                          // of the next crack
    IceAreas gone_;                                           // all but `sheet`
    Vec2 laid_at_ = Vec2::Zero(), looked_at_ = Vec2::Zero();  // the ship then

    Vec2 drifted_ = Vec2::Zero();  // from the world's axes to the ice's, now; no state
    std::vector<EdgeLoad> loads_;  // memory of find()
    // Results of bodies_of() for the cells of the last lay_tiles(): most are the next one's, too.
    std::map<Loop, std::vector<Loop>, Precedes> cell_bodies_;
    std::vector<std::int32_t> changed_;
    GonePieces gone_pieces_;
};

}  // namespace ice
