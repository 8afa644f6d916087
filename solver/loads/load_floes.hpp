// SPDX-License-Identifier: GPL-3.0-or-later
/// Gravity, buoyancy and drag on floes: docs/method.md, section 6.
#pragma once

#include <span>

#include "solver/case/case.hpp"
#include "solver/scene/bodies.hpp"
#include "solver/water/drag.hpp"

namespace ice {

/// Gravity, buoyancy, drag and the flow's pressure on a floe together, and the parts that the
/// energy ledger has apart.
struct FloeLoad : WaterLoad {
    WaterLoad drag;      ///< its part
    WaterLoad pressure;  ///< the part of the flow's dynamic pressure (flow.pressure)
    WaterLoad applied;   ///< the caller's own part (World::applied_loads)
    /// Moment of the buoyancy [N m], also where the model leaves it out.
    Vec3 righting = Vec3::Zero();
    double water_power = 0.0;  ///< of moving water: drag times its velocity [W]
};

/// Loads on floes, in their order: (14), (16) or (17), (24), (25), (P1). Floes of one shape that
/// follow each other cost less. No floes have no loads.
/// @param floes  numbers of floes that are not held, ascending
/// @pre update_derived() was called with the present poses
/// @param out    as many
void load_floes(const Scene& scene, const Case& parameters, std::span<const std::int32_t> floes,
                std::span<FloeLoad> out);

/// The flow's dynamic pressure on one floe: zero where the water does not move, or flow.pressure is
/// off. In 2D within the plane.
WaterLoad flow_pressure(const Scene& scene, const Case& parameters, std::size_t floe);

namespace reference {
// The definition, one floe at a time: read this first. Same bits on every instruction set.
void load_floes(const Scene& scene, const Case& parameters, std::span<const std::int32_t> floes,
                std::span<FloeLoad> out);
}  // namespace reference

}  // namespace ice
