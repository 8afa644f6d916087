// SPDX-License-Identifier: GPL-3.0-or-later
// Loads on floes of one form, as many at a time as the machine has lanes, compiled once per
// instruction set. The mathematics is in load_floes_reference.cpp, drag.cpp and hydrostatics.cpp.
// Mul then Add, not MulAdd: a fused product would differ from it.
#include "solver/integrate/load_floes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/integrate/load_floes_simd.cpp"
#include <hwy/foreach_target.h>  // must precede highway.h
#include <hwy/highway.h>

#include "solver/flow/look_up_lanes-inl.hpp"
#include "solver/scene/body_lanes-inl.hpp"
#include "solver/water/floating_lanes-inl.hpp"
#include "solver/water/relative_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

HWY_INLINE Lanes Length(Vectors v) { return hn::Sqrt(Dot(v, v)); }

// Floes of one form and what the loads ask of them.
struct Afloat {
    const Shape& shape;
    Matrices rotation;
    Vectors position;
    Lanes height, mass;
    Vectors velocity, angular_velocity;
    FormHeights heights;

    HWY_INLINE Afloat(const Shape& form, const Bodies& b, const BodyLanes& at)
        : shape(form),
          rotation(RotationOf(at.Load(b.orientation))),
          position(at.Load(b.position)),
          height(position.z),
          mass(at.Load(b.mass)),
          velocity(at.Load(b.velocity)),
          angular_velocity(at.Load(b.angular_velocity)),
          heights(form, Water(rotation.row[2], height)) {}
    HWY_INLINE Mask Clear() const { return hn::Ge(height, All(shape.bounding_radius)); }
};

struct Load {
    Vectors force, moment;
};

// projected_drag()
HWY_INLINE Load ProjectedDrag(const Afloat& floes, const Case& p) {
    const Mask drags = hn::AndNot(floes.Clear(), NotZero(floes.velocity));
    if (hn::AllFalse(Tag(), drags)) return {Zero(), Zero()};
    const Vectors v = TransposedProduct(floes.rotation, floes.velocity);
    const Lanes flow = IntegrateFloatingFacing(floes.heights, v);
    const Lanes factor = hn::Mul(All(-0.5 * p.water_density * p.drag_coefficient), flow);
    return {Only(drags, Scale(factor, floes.velocity)), Zero()};
}

// panel_drag()
HWY_INLINE Load PanelDrag(const Afloat& floes, const Case& p) {
    const Mask moves = hn::Or(NotZero(floes.velocity), NotZero(floes.angular_velocity));
    const Mask drags = hn::AndNot(floes.Clear(), moves);
    if (hn::AllFalse(Tag(), drags)) return {Zero(), Zero()};
    const Vectors v = TransposedProduct(floes.rotation, floes.velocity);
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
            const Vectors u = Ask(k);
            if (few_) u_[k] = u;
            square = hn::Max(square, Dot(u, u));
        }
        fastest_ = hn::Sqrt(square);
    }
    HWY_INLINE Vectors operator()(std::size_t vertex) const {
        return few_ ? u_[vertex] : Ask(vertex);
    }
    HWY_INLINE Lanes Fastest() const { return fastest_; }

private:
    static constexpr std::size_t kFew = 64;

    HWY_INLINE Vectors Ask(std::size_t vertex) const {
        const Vectors p = Set(floes_.shape.mesh.vertices[vertex]);
        const Vectors at = Add(floes_.position, Product(floes_.rotation, p));
        const Vectors water = TransposedProduct(floes_.rotation, WaterAt(water_, at));
        return Sub(Add(v_, Cross(w_, p)), water);
    }

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
    const RelativeSums sums = IntegrateRelative(floes.shape, floes.heights, u);
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

// No longer than what stops within the step.
HWY_INLINE Vectors Limited(Vectors load, Lanes stop, Lanes dt) {
    const Lanes push = hn::Mul(dt, Length(load));
    const Mask over = hn::Gt(push, stop);
    if (hn::AllFalse(Tag(), over)) return load;
    return Choose(over, Scale(hn::Div(stop, push), load), load);
}

