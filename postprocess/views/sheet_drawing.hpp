// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "common/formats/run_data.hpp"
#include "common/geometry/loop_area.hpp"
#include "postprocess/views/hull_drawing.hpp"
#include "postprocess/views/projection.hpp"

namespace ice::views {

/// Loops as one: what any of them covers, cut to a box. Outer loops anticlockwise, holes clockwise.
/// @param grow  [m] by which each grows before, so that loops that touch leave no line between them
std::vector<Loop> united(const std::vector<Loop>& loops, double grow,
                         const Eigen::AlignedBox2d& within);

/// The unbroken sheet of level ice. Its parts that are there in a frame are drawn as one plate: no
/// line between them shows where a crack will open later.
class Sheet {
public:
    /// @param hull  its box, ship frame: ice far from it is not drawn
    Sheet(const RunHeader& header, const Eigen::AlignedBox3d& hull, ViewFrom from);

    /// False in a run without level ice.
    bool exists() const { return !body_.empty(); }
    bool has(std::size_t body) const;
    /// Height of its middle above the ship's origin [m]. @pre exists()
    double height(const RunFrame& frame) const;

    /// The plate: the walls that are seen, then its upper or lower face; from a side and from ahead
    /// the band that it is. "" where nothing is left.
    std::string draw(const RunFrame& frame, const PageScale& scale) const;

private:
    std::vector<Loop> outlines(const RunFrame& frame) const;

    Projection projection_;
    bool band_;                                // seen edgewise
    double grow_ = 0.0;                        // [m]
    double low_ = 0.0, high_ = 0.0;            // of its faces, from its middle [m]
    Eigen::AlignedBox2d within_;               // from the ship's origin [m]
    std::vector<std::size_t> body_;            // rising
    std::vector<std::vector<Loop>> outlines_;  // of each, body axes [m]
};

}  // namespace ice::views
