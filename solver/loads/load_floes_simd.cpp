// SPDX-License-Identifier: GPL-3.0-or-later
// Loads on floes of one shape, as many at a time as the machine has lanes, compiled once per
// instruction set. The mathematics is in load_floes_reference.cpp, drag.cpp and hydrostatics.cpp.
// Mul then Add, not MulAdd: a fused product would differ from it.
#include "common/base/assert.hpp"
#include "solver/loads/load_floes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/loads/load_floes_simd.cpp"
#include <hwy/foreach_target.h>  // must precede highway.h
#include <hwy/highway.h>

#include "solver/loads/afloat_lanes-inl.hpp"
#include "solver/loads/flow_drag_lanes-inl.hpp"
#include "solver/loads/flow_pressure_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

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
        // Lanes differ: clear of the water, wholly under it, or cut by it. All sums are computed
        // for all lanes and chosen afterwards, as the reference returns early for each floe by
        // itself.
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

// 2D: motion along x and z and about y alone.
HWY_INLINE Vectors InPlane(Vectors force) { return {force.x, hn::Zero(Tag()), force.z}; }
HWY_INLINE Vectors AboutPlane(Vectors moment) {
    return {hn::Zero(Tag()), moment.y, hn::Zero(Tag())};
}

// Loads of the ship's flow on floes. @pre scene.water.flows()
struct FlowLoads {
    RelativeLoad drag;
    Load pressure;
};
HWY_INLINE FlowLoads LoadsInFlow(const Scene& scene, const Case& p, const Afloat& floes,
                                 const Matrices& inverse_inertia) {
    ICE_ASSERT(scene.water.flows());
    const FlowNear near(floes, scene.water);
    FlowLoads out{DragInFlow(floes, p, scene.water, near, inverse_inertia), {Zero(), Zero()}};
    if (!scene.water.presses) return out;
    out.pressure = PressureInFlow(floes, p, scene.water, near);
    if (scene.dimension == 2)
        out.pressure = {InPlane(out.pressure.force), AboutPlane(out.pressure.moment)};
    return out;
}

// From one register per component to one vector per floe, as the ledger reads them.
// @param righting  moment of buoyancy
HWY_INLINE void StoreLoads(const Load& all, const Load& drag, const Load& pressure,
                           const Vectors& righting, Lanes water_power, std::span<FloeLoad> out) {
    const Tag d;
    const Vectors parts[7] = {all.force, all.moment,     drag.force,     drag.moment,
                              righting,  pressure.force, pressure.moment};
    HWY_ALIGN double value[7][3 * kMostLanes];
    for (int k = 0; k < 7; ++k)
        hn::StoreInterleaved3(parts[k].x, parts[k].y, parts[k].z, d, value[k]);
    HWY_ALIGN double power[kMostLanes];
    hn::Store(water_power, d, power);
    for (std::size_t k = 0; k < out.size(); ++k) {
        out[k].water_power = power[k];
        Vec3* const of_floe[7] = {&out[k].force,          &out[k].moment,   &out[k].drag.force,
                                  &out[k].drag.moment,    &out[k].righting, &out[k].pressure.force,
                                  &out[k].pressure.moment};
        for (int n = 0; n < 7; ++n)
            std::memcpy(of_floe[n]->data(), value[n] + 3 * k, 3 * sizeof(double));
    }
}

// Of no more floes than there are lanes, all of one shape.
void LoadPart(const Scene& scene, const Case& p, std::span<const std::int32_t> ids,
              std::span<FloeLoad> out) {
    const Tag d;
    const Bodies& b = scene.bodies;
    const BodyLanes at(ids);
    const auto shape = static_cast<std::size_t>(b.shape[static_cast<std::size_t>(ids[0])]);
    const Afloat floes(scene.shapes[shape], b, at);
    const Matrices inverse_inertia = at.Load(b, &Inertia::inverse);

    const Mask flows = InFlow(scene.water, floes);
    // Lanes in the flow and lanes outside it are computed apart, each kind where a lane has it,
    // and chosen lane by lane: a floe's load does not depend on its neighbours in the register.
    Load drag{Zero(), Zero()}, pressure{Zero(), Zero()};
    Lanes water_power = hn::Zero(d);
    if (!hn::AllTrue(d, flows)) {
        drag = DragInCurrent(floes, p, scene.water.current, inverse_inertia);
        water_power = Dot(drag.force, Set(scene.water.current));
    }
    if (!hn::AllFalse(d, flows)) {
        const FlowLoads in_flow = LoadsInFlow(scene, p, floes, inverse_inertia);
        const RelativeLoad& moved = in_flow.drag;
        pressure = {Only(flows, in_flow.pressure.force), Only(flows, in_flow.pressure.moment)};
        drag = {Choose(flows, moved.force, drag.force), Choose(flows, moved.moment, drag.moment)};
        const Lanes work =
            hn::Add(Dot(moved.force, floes.velocity), Dot(moved.moment, floes.angular_velocity));
        water_power = hn::IfThenElse(flows, hn::Add(work, moved.loss), water_power);
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

    if (scene.water.presses)
        all = {Add(all.force, pressure.force), Add(all.moment, pressure.moment)};
    StoreLoads(all, drag, pressure, righting, water_power, out);
}

void LoadFloes(const Scene& scene, const Case& parameters, std::span<const std::int32_t> floes,
               std::span<FloeLoad> out) {
    const auto shape_of = [&](std::size_t k) {
        return scene.bodies.shape[static_cast<std::size_t>(floes[k])];
    };
    // Runs of floes of one shape: they share the mesh, whose triangles are then read once for
    // all.
    for (std::size_t first = 0; first < floes.size();) {
        std::size_t last = first + 1;
        while (last < floes.size() && last < first + kMostLanes &&
               shape_of(last) == shape_of(first))
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
