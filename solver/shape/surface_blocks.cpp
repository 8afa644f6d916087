// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shape/surface_blocks.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace ice {

namespace {

constexpr std::size_t kLanes = PanelBlock::kLanes;

void put(const Panel& panel, std::size_t lane, PanelBlock& block) {
    const Vec3 swing = panel.center.cross(panel.area);
    for (int d = 0; d < 3; ++d) {
        block.area[d][lane] = panel.area[d];
        block.swing[d][lane] = swing[d];
        block.center[d][lane] = panel.center[d];
        for (int k = 0; k < 3; ++k) block.corner[k][d][lane] = panel.corner[k][d];
    }
}

void put_box(const PanelBlock& block, std::size_t lane, PanelBoxes& boxes) {
    for (int d = 0; d < 3; ++d) {
        double low = block.corner[0][d][0], high = low;
        for (int k = 0; k < 3; ++k)
            for (const double value : block.corner[k][d]) {
                low = std::min(low, value);
                high = std::max(high, value);
            }
        boxes.center[d][lane] = 0.5 * (low + high);
        boxes.half[d][lane] = 0.5 * (high - low);
    }
}

}  // namespace

Panel make_panel(const Vec3& a, const Vec3& b, const Vec3& c) {
    return {{a, b, c}, (a + b + c) / 3.0, 0.5 * (b - a).cross(c - a)};
}

PanelBlocks::PanelBlocks(std::span<const Panel> panels) : count(panels.size()) {
    blocks.resize((count + kLanes - 1) / kLanes);
    boxes.resize((blocks.size() + kLanes - 1) / kLanes, PanelBoxes{});
    for (std::size_t k = 0; k < kLanes * blocks.size(); ++k) {
        Panel panel = panels[std::min(k, count - 1)];
        if (k >= count) panel.area.setZero();
        put(panel, k % kLanes, blocks[k / kLanes]);
    }
    for (std::size_t k = 0; k < blocks.size(); ++k)
        put_box(blocks[k], k % kLanes, boxes[k / kLanes]);
}

Panel PanelBlocks::operator[](std::size_t k) const {
    const PanelBlock& block = blocks[k / kLanes];
    const std::size_t lane = k % kLanes;
    const auto vector = [&](const double(&of)[3][kLanes]) {
        return Vec3(of[0][lane], of[1][lane], of[2][lane]);
    };
    return {{vector(block.corner[0]), vector(block.corner[1]), vector(block.corner[2])},
            vector(block.center),
            vector(block.area)};
}

}  // namespace ice
