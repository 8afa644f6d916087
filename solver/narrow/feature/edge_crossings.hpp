// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>

#include "solver/shape/normal_cone.hpp"

namespace ice {

/// The edges of one normal cone against the faces of another.
///
/// An edge between faces with the normals f and g has the direction f x g, and
///
///     (f x g) x e = g (f . e) - f (g . e)
///
/// is in the cone of f and g, with either sign, only where f . e and g . e differ in sign: the edge
/// e leaves one face and enters the other (arcs that cross on the Gauss map). The signs need
/// neither the product nor its length, which costs a root and a division.
class EdgesAcrossFaces {
public:
    /// @param own    its faces @param other  its edges
    /// @param slack  widens the cone of `own`, times the length of the cross product [rad]
    EdgesAcrossFaces(const NormalCone& own, const NormalCone& other, double slack)
        : is_vertex_(own.count == 3) {
        const double most = kOutside + slack / own.openness();
        for (int k = 0; k < own.edges(); ++k) most_[index(k)] = own.sine(k) * most;
        for (int k = 0; k < other.edges(); ++k) {
            const Vec3 edge = other.edge(k);
            for (std::size_t face = 0; face < index(own.count); ++face)
                along_[face][index(k)] = own.normal[face].dot(edge);
        }
    }

    /// True where the cross product of own edge `own` and edge `other` is in the cone with neither
    /// sign, for any slack up to that given divided by the product's length.
    bool exclude(int own, int other) const {
        const std::size_t f = is_vertex_ ? index((own + 1) % 3) : 0,
                          g = is_vertex_ ? index((own + 2) % 3) : 1;
        const double along_f = along_[f][index(other)], along_g = along_[g][index(other)];
        const double most = most_[index(own)];
        return std::min(along_f, along_g) > most || std::max(along_f, along_g) < -most;
    }

private:
    // More [-] than the 0.005 that NormalCone allows. Larger excludes fewer edges and costs time
    // only; at 0.005 or less rounding would exclude axes that are valid.
    static constexpr double kOutside = 0.006;

    static std::size_t index(int k) { return static_cast<std::size_t>(k); }

    bool is_vertex_;
    std::array<double, 3> most_{};                  // by own edge
    std::array<std::array<double, 3>, 3> along_{};  // by own face and edge of the other
};

/// Calls visit(edge of a, edge of b) for the edges whose cross product may separate the cones; most
/// edges have none.
/// @param slack  as above, of both cones [rad]
template <class Visit>
void for_each_crossing(const NormalCone& a, const NormalCone& b, double slack, const Visit& visit) {
    const EdgesAcrossFaces of_b(a, b, slack), of_a(b, a, slack);
    for (int edge_a = 0; edge_a < a.edges(); ++edge_a)
        for (int edge_b = 0; edge_b < b.edges(); ++edge_b)
            if (!of_b.exclude(edge_a, edge_b) && !of_a.exclude(edge_b, edge_a))
                visit(edge_a, edge_b);
}

}  // namespace ice
