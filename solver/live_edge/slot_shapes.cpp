// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/live_edge/slot_shapes.hpp"

#include <algorithm>

#include "common/base/error.hpp"
#include "solver/live_edge/edge_plan.hpp"
#include "solver/live_edge/prism_parts.hpp"
#include "solver/live_edge/strip.hpp"

namespace ice {

namespace {

// Radius of the spheres, in thicknesses [-]: icefield's default. Two of them fill the thickness.
// Smaller gives more spheres to a body, and a longer search; larger ones do not fit.
constexpr double kRadius = 0.25;

// From the sheet to slots without ice [m]: beyond every neighbour list. Nothing else depends on it.
constexpr double kParked = 1000.0;

}  // namespace

PrismSpec prism_spec(const Case& p) {
    const LevelIce& ice = p.level_ice;
    const double radius = kRadius * ice.thickness;
    // a corner's disc represents its radius of both faces: finer discs, finer sections
    return {ice.thickness, 0.0, p.dimension == 2 ? std::min(radius, ice.spacing) : radius,
            ice.spacing, true};
}

std::optional<Shape> shape_of(const Loop& outline, const PrismSpec& prism, EdgeBody as) {
    Loop centred;
    const Vec2 centre = centroid_of(outline);
    for (const Vec2& p : outline) centred.push_back(p - centre);
    try {
        if (as == EdgeBody::strip)
            return build_shape(fill_strip(strip_length(outline), prism), true);
        Shape shape = build_shape(fill_prism(centred, prism), true);
        shape.parts = prism_parts(centred, prism.thickness);
        return shape;
    } catch (const Error&) {
        return std::nullopt;
    }
}

Vec2 parked_at(const Eigen::AlignedBox2d& sheet, double thickness, std::size_t slot) {
    return {sheet.max().x() + kParked + 2.0 * thickness * static_cast<double>(slot), 0.0};
}

bool can_be_filled(const Loop& outline, double thickness) {
    return !shrunk(outline, kLeastHalfBreadth * thickness, 0.0, kNearest).empty();
}

}  // namespace ice