// drag_at_rest()
HWY_INLINE Load DragAtRest(const Afloat& floes, const Case& p, const Matrices& inertia) {
    const Lanes dt = All(p.time_step);
    Load drag{Zero(), Zero()};
    if (p.drag == DragModel::projected) drag = ProjectedDrag(floes, p);
    if (p.drag == DragModel::panel) drag = PanelDrag(floes, p);
    drag.force = Limited(drag.force, hn::Mul(floes.mass, Length(floes.velocity)), dt);
    if (p.drag == DragModel::panel) {
        const Vectors spin = Turned(floes.rotation, inertia, floes.angular_velocity);
        drag.moment = Limited(drag.moment, Length(spin), dt);
    }
    return drag;
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

// measure_submerged()
struct Buoyancy {
    Lanes volume;
    Vectors centre;

    HWY_INLINE explicit Buoyancy(const Afloat& floes) {
        const Tag d;
        const Shape& shape = floes.shape;
        const Lanes height = floes.height;
        const Mask above_deep = hn::Gt(height, All(-shape.bounding_radius));
        const FloatingWetted wet = IntegrateFloating(floes.heights);
        const Mask whole = hn::Not(hn::Or(floes.Clear(), hn::And(above_deep, wet.any_dry)));
        const Mask part = hn::AndNot(hn::Or(floes.Clear(), whole),
                                     hn::And(wet.any_wet, hn::Gt(wet.volume, hn::Zero(d))));
        const Lanes moment = hn::Mul(
            All(0.5), hn::Add(Dot(floes.heights.Up(), wet.first), hn::Mul(height, wet.volume)));
        const Vectors at = Sub(wet.first, Scale(moment, floes.heights.Up()));
        const Vectors cut{hn::Div(at.x, wet.volume), hn::Div(at.y, wet.volume),
                          hn::Div(at.z, wet.volume)};
        const Vectors in_body = Choose(whole, Set(shape.solid.centroid), cut);
        const Mask any = hn::Or(whole, part);
        volume =
            hn::IfThenElseZero(any, hn::IfThenElse(whole, All(shape.solid.volume), wet.volume));
        centre = Only(any, Product(floes.rotation, in_body));
    }
};

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

HWY_INLINE Vectors InPlane(Vectors force) { return {force.x, hn::Zero(Tag()), force.z}; }
HWY_INLINE Vectors AboutPlane(Vectors moment) {
    return {hn::Zero(Tag()), moment.y, hn::Zero(Tag())};
}

// Of no more floes than there are lanes, all of one form.
void LoadPart(const Scene& scene, const Case& p, std::span<const std::int32_t> ids,
              std::span<FloeLoad> out) {
    const Tag d;
    const Bodies& b = scene.bodies;
    const BodyLanes at(ids);
    const auto form = static_cast<std::size_t>(b.shape[static_cast<std::size_t>(ids[0])]);
    const Afloat floes(scene.shapes[form], b, at);
    const Matrices inertia = at.Load(b, &Inertia::body);

    const Mask flows = InFlow(scene.water, floes);
    Load drag{Zero(), Zero()};
    Lanes water_power = hn::Zero(d);
    if (!hn::AllTrue(d, flows)) drag = DragAtRest(floes, p, inertia);
    if (!hn::AllFalse(d, flows)) {
        const RelativeLoad moved = DragInFlow(floes, p, scene.water, inertia);
        drag = {Choose(flows, moved.force, drag.force), Choose(flows, moved.moment, drag.moment)};
        const Lanes work =
            hn::Add(Dot(moved.force, floes.velocity), Dot(moved.moment, floes.angular_velocity));
        water_power = hn::IfThenElseZero(flows, hn::Add(work, moved.loss));
    }
    Load all = drag;
    all.force.z = hn::Sub(all.force.z, hn::Mul(floes.mass, All(p.gravity)));
    Vectors righting = Zero();
    if (p.buoyancy != BuoyancyModel::none) {
        const Buoyancy wet(floes);
        const Vectors lift{hn::Zero(d), hn::Zero(d),
                           hn::Mul(All(p.water_density * p.gravity), wet.volume)};
        all.force = Add(all.force, lift);
        righting = Cross(wet.centre, lift);
        if (p.buoyancy == BuoyancyModel::distributed) all.moment = Add(all.moment, righting);
    }
    if (scene.dimension == 2) {
        all = {InPlane(all.force), AboutPlane(all.moment)};
        drag = {InPlane(drag.force), AboutPlane(drag.moment)};
    }

    const Vectors parts[5] = {all.force, all.moment, drag.force, drag.moment, righting};
    HWY_ALIGN double value[5][3 * kMostLanes];
    for (int k = 0; k < 5; ++k)
        hn::StoreInterleaved3(parts[k].x, parts[k].y, parts[k].z, d, value[k]);
    HWY_ALIGN double power[kMostLanes];
    hn::Store(water_power, d, power);
    for (std::size_t k = 0; k < ids.size(); ++k) {
        out[k].water_power = power[k];
        Vec3* const of_floe[5] = {&out[k].force, &out[k].moment, &out[k].drag.force,
                                  &out[k].drag.moment, &out[k].righting};
        for (int n = 0; n < 5; ++n)
            std::memcpy(of_floe[n]->data(), value[n] + 3 * k, 3 * sizeof(double));
    }
}

void LoadFloes(const Scene& scene, const Case& parameters, std::span<const std::int32_t> floes,
               std::span<FloeLoad> out) {
    const auto form_of = [&](std::size_t k) {
        return scene.bodies.shape[static_cast<std::size_t>(floes[k])];
    };
    for (std::size_t first = 0; first < floes.size();) {
        std::size_t last = first + 1;
        while (last < floes.size() && last < first + kMostLanes && form_of(last) == form_of(first))
            ++last;
        const auto some = floes.subspan(first, last - first);
        const auto loads = out.subspan(first, last - first);
        // in lanes one floe takes as long as many
        if (some.size() == 1)
            reference::load_floes(scene, parameters, some, loads);
        else
            LoadPart(scene, parameters, some, loads);
        first = last;
    }
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ice {
HWY_EXPORT(LoadFloes);

void load_floes(const Scene& scene, const Case& parameters, std::span<const std::int32_t> floes,
                std::span<FloeLoad> out) {
    HWY_DYNAMIC_DISPATCH(LoadFloes)(scene, parameters, floes, out);
}
}  // namespace ice
#endif
