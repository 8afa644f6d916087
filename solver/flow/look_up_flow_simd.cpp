// SPDX-License-Identifier: GPL-3.0-or-later
// Looks into a table, compiled once per instruction set.
#include "solver/flow/look_up_flow.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/flow/look_up_flow_simd.cpp"
#include <hwy/foreach_target.h>  // must precede highway.h
#include <hwy/highway.h>

#include "solver/flow/look_up_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

void LookUpFlow(const FlowGrid& grid, std::span<const Vec3> points, std::span<FlowSample> out) {
    for (std::size_t k = 0; k < points.size(); ++k) {
        double value[FlowGrid::kNumbers];
        // One point at a time: the four numbers of a node fill the lanes. Loads look up eight
        // points at a time with the same order of sums (flow_near_lanes-inl.hpp).
        LookUp(grid, points[k].x(), points[k].y(), points[k].z(), value);
        out[k].velocity = Vec3(value[0], value[1], value[2]);
        out[k].potential = value[3];
    }
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ice {
HWY_EXPORT(LookUpFlow);

void look_up_flow(const FlowGrid& grid, std::span<const Vec3> points, std::span<FlowSample> out) {
    HWY_DYNAMIC_DISPATCH(LookUpFlow)(grid, points, out);
}
}  // namespace ice
#endif
