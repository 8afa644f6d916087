// SPDX-License-Identifier: GPL-3.0-or-later
// Drag on floes of one shape in the ship's flow, in lanes as in afloat_lanes-inl.hpp.
#if defined(ICE_FLOW_DRAG_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_FLOW_DRAG_LANES_INL
#undef ICE_FLOW_DRAG_LANES_INL
#else
#define ICE_FLOW_DRAG_LANES_INL
#endif

#include <hwy/highway.h>

#include "solver/loads/flow_near_lanes-inl.hpp"
#include "solver/water/relative_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

// Velocity relative to the water at the places of FlowNear, body axes.
class RelativeVelocities {
public:
    HWY_INLINE RelativeVelocities(const Afloat& floes, const WaterFlow& water, const FlowNear& near)
        : floes_(floes),
          water_(water),
          near_(near),
          v_(TransposedProduct(floes.rotation, floes.velocity)),
          w_(TransposedProduct(floes.rotation, floes.angular_velocity)) {}
    HWY_INLINE Vectors At(std::size_t k) const {
        const Vectors water = TransposedProduct(floes_.rotation, WaterOf(water_, near_.At(k)));
        return Sub(Add(v_, Cross(w_, Set(near_.Point(k)))), water);
    }

private:
    const Afloat& floes_;
    const WaterFlow& water_;
    const FlowNear& near_;
    Vectors v_, w_;
};

struct RelativeLoad : Load {
    Lanes loss;  // power lost in the motion through the water [W]
};

// projected_drag() in moving water: all of it as in the middle of the floe
HWY_INLINE RelativeLoad ProjectedDragInFlow(const Afloat& floes, const Case& p,
                                            const WaterFlow& water) {
    const Vectors u = Sub(floes.velocity, WaterAt(water, floes.position));
    const Load drag = ProjectedDrag(floes, p, u);
    return {drag, hn::Neg(Dot(drag.force, u))};
}

// relative_drag()
HWY_INLINE RelativeLoad PanelDragInFlow(const Afloat& floes, const Case& p, const WaterFlow& water,
                                        const FlowNear& near) {
    const RelativeVelocities u(floes, water, near);
    const RelativeSums sums =
        IntegrateRelative(floes.shape, Water(floes.rotation.row[2], floes.height), u);
    const auto part = [](Vectors v, double of) HWY_ATTR {
        return Vectors{hn::Div(v.x, All(of)), hn::Div(v.y, All(of)), hn::Div(v.z, All(of))};
    };
    const Lanes factor = All(-0.5 * p.water_density * p.drag_coefficient);
    const Matrices& r = floes.rotation;
    const Matrices turn{
        {Scale(factor, r.row[0]), Scale(factor, r.row[1]), Scale(factor, r.row[2])}};
    return {{Product(turn, part(sums.force, 12.0)), Product(turn, part(sums.moment, 60.0))},
            hn::Mul(hn::Neg(factor), hn::Div(sums.loss, All(60.0)))};
}

// drag_in_flow()
HWY_INLINE RelativeLoad DragInFlow(const Afloat& floes, const Case& p, const WaterFlow& water,
                                   const FlowNear& near, const Matrices& inverse_inertia) {
    RelativeLoad drag{{Zero(), Zero()}, hn::Zero(Tag())};
    if (p.drag == DragModel::projected) drag = ProjectedDragInFlow(floes, p, water);
    if (p.drag == DragModel::panel) drag = PanelDragInFlow(floes, p, water, near);
    const Lanes left = LimitOf(drag, floes, inverse_inertia, drag.loss, All(p.time_step));
    drag.force = Scale(left, drag.force);
    drag.moment = Scale(left, drag.moment);
    drag.loss = hn::Mul(drag.loss, left);
    return drag;
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
