// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "common/geometry/loop_area.hpp"

namespace ice {

using Rectangle = Eigen::AlignedBox2d;

/// A floe seen from above: corners in order, anticlockwise, without repeating the first [m].
using Outline = std::vector<Vec2>;

/// More floes than this [-] are a wrong unit more often than a wish. A larger value begins fields
/// that take long and much memory, a smaller one refuses fields that can be made.
constexpr double kMostFloes = 1e6;

/// Corners that differ by less are equal [m], a micrometre, far below any floe's edge: floes then
/// share a shape, or are mirror images. A larger value moves corners by as much.
constexpr double kEqualCorners = 1e-6;

/// All floes of a field before they become solids.
struct FieldPlan {
    Rectangle area;              ///< that the loose floes' concentration refers to [m]
    std::vector<Outline> loose;  ///< floes
    std::vector<Outline> fixed;  ///< unbroken ice
};

/// The rectangle from (x, y) to (x + length, y + breadth), all in [m].
inline Outline rectangle(double x, double y, double length, double breadth) {
    return {{x, y}, {x + length, y}, {x + length, y + breadth}, {x, y + breadth}};
}

/// Diameter of the circle with that area [m]: the "size" of a floe in the whole program.
double size_of(const Outline& outline);

/// True when every corner turns left or is straight.
bool is_convex(const Outline& outline);

/// The outline without its straight corners.
Outline without_straight_corners(const Outline& outline);

/// The outline moved inward by `distance` [m], corner by corner along the bisectors (mitred).
/// @return an empty outline when an edge would vanish or turn round
Outline inset(const Outline& outline, double distance);

}  // namespace ice
