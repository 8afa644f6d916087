// SPDX-License-Identifier: GPL-3.0-or-later
// Floes of one shape in lanes, and their drag in an even current, to the bits of
// load_floes_reference.cpp. Included once per instruction set, hence the guard that lets it in
// again for each. Mul then Add, not MulAdd: a fused product would differ from it.
#if defined(ICE_AFLOAT_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_AFLOAT_LANES_INL
#undef ICE_AFLOAT_LANES_INL
#else
#define ICE_AFLOAT_LANES_INL
#endif

#include <hwy/highway.h>

#include "solver/case/case.hpp"
#include "solver/scene/body_lanes-inl.hpp"
#include "solver/water/floating_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

// Floes of one shape and what the loads need of them: heights [m], mass [kg], velocities [m/s],
// [rad/s], one floe per lane.
struct Afloat {
    const Shape& shape;
    Matrices rotation;
    Vectors position;
    Lanes height, mass;
    Vectors velocity, angular_velocity;
    FormHeights heights;

    HWY_INLINE Afloat(const Shape& of, const Bodies& b, const BodyLanes& at)
        : shape(of),
          rotation(RotationOf(at.Load(b.orientation))),
          position(at.Load(b.position)),
          height(position.z),
          mass(at.Load(b.mass)),
          velocity(at.Load(b.velocity)),
          angular_velocity(at.Load(b.angular_velocity)),
          heights(of, Water(rotation.row[2], height)) {}
    HWY_INLINE Mask Clear() const { return hn::Ge(height, All(shape.bounding_radius)); }
};

// World axes [N], [N m].
struct Load {
    Vectors force, moment;
};

// projected_drag() at velocities u through the water
HWY_INLINE Load ProjectedDrag(const Afloat& floes, const Case& p, Vectors u) {
    const Mask drags = hn::AndNot(floes.Clear(), NotZero(u));
    if (hn::AllFalse(Tag(), drags)) return {Zero(), Zero()};
    const Vectors v = TransposedProduct(floes.rotation, u);
    const Lanes flow = IntegrateFloatingFacing(floes.heights, v);
    const Lanes factor = hn::Mul(All(-0.5 * p.water_density * p.drag_coefficient), flow);
    return {Only(drags, Scale(factor, u)), Zero()};
}

// panel_drag() in lanes
HWY_INLINE Load PanelDrag(const Afloat& floes, const Case& p, Vectors u) {
    const Mask moves = hn::Or(NotZero(u), NotZero(floes.angular_velocity));
    const Mask drags = hn::AndNot(floes.Clear(), moves);
    if (hn::AllFalse(Tag(), drags)) return {Zero(), Zero()};
    const Vectors v = TransposedProduct(floes.rotation, u);
    const Vectors w = TransposedProduct(floes.rotation, floes.angular_velocity);
    const Facing met = IntegrateFloatingFacing(floes.heights, v, w);
    const Vectors force = Add(Scale(met.flow, v), Cross(w, met.first));
    const Matrices second{{{met.square.x, met.mixed.x, met.mixed.y},
                           {met.mixed.x, met.square.y, met.mixed.z},
                           {met.mixed.y, met.mixed.z, met.square.z}}};
    const Lanes total = hn::Add(hn::Add(met.square.x, met.square.y), met.square.z);
    const Vectors moment = Sub(Add(Cross(met.first, v), Scale(total, w)), Product(second, w));
    const Lanes factor = All(-0.5 * p.water_density * p.drag_coefficient);
    const Matrices& r = floes.rotation;
    const Matrices turn{
        {Scale(factor, r.row[0]), Scale(factor, r.row[1]), Scale(factor, r.row[2])}};
    return {Only(drags, Product(turn, force)), Only(drags, Product(turn, moment))};
}

// limit_drag(): the share of the drag that is left
HWY_INLINE Lanes LimitOf(const Load& drag, const Afloat& floes, const Matrices& inverse_inertia,
                         Lanes lost, Lanes dt) {
    const Lanes turned = Dot(drag.moment, Turned(floes.rotation, inverse_inertia, drag.moment));
    const Lanes gained =
        hn::Mul(dt, hn::Add(hn::Div(Dot(drag.force, drag.force), floes.mass), turned));
    const Lanes left = hn::IfThenElseZero(hn::Gt(lost, hn::Zero(Tag())), hn::Div(lost, gained));
    return hn::IfThenElse(hn::Gt(gained, lost), left, All(1.0));
}

// drag_in_current()
HWY_INLINE Load DragInCurrent(const Afloat& floes, const Case& p, const Vec3& current,
                              const Matrices& inverse_inertia) {
    const Vectors u = Sub(floes.velocity, Set(current));
    Load drag{Zero(), Zero()};
    if (p.drag == DragModel::projected) drag = ProjectedDrag(floes, p, u);
    if (p.drag == DragModel::panel) drag = PanelDrag(floes, p, u);
    const Lanes lost =
        hn::Neg(hn::Add(Dot(drag.force, u), Dot(drag.moment, floes.angular_velocity)));
    const Lanes left = LimitOf(drag, floes, inverse_inertia, lost, All(p.time_step));
    return {Scale(left, drag.force), Scale(left, drag.moment)};
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
