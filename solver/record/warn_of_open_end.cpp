// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/warn_of_open_end.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/scene/ice_extent.hpp"

namespace ice {

namespace {

// How far a floe reaches out, in its own lengths [-]: less is jitter, or neighbours that settle.
constexpr double kOut = 0.1;
// How far the farthest came out, as a share of the ship's travel [-]: less is ice that spreads
// slowly. Only the warning depends on both; larger ones warn later.
constexpr double kWithShip = 0.1;

}  // namespace

std::optional<Warning> warn_of_open_end(const Scene& scene, const Case& parameters, double travel) {
    const IceAtStart& start = scene.start;
    if (!start.walls || start.closed) return std::nullopt;
    // Only a channel between unbroken ice has an end that can be open. Floes ahead of the bow that
    // are now beyond the first ice's far end have been pushed out of it.
    const double end = start.loose.max().x(), bow = box_of(scene, kShip).max().x();
    int count = 0;
    double farthest = 0.0;
    for (const std::int32_t floe : scene.bodies.moving) {
        const auto i = static_cast<std::size_t>(floe);
        // ice that never moves cannot be pushed out; floes astern of the bow are no obstacle
        // any more
        if (is_unbroken(scene, parameters, i) || scene.bodies.position[i].x() < bow) continue;
        const Eigen::AlignedBox3d box = box_of(scene, i);
        const double out = box.max().x() - end;
        if (out <= kOut * box.sizes().x()) continue;
        ++count;
        farthest = std::max(farthest, out);
    }
    if (count == 0 || farthest < kWithShip * travel) return std::nullopt;
    return Warning{
        fmt::format("the ship pushed {} floe{} out of the channel's open far end at x = {:.4g} m, "
                    "the farthest by {:.3g} m while it moved {:.3g} m: ice that moves away "
                    "ahead of the ship lowers the resistance, in a pre-sawn channel by almost "
                    "half; close the end (edges.ahead of the field's "
                    "specification), or hold floes \"until-hull-contact\"",
                    count, count == 1 ? "" : "s", end, farthest, travel),
        true};
}

}  // namespace ice
