// SPDX-License-Identifier: GPL-3.0-or-later
/// Level ice seen from above, of whose edge pieces break off.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "common/geometry/loop_area.hpp"

namespace ice {

/// A sheet as a polygon with holes, on a lattice of 2^-30 m.
///
/// Coordinates are whole numbers of that lattice, so that they pass through doubles and checkpoints
/// without a change and every machine gets the same polygons. Where two edges cross, their crossing
/// is rounded to the lattice: a cut changes the area of sheet and pieces together by at most 1 nm
/// times the length of the edges cut.
class IceSheet {
public:
    /// Ice that broke off.
    struct Broken {
        std::vector<Loop> pieces;  ///< largest first, without holes; none where nothing broke
        double brash = 0.0;        ///< area of parts too small for a piece [m2]
    };

    /// A rectangle. @pre not empty, within 1e6 m of the origin
    /// @param smallest  size below which there is no piece [m]: pieces have at least the area of
    ///                  its square and a mean breadth, 2 area / length around, of a quarter of it
    IceSheet(const Eigen::AlignedBox2d& extent, double smallest);

    /// Cuts the region `crack` out. Ice in the region breaks off, and so does ice that the cut
    /// separates from the rest of the sheet: the largest part stays, and any of ten times the
    /// region's area, as the other side of a channel right through the ice. Sheet, pieces and brash
    /// together keep their area. A crack beside the ice breaks nothing off. A ring, as around the
    /// hole of a load inside the ice, breaks across the hole.
    /// @pre crack is simple
    Broken break_off(const Loop& crack);

    /// Takes a region away: ice that was crushed. Remains too small for a piece go, too.
    /// @return area taken [m2]
    double take(const Loop& region);

    /// Area of the ice in a region [m2].
    double area_in(const Loop& region) const;
    /// The ice in a box, as a sheet of its own; empty where there is none.
    IceSheet in_box(const Eigen::AlignedBox2d& box) const;
    /// The ice in a box, in loops without holes, largest first: a loop with a hole is cut in two.
    std::vector<Loop> parts_in(const Eigen::AlignedBox2d& box) const;

    /// Outer loops anticlockwise, holes clockwise; the first is the largest. Empty once all is
    /// gone.
    const std::vector<Loop>& loops() const { return loops_; }
    /// Area of the ice, holes left out [m2]; 0 once all is broken.
    double area() const;
    /// Is the point [m] in the ice? Points on the edge may be either.
    bool contains(const Vec2& point) const;

    /// Sets the sheet as loops() of another gave it: for a run that is continued.
    void restore(std::vector<Loop> loops) { loops_ = std::move(loops); }

private:
    double smallest_;  // size below which there is no piece [m]
    std::vector<Loop> loops_;
};

/// Corners of a box, 4, anticlockwise [m].
Loop loop_of(const Eigen::AlignedBox2d& box);

/// The loop with its corners on the lattice of IceSheet.
Loop on_lattice(const Loop& loop);

/// The intersection of two loops, and `loop` less `region`: outer loops, largest first.
/// Holes are left out: theirs is the area that is missing to the loop's. Empty where there is
/// nothing.
std::vector<Loop> common_part(const Loop& loop, const Loop& region);
std::vector<Loop> without(const Loop& loop, const Loop& region);

/// The ice within outlines, as loops() gives them, that is in no loop of `regions`: loops without
/// holes, largest first. Strips of less than 1 mm in breadth are the rounding to the lattice, and
/// are left out.
std::vector<Loop> parts_without(const std::vector<Loop>& ice, const std::vector<Loop>& regions);

/// Two loops that share an edge as one; empty where they do not become one without a hole.
Loop joined(const Loop& a, const Loop& b);

/// A loop moved inwards by `by` [m], which may separate it: parts of at least `smallest` in the
/// sense of IceSheet [m]; none where nothing is left. Corners nearer than `nearest` [m] to each
/// other, or to the line between those beside them, are merged.
std::vector<Loop> shrunk(const Loop& loop, double by, double smallest, double nearest);

}  // namespace ice
