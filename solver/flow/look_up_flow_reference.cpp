// SPDX-License-Identifier: GPL-3.0-or-later
// The table's flow at a point, trilinear between its nodes: the definition. look_up_flow_simd.cpp
// computes the same bits in lanes.
#include <algorithm>
#include <array>
#include <cmath>

#include "solver/flow/look_up_flow.hpp"

namespace ice {

FlowGrid::FlowGrid(const FlowTable& t)
    : origin(t.origin),
      per_spacing(1.0 / t.spacing),
      last_x(static_cast<double>(t.nodes[0] - 1)),
      last_y(static_cast<double>(t.nodes[1] - 1)),
      last_z(static_cast<double>(t.nodes[2] - 1)),
      symmetric(t.symmetric),
      residual(t.residual),
      panels(t.panels) {
    node.resize(kNumbers * t.size());
    for (std::size_t k = 0; k < t.size(); ++k) {
        std::copy_n(t.velocity.data() + 3 * k, 3, node.data() + kNumbers * k);
        node[kNumbers * k + 3] = t.potential[k];
    }
    const auto nx = static_cast<std::size_t>(t.nodes[0]), ny = static_cast<std::size_t>(t.nodes[1]);
    stride_y = ny > 1 ? kNumbers * nx : 0;
    stride_z = kNumbers * nx * ny;
}

namespace reference {

FlowSample look_up_flow(const FlowGrid& g, const Vec3& point) {
    FlowSample out;
    if (g.empty()) return out;
    // Half of a symmetric flow is stored; the other half has v_y of the opposite sign. Above
    // the water the flow is that of the surface, outside the table there is none.
    const bool mirrored = g.symmetric && point.y() < 0.0;
    const double gx = (point.x() - g.origin.x()) * g.per_spacing;
    const double off_y = ((mirrored ? -point.y() : point.y()) - g.origin.y()) * g.per_spacing;
    const double gy = g.stride_y > 0 ? off_y : 0.0;
    const double gz = std::min((std::min(point.z(), 0.0) - g.origin.z()) * g.per_spacing, g.last_z);
    const bool within = gx >= 0.0 && gx <= g.last_x && gy >= 0.0 && gy <= g.last_y && gz >= 0.0;
    if (!within) return out;
    // the cell's first node, one before the last at most
    const auto cell = [](double place, double last) {
        return std::min(std::floor(place), std::max(last - 1.0, 0.0));
    };
    const double i = cell(gx, g.last_x), j = cell(gy, g.last_y), k = cell(gz, g.last_z);
    const double fx = gx - i, fy = gy - j, fz = gz - k;
    const float* first = g.node.data() + FlowGrid::kNumbers * static_cast<std::size_t>(i) +
                         g.stride_y * static_cast<std::size_t>(j) +
                         g.stride_z * static_cast<std::size_t>(k);
    // trilinear: along x on four edges of the cell, along y on two, then along z
    std::array<double, FlowGrid::kNumbers> value;
    for (std::size_t n = 0; n < value.size(); ++n) {
        const auto along_x = [&](std::size_t at) {
            const double a = first[at + n], b = first[at + FlowGrid::kNumbers + n];
            return a + fx * (b - a);
        };
        const auto over_xy = [&](std::size_t at) {
            const double a = along_x(at), b = along_x(at + g.stride_y);
            return a + fy * (b - a);
        };
        const double a = over_xy(0), b = over_xy(g.stride_z);
        value[n] = a + fz * (b - a);
    }
    out.velocity = Vec3(value[0], mirrored ? -value[1] : value[1], value[2]);
    out.potential = value[3];
    return out;
}

}  // namespace reference
}  // namespace ice
