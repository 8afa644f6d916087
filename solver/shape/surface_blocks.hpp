// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangles of a surface as the water's kernels read them: eight beside each other.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A piece of the surface small enough that the water's speed is even on it.
struct Panel {
    Vec3 corner[3];  ///< [m], body axes
    Vec3 center;     ///< [m]
    Vec3 area;       ///< outward normal x area [m2]
};

/// The triangle with these corners, anticlockwise seen from outside.
Panel make_panel(const Vec3& a, const Vec3& b, const Vec3& c);

/// Eight panels, by component. The fill of the last block lies on the last panel, with no area.
struct alignas(64) PanelBlock {
    /// Fixed, so that the order of sums depends on no instruction set.
    static constexpr std::size_t kLanes = 8;

    double area[3][kLanes];       ///< [m2]
    double swing[3][kLanes];      ///< center x area: flow through it per rate of turn [m3]
    double center[3][kLanes];     ///< [m]
    double corner[3][3][kLanes];  ///< number, component [m]
};

/// Axis-aligned boxes around the corners of eight blocks, by component; none: at the origin.
struct alignas(64) PanelBoxes {
    double center[3][PanelBlock::kLanes];  ///< [m]
    double half[3][PanelBlock::kLanes];    ///< half the extent [m]
};

/// Panels in blocks, in their order. Reads like a list of Panel.
struct PanelBlocks {
    std::vector<PanelBlock> blocks;
    std::vector<PanelBoxes> boxes;  ///< of blocks 8 k to 8 k + 7
    std::size_t count = 0;          ///< panels

    PanelBlocks() = default;
    explicit PanelBlocks(std::span<const Panel> panels);

    std::size_t size() const { return count; }
    Panel operator[](std::size_t k) const;

    struct Iterator {
        const PanelBlocks* list;
        std::size_t at;
        Panel operator*() const { return (*list)[at]; }
        Iterator& operator++() { return ++at, *this; }
        bool operator!=(const Iterator& other) const { return at != other.at; }
    };
    Iterator begin() const { return {this, 0}; }
    Iterator end() const { return {this, count}; }
};

}  // namespace ice
