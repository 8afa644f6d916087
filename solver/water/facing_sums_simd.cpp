// SPDX-License-Identifier: GPL-3.0-or-later
// Integrals over the wetted surface that faces the flow, compiled once per instruction set. The
// mathematics is in wetted_sums_reference.cpp. Mul then Add, not MulAdd: a fused product would
// give other bits.
#include "solver/water/wetted_sums.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/water/facing_sums_simd.cpp"
#include <hwy/foreach_target.h>  // must precede highway.h
#include <hwy/highway.h>

#include "solver/water/facing_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

FacingIntegrals IntegrateFacing(const FacetBlocks& facets, const WaterPlane& water, const Vec3& v,
                                const Vec3& w) {
    const Tag d;
    const Water plane(water);
    const Vectors velocity = Set(v), spin = Set(w);
    Sum flow;
    VectorSum first, square, mixed;
    // each lane sums the same facets in the same order on every instruction set
    for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(d)) {
        Facing sum;
        for (const FacetBlock& block : facets.blocks) {
            const Corners corner(block, lane);
            const Cut h = CutByWater(HeightsOf(corner, plane));
            if (hn::AllFalse(d, h.AnyInside())) continue;
            AddWetted(h, Triangles(corner, Get(block.area, lane), velocity, spin), sum);
        }
        flow.Put(sum.flow, lane);
        first.Put(sum.first, lane);
        square.Put(sum.square, lane);
        mixed.Put(sum.mixed, lane);
    }
    // The common denominators of the exact integrals, once for all triangles.
    return {flow.Total() / 3.0, first.Totals() / 12.0, square.Totals() / 60.0,
            mixed.Totals() / 60.0};
}

double IntegrateFacingEven(const FacetBlocks& facets, const WaterPlane& water, const Vec3& v) {
    const Tag d;
    const Water plane(water);
    const Vectors velocity = Set(v);
    Sum sum;
    for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(d)) {
        Lanes s = hn::Zero(d);
        for (const FacetBlock& block : facets.blocks) {
            const Lanes facing = Dot(Get(block.area, lane), velocity);
            const Mask away = hn::Le(facing, hn::Zero(d));
            if (hn::AllTrue(d, away)) continue;
            const Corners corner(block, lane);
            s = hn::Add(s, hn::IfThenZeroElse(
                               away, hn::Mul(facing, WettedShare(HeightsOf(corner, plane)))));
        }
        sum.Put(s, lane);
    }
    return sum.Total();
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ice {
HWY_EXPORT(IntegrateFacing);
HWY_EXPORT(IntegrateFacingEven);

FacingIntegrals integrate_facing(const FacetBlocks& facets, const WaterPlane& water, const Vec3& v,
                                 const Vec3& w) {
    return HWY_DYNAMIC_DISPATCH(IntegrateFacing)(facets, water, v, w);
}

double integrate_facing(const FacetBlocks& facets, const WaterPlane& water, const Vec3& v) {
    return HWY_DYNAMIC_DISPATCH(IntegrateFacingEven)(facets, water, v);
}
}  // namespace ice
#endif
