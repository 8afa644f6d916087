// SPDX-License-Identifier: GPL-3.0-or-later
// The flow's dynamic pressure on floes of one shape, in lanes as in afloat_lanes-inl.hpp.
#if defined(ICE_FLOW_PRESSURE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_FLOW_PRESSURE_LANES_INL
#undef ICE_FLOW_PRESSURE_LANES_INL
#else
#define ICE_FLOW_PRESSURE_LANES_INL
#endif

#include <hwy/highway.h>

#include "solver/loads/flow_near_lanes-inl.hpp"
#include "solver/water/pressure_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

// water_density times reference::pressure_at() at the places of FlowNear. @pre water.flows()
class Pressures {
public:
    HWY_INLINE Pressures(const WaterFlow& water, const FlowNear& near, double water_density)
        : near_(near), square_(All(water.speed * water.speed)), density_(All(water_density)) {}
    HWY_INLINE Lanes At(std::size_t k) const {
        const Vectors g = near_.At(k);
        const Lanes half = hn::Mul(All(0.5), Dot(g, g));
        return hn::Mul(density_, hn::Mul(square_, hn::Sub(g.x, half)));
    }

private:
    const FlowNear& near_;
    Lanes square_, density_;
};

// flow_pressure() of floes that the flow reaches
HWY_INLINE Load PressureInFlow(const Afloat& floes, const Case& p, const WaterFlow& water,
                               const FlowNear& near) {
    const Pressed load = IntegratePressure(floes.shape, Water(floes.rotation.row[2], floes.height),
                                           Pressures(water, near, p.water_density));
    return {Product(floes.rotation, load.force), Product(floes.rotation, load.moment)};
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
