// SPDX-License-Identifier: GPL-3.0-or-later
/// The points of a triangle of the surface at which moving water is evaluated.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "common/base/assert.hpp"
#include "solver/shape/shape.hpp"

namespace ice {

/// A triangle's corners 0 to 2 and the middles 3 to 5 of the edges behind them.
struct SixPoints {
    std::array<std::size_t, 6> place;  ///< of each among the mesh's vertices and, numbered behind
                                       ///< them, the middles of its edges
    std::array<Vec3, 6> at;            ///< body axes [m]

    /// @pre the shape is a floe's, whose edges are known
    SixPoints(const Shape& shape, std::size_t triangle) {
        ICE_ASSERT(triangle < shape.edges.of_triangle.size());
        for (std::size_t k = 0; k < 3; ++k) {
            const auto corner = static_cast<std::size_t>(shape.mesh.triangles[triangle][k]);
            const auto edge = static_cast<std::size_t>(shape.edges.of_triangle[triangle][k]);
            place[k] = corner;
            place[3 + k] = shape.mesh.vertices.size() + edge;
            at[k] = shape.mesh.vertices[corner];
            at[3 + k] = shape.edges.middle[edge];
        }
    }
    /// Of values at all places those at the six points.
    template <class T>
    std::array<T, 6> pick(const std::vector<T>& values) const {
        std::array<T, 6> out;
        for (std::size_t k = 0; k < 6; ++k) out[k] = values[place[k]];
        return out;
    }
};

/// A quarter of a triangle by its corners among the six points.
using Quarter = std::array<std::size_t, 3>;

constexpr std::array<Quarter, 4> kQuarters{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};

}  // namespace ice
