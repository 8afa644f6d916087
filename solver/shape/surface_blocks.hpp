// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangles of a surface as the water's kernels read them: eight beside each other.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A triangle of the surface.
struct Facet {
    Vec3 corner[3];  ///< [m], body axes
    Vec3 area;       ///< outward normal x area [m2]
};

/// The triangle with these corners [m], anticlockwise seen from outside; a flat one has area 0.
Facet make_facet(const Vec3& a, const Vec3& b, const Vec3& c);

/// Eight facets, by component. The fill of the last block lies on the last facet, with no area.
struct alignas(64) FacetBlock {
    /// Triangles in a block [-]. Fixed, so that the order of sums depends on no instruction set.
    /// Another number gives loads with other last digits.
    static constexpr std::size_t kLanes = 8;

    double area[3][kLanes];       ///< component, lane [m2]
    double corner[3][3][kLanes];  ///< number, component, lane [m]
};

/// Facets in blocks, in their order. Reads like a list of Facet.
struct FacetBlocks {
    std::vector<FacetBlock> blocks;
    std::size_t count = 0;  ///< facets

    FacetBlocks() = default;
    explicit FacetBlocks(std::span<const Facet> facets);

    std::size_t size() const { return count; }
    Facet operator[](std::size_t k) const;

    struct Iterator {
        const FacetBlocks* list;
        std::size_t at;
        Facet operator*() const { return (*list)[at]; }
        Iterator& operator++() { return ++at, *this; }
        bool operator!=(const Iterator& other) const { return at != other.at; }
    };
    Iterator begin() const { return {this, 0}; }
    Iterator end() const { return {this, count}; }
};

}  // namespace ice
