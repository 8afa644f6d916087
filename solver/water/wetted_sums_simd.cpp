// SPDX-License-Identifier: GPL-3.0-or-later
// Integrals over wetted surfaces, compiled once per instruction set. The mathematics is in
// wetted_sums_reference.cpp. Mul then Add, not MulAdd: a fused product would differ from it.
#include "solver/water/wetted_sums.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/water/wetted_sums_simd.cpp"
#include <hwy/foreach_target.h>  // must precede highway.h
#include <hwy/highway.h>

#include "solver/water/facet_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

WettedIntegrals IntegrateWetted(const FacetBlocks& facets, const WaterPlane& water) {
    const Tag d;
    const Water plane(water);
    WettedIntegrals out;
    Sum volume;
    VectorSum first;
    // A block has the facets of all lanes of the widest instruction set. Narrower sets go through
    // the blocks once per group of lanes, so that each lane sums the same facets in the same order.
    for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(d)) {
        Wetted sum;
        for (const FacetBlock& block : facets.blocks) {
            const Corners corner(block, lane);
            const Cut h = CutByWater(HeightsOf(corner, plane));
            out.any_dry |= !hn::AllTrue(d, h.AllInside());
            if (hn::AllFalse(d, h.AnyInside())) continue;
            out.any_wet = true;
            sum.Add(h, corner, Dot(plane.up, Get(block.area, lane)));
        }
        volume.Put(sum.volume, lane);
        first.Put(sum.first, lane);
    }
    out.volume = volume.Total() / 3.0;
    out.first = first.Totals() / 12.0;
    return out;
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ice {
HWY_EXPORT(IntegrateWetted);

WettedIntegrals integrate_wetted(const FacetBlocks& facets, const WaterPlane& water) {
    return HWY_DYNAMIC_DISPATCH(IntegrateWetted)(facets, water);
}
}  // namespace ice
#endif
