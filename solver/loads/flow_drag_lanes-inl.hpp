// SPDX-License-Identifier: GPL-3.0-or-later
// Drag on floes of one form in moving water, in lanes as in afloat_lanes-inl.hpp.
#if defined(ICE_FLOW_DRAG_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_FLOW_DRAG_LANES_INL
#undef ICE_FLOW_DRAG_LANES_INL
#else
#define ICE_FLOW_DRAG_LANES_INL
#endif

#include <hwy/highway.h>

#include "solver/flow/look_up_lanes-inl.hpp"
#include "solver/loads/afloat_lanes-inl.hpp"
#include "solver/water/relative_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

// reference::water_at()
HWY_INLINE Vectors WaterAt(const WaterFlow& water, Vectors x) {
    const Tag d;
    if (!water.flows()) return Set(water.current);
    HWY_ALIGN double at[3][kMostLanes], flow[3][kMostLanes];
    hn::Store(hn::Sub(x.x, All(water.ship.x())), d, at[0]);
    hn::Store(hn::Sub(x.y, All(water.ship.y())), d, at[1]);
    hn::Store(x.z, d, at[2]);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k) {
        double value[FlowGrid::kNumbers];
        LookUp(water.grid, at[0][k], at[1][k], at[2][k], value);
        for (int axis = 0; axis < 3; ++axis) flow[axis][k] = value[axis];
    }
    const Lanes speed = All(water.speed);
    return Add(Set(water.current),
               {hn::Mul(speed, hn::Load(d, flow[0])), hn::Mul(speed, hn::Load(d, flow[1])),
                hn::Mul(speed, hn::Load(d, flow[2]))});
}

// Velocity relative to the water at a form's vertices, body axes. Triangles share theirs: where a
// form has few, each is asked for once.
class RelativeVelocities {
public:
    HWY_INLINE RelativeVelocities(const Afloat& floes, const WaterFlow& water)
        : floes_(floes),
          water_(water),
          v_(TransposedProduct(floes.rotation, floes.velocity)),
          w_(TransposedProduct(floes.rotation, floes.angular_velocity)) {
        const std::size_t count = floes.shape.mesh.vertices.size();
        few_ = count <= kFew;
        Lanes square = hn::Zero(Tag());
        for (std::size_t k = 0; k < count; ++k) {
            const Vectors u = At(floes.shape.mesh.vertices[k]);
            if (few_) u_[k] = u;
            square = hn::Max(square, Dot(u, u));
        }
        fastest_ = hn::Sqrt(square);
    }
    HWY_INLINE Vectors AtVertex(std::size_t vertex) const {
        return few_ ? u_[vertex] : At(floes_.shape.mesh.vertices[vertex]);
    }
    HWY_INLINE Vectors At(const Vec3& point) const {
        const Vectors p = Set(point);
        const Vectors at = Add(floes_.position, Product(floes_.rotation, p));
        const Vectors water = TransposedProduct(floes_.rotation, WaterAt(water_, at));
        return Sub(Add(v_, Cross(w_, p)), water);
    }
    HWY_INLINE Lanes Fastest() const { return fastest_; }

private:
    static constexpr std::size_t kFew = 64;

    const Afloat& floes_;
    const WaterFlow& water_;
    Vectors v_, w_;
    Lanes fastest_;
    bool few_;
    Vectors u_[kFew];
};

struct RelativeLoad : Load {
    Lanes loss, fastest;
};

// projected_drag() in moving water: all of it as in the middle of the floe
HWY_INLINE RelativeLoad ProjectedDragInFlow(const Afloat& floes, const Case& p,
                                            const WaterFlow& water) {
    Afloat relative = floes;
    relative.velocity = Sub(floes.velocity, WaterAt(water, floes.position));
    const Vectors u = relative.velocity;
    const Load drag = ProjectedDrag(relative, p);
    return {drag, hn::Neg(Dot(drag.force, u)), Length(u)};
}

// relative_drag()
HWY_INLINE RelativeLoad PanelDragInFlow(const Afloat& floes, const Case& p,
                                        const WaterFlow& water) {
    const RelativeVelocities u(floes, water);
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
            hn::Mul(hn::Neg(factor), hn::Div(sums.loss, All(60.0))),
            u.Fastest()};
}

// drag_in_flow()
HWY_INLINE RelativeLoad DragInFlow(const Afloat& floes, const Case& p, const WaterFlow& water,
                                   const Matrices& inertia) {
    const Lanes dt = All(p.time_step);
    RelativeLoad drag{{Zero(), Zero()}, hn::Zero(Tag()), hn::Zero(Tag())};
    if (p.drag == DragModel::projected) drag = ProjectedDragInFlow(floes, p, water);
    if (p.drag == DragModel::panel) drag = PanelDragInFlow(floes, p, water);
    const Lanes stop = hn::Mul(floes.mass, drag.fastest), push = hn::Mul(dt, Length(drag.force));
    const Mask over = hn::Gt(push, stop);
    const Lanes part = hn::IfThenElse(over, hn::Div(stop, push), All(1.0));
    drag.force = Scale(part, drag.force);
    drag.loss = hn::Mul(drag.loss, part);
    const Vectors spin = Turned(floes.rotation, inertia, floes.angular_velocity);
    const Lanes halt = hn::Add(Length(spin), hn::Mul(All(floes.shape.bounding_radius), stop));
    drag.moment = Limited(drag.moment, halt, dt);
    return drag;
}

// The floes around which the water may move.
HWY_INLINE Mask InFlow(const WaterFlow& water, const Afloat& floes) {
    const Tag d;
    if (water.still()) return hn::FirstN(d, 0);
    HWY_ALIGN double at[3][kMostLanes], in[kMostLanes];
    hn::Store(floes.position.x, d, at[0]);
    hn::Store(floes.position.y, d, at[1]);
    hn::Store(floes.position.z, d, at[2]);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k)
        in[k] = water.reaches(Vec3(at[0][k], at[1][k], at[2][k]), floes.shape.bounding_radius)
                    ? 1.0
                    : 0.0;
    return hn::Gt(hn::Load(d, in), hn::Zero(d));
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
