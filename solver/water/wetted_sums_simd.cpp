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

// 12 int p z n_z dA of whole triangles; `area` is that of their projection on the water.
HWY_INLINE Vectors WholeMoments(const Cut& h, const Vectors (&corner)[3], Lanes area, Lanes sum) {
    const Vectors products =
        Add(Add(Scale(h.z0, corner[0]), Scale(h.z1, corner[1])), Scale(h.z2, corner[2]));
    const Vectors corners = Add(Add(corner[0], corner[1]), corner[2]);
    return Scale(area, Add(Scale(sum, corners), products));
}

// The corners' sum of the cut-off tips, and the apex once more: only its height is not 0.
HWY_INLINE Vectors TipCorners(const Cut& h, const Tip& tip, const Vectors (&corner)[3]) {
    const auto from = [&](int a, int b, int c) HWY_ATTR {
        return Choose(h.first, corner[a], Choose(h.second, corner[b], corner[c]));
    };
    const Vectors p = from(0, 1, 2), q = from(1, 2, 0), r = from(2, 0, 1);
    return Add(Scale(hn::Set(Tag(), 4.0), p),
               Add(Scale(tip.next, Sub(q, p)), Scale(tip.last, Sub(r, p))));
}

WettedIntegrals IntegrateWetted(const FacetBlocks& facets, const WaterPlane& water) {
    const Tag d;
    const Water plane(water);
    WettedIntegrals out;
    Sum volume;
    VectorSum first;
    for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(d)) {
        Lanes v = hn::Zero(d);
        Vectors m = Zero();
        for (const FacetBlock& block : facets.blocks) {
            const Cut h = CutByWater(block, lane, plane);
            out.any_dry |= !hn::AllTrue(d, h.AllInside());
            if (hn::AllFalse(d, h.AnyInside())) continue;
            out.any_wet = true;
            const Vectors corner[3] = {Get(block.corner[0], lane), Get(block.corner[1], lane),
                                       Get(block.corner[2], lane)};
            const Lanes area = Dot(plane.up, Get(block.area, lane));
            const Tip tip(h);
            const Mask whole = CountsWhole(h, tip);
            const Lanes sum = hn::Add(hn::Add(h.z0, h.z1), h.z2);
            v = hn::Add(v, hn::IfThenElseZero(whole, hn::Mul(area, sum)));
            m = Add(m, Only(whole, WholeMoments(h, corner, area, sum)));
            if (hn::AllFalse(d, h.any)) continue;
            const Lanes size = hn::Mul(hn::Mul(tip.next, tip.last), hn::Mul(area, tip.z));
            const Lanes part = hn::IfThenElse(tip.inside, size, hn::Neg(size));
            v = hn::Add(v, hn::IfThenElseZero(h.any, part));
            m = Add(m, Only(h.any, Scale(part, TipCorners(h, tip, corner))));
        }
        volume.Put(v, lane);
        first.Put(m, lane);
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
