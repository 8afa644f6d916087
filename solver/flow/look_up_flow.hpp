// SPDX-License-Identifier: GPL-3.0-or-later
/// The water's velocity from a table.
#pragma once

#include <span>
#include <vector>

#include "common/formats/flow_file.hpp"
#include "solver/flow/panel_sums.hpp"

namespace ice {

/// A table as it is read at points: a node's four numbers beside each other, for the cache.
struct FlowGrid {
    static constexpr std::size_t kNumbers = 4;

    /// For a ship at 1 m/s: velocity x, y, z [m/s] and potential [m2/s] of each node, x fastest,
    /// then y.
    std::vector<float> node;
    Vec3 origin = Vec3::Zero();                 ///< place of the first node [m]
    double per_spacing = 0.0;                   ///< one over the nodes' distance [1/m]
    double last_x = 0, last_y = 0, last_z = 0;  ///< number of the last node along each axis
    std::size_t stride_y = 0, stride_z = 0;     ///< in numbers; along y 0 for a section (2D)
    bool symmetric = false;                     ///< the table has y >= 0 alone
    double residual = 0.0;                      ///< FlowTable::residual [-]
    std::int64_t panels = 0;                    ///< FlowTable::panels

    FlowGrid() = default;  ///< no table: look_up_flow() gives zeros
    explicit FlowGrid(const FlowTable& table);
    bool empty() const { return node.empty(); }
};

/// The flow at points in the table's axes, linear between the nodes of a cell along x, then y, then
/// z; 0 outside the table, which has faded by then. Above the water it is that at its surface. The
/// same bits on every instruction set.
/// @param points  [m] @param out  as many
void look_up_flow(const FlowGrid& grid, std::span<const Vec3> points, std::span<FlowSample> out);

namespace reference {
/// The definition: read this first. @param point  in the table's axes [m]
FlowSample look_up_flow(const FlowGrid& grid, const Vec3& point);
}  // namespace reference

}  // namespace ice
