// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over wetted surfaces, as many panels of a block at a time as the machine has lanes, compiled
// once per instruction set. The mathematics is in wetted_sums_reference.cpp. Mul then Add, not
// MulAdd: a fused product would differ from the reference.
#include "solver/water/wetted_sums.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/water/wetted_sums_simd.cpp"
#include <hwy/foreach_target.h>  // must precede highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kLanes = PanelBlock::kLanes;

using Tag = hn::CappedTag<double, kLanes>;
using Lanes = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

struct Vectors {
    Lanes x, y, z;
};
HWY_INLINE Vectors Get(const double (&from)[3][kLanes], std::size_t lane) {
    const Tag d;
    return {hn::Load(d, from[0] + lane), hn::Load(d, from[1] + lane), hn::Load(d, from[2] + lane)};
}
HWY_INLINE Vectors Set(const Vec3& v) {
    const Tag d;
    return {hn::Set(d, v[0]), hn::Set(d, v[1]), hn::Set(d, v[2])};
}
HWY_INLINE Vectors Zero() { return {hn::Zero(Tag()), hn::Zero(Tag()), hn::Zero(Tag())}; }
HWY_INLINE Vectors Add(Vectors a, Vectors b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Vectors Sub(Vectors a, Vectors b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vectors Scale(Lanes s, Vectors a) {
    return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
HWY_INLINE Lanes Dot(Vectors a, Vectors b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Vectors Choose(Mask which, Vectors yes, Vectors no) {
    return {hn::IfThenElse(which, yes.x, no.x), hn::IfThenElse(which, yes.y, no.y),
            hn::IfThenElse(which, yes.z, no.z)};
}
HWY_INLINE Vectors Only(Mask which, Vectors v) {
    return {hn::IfThenElseZero(which, v.x), hn::IfThenElseZero(which, v.y),
            hn::IfThenElseZero(which, v.z)};
}

// Partial sums, one for each lane of the blocks.
struct alignas(64) Sum {
    double s[kLanes];

    HWY_INLINE void Put(Lanes value, std::size_t lane) { hn::Store(value, Tag(), s + lane); }
    double Total() const {
        return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
    }
};
struct VectorSum {
    Sum x, y, z;

    HWY_INLINE void Put(Vectors v, std::size_t lane) {
        x.Put(v.x, lane);
        y.Put(v.y, lane);
        z.Put(v.z, lane);
    }
    Vec3 Totals() const { return {x.Total(), y.Total(), z.Total()}; }
};

struct Water {
    Vectors up;
    Lanes height;

    HWY_INLINE explicit Water(const WaterPlane& w)
        : up(Set(w.up)), height(hn::Set(Tag(), w.height)) {}
    HWY_INLINE Lanes HeightOf(Vectors p) const { return hn::Add(Dot(up, p), height); }
};

HWY_INLINE Mask Wet(Lanes z) { return hn::Le(z, hn::Zero(Tag())); }

// The heights of triangles' corners; where the water cuts them, the one of the three that is alone
// on its side is the apex.
struct Heights {
    Lanes z0, z1, z2;
    Mask wet0, wet1, wet2, cut, first,
        second;  // the latter: that corner is the apex, else the third

    HWY_INLINE Heights(const PanelBlock& block, std::size_t lane, const Water& water)
        : z0(water.HeightOf(Get(block.corner[0], lane))),
          z1(water.HeightOf(Get(block.corner[1], lane))),
          z2(water.HeightOf(Get(block.corner[2], lane))),
          wet0(Wet(z0)),
          wet1(Wet(z1)),
          wet2(Wet(z2)) {
        const Mask differ_01 = hn::Xor(wet0, wet1), differ_12 = hn::Xor(wet1, wet2);
        cut = hn::Or(differ_01, differ_12);
        first = hn::AndNot(differ_12, differ_01);
        second = hn::And(differ_01, differ_12);
    }
};

// The cut-off tip: height of the apex, shares of the two edges from there that are on its side.
struct Tip {
    Lanes z, next, last;
    Mask wet;

    HWY_INLINE explicit Tip(const Heights& h)
        : z(hn::IfThenElse(h.first, h.z0, hn::IfThenElse(h.second, h.z1, h.z2))), wet(Wet(z)) {
        const Lanes zq = hn::IfThenElse(h.first, h.z1, hn::IfThenElse(h.second, h.z2, h.z0));
        const Lanes zr = hn::IfThenElse(h.first, h.z2, hn::IfThenElse(h.second, h.z0, h.z1));
        next = hn::Div(z, hn::Sub(z, zq));
        last = hn::Div(z, hn::Sub(z, zr));
    }
};

HWY_INLINE Lanes WettedShare(const PanelBlock& block, std::size_t lane, const Water& water) {
    const Tag d;
    const Lanes one = hn::Set(d, 1.0);
    const Lanes z0 = water.HeightOf(Get(block.corner[0], lane));
    const Lanes z1 = water.HeightOf(Get(block.corner[1], lane));
    const Lanes z2 = water.HeightOf(Get(block.corner[2], lane));
    const Lanes less = hn::Min(z0, z1), more = hn::Max(z0, z1);
    const Lanes low = hn::Min(less, z2), high = hn::Max(more, z2);
    const Lanes middle = hn::Max(less, hn::Min(more, z2));
    // the corner alone on its side, and the one farthest from it
    const Mask tip_is_wet = hn::Gt(middle, hn::Zero(d));
    const Lanes apex = hn::IfThenElse(tip_is_wet, low, high);
    const Lanes other = hn::IfThenElse(tip_is_wet, high, low);
    const Lanes product = hn::Mul(hn::Sub(apex, middle), hn::Sub(apex, other));
    const Lanes tip = hn::Div(hn::Mul(apex, apex), hn::Max(product, hn::Set(d, kFlat)));
    const Lanes share = hn::IfThenElse(tip_is_wet, tip, hn::Sub(one, tip));
    return hn::IfThenElse(Wet(high), one, hn::IfThenElseZero(Wet(low), share));
}

// Bounds of the heights of eight blocks' corners, certain in spite of rounding.
struct alignas(64) Bounds {
    double low[kLanes], high[kLanes];

    HWY_INLINE Bounds(const PanelBoxes& boxes, const WaterPlane& water) {
        const Tag d;
        const Water plane(water);
        const Vectors steep{hn::Abs(plane.up.x), hn::Abs(plane.up.y), hn::Abs(plane.up.z)};
        const Lanes margin = hn::Set(d, water.margin);
        for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(d)) {
            const Lanes middle = plane.HeightOf(Get(boxes.center, lane));
            const Lanes reach = hn::Add(Dot(steep, Get(boxes.half, lane)), margin);
            hn::Store(hn::Sub(middle, reach), d, low + lane);
            hn::Store(hn::Add(middle, reach), d, high + lane);
        }
    }
};

// Calls add(block, surely below) for the blocks that are not surely above; a block above adds 0.
template <class Add>
HWY_INLINE void ForEachWetBlock(const PanelBlocks& panels, const WaterPlane& water,
                                const Add& add) {
    for (std::size_t first = 0; first < panels.blocks.size(); first += kLanes) {
        const Bounds bounds(panels.boxes[first / kLanes], water);
        const std::size_t count = HWY_MIN(kLanes, panels.blocks.size() - first);
        for (std::size_t k = 0; k < count; ++k)
            if (!(bounds.low[k] > 0.0)) add(panels.blocks[first + k], bounds.high[k] <= 0.0);
    }
}

FacingSums SumFacing(const PanelBlocks& panels, const WaterPlane& water, const Vec3& v,
                     const Vec3& w) {
    const Tag d;
    const Water plane(water);
    const Vectors velocity = Set(v), spin = Set(w);
    Sum flow;
    VectorSum first, square, mixed;
    for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(d)) {
        Lanes s = hn::Zero(d);
        Vectors s_c = Zero(), s_cc = Zero(), s_cd = Zero();
        ForEachWetBlock(panels, water, [&](const PanelBlock& block, bool below) HWY_ATTR {
            const Lanes facing =
                hn::Add(Dot(Get(block.area, lane), velocity), Dot(Get(block.swing, lane), spin));
            const Mask away = hn::Le(facing, hn::Zero(d));
            if (hn::AllTrue(d, away)) return;
            Lanes f = hn::IfThenZeroElse(away, facing);
            if (!below) f = hn::Mul(f, WettedShare(block, lane, plane));
            const Vectors c = Get(block.center, lane), g = Scale(f, c);
            s = hn::Add(s, f);
            s_c = Add(s_c, g);
            s_cc = Add(s_cc, {hn::Mul(g.x, c.x), hn::Mul(g.y, c.y), hn::Mul(g.z, c.z)});
            s_cd = Add(s_cd, {hn::Mul(g.x, c.y), hn::Mul(g.x, c.z), hn::Mul(g.y, c.z)});
        });
        flow.Put(s, lane);
        first.Put(s_c, lane);
        square.Put(s_cc, lane);
        mixed.Put(s_cd, lane);
    }
    return {flow.Total(), first.Totals(), square.Totals(), mixed.Totals()};
}

double SumFacingEven(const PanelBlocks& panels, const WaterPlane& water, const Vec3& v) {
    const Tag d;
    const Water plane(water);
    const Vectors velocity = Set(v);
    Sum sum;
    for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(d)) {
        Lanes s = hn::Zero(d);
        ForEachWetBlock(panels, water, [&](const PanelBlock& block, bool below) HWY_ATTR {
            const Lanes facing = Dot(Get(block.area, lane), velocity);
            const Mask away = hn::Le(facing, hn::Zero(d));
            if (hn::AllTrue(d, away)) return;
            Lanes size = hn::IfThenZeroElse(away, facing);
            if (!below) size = hn::Mul(size, WettedShare(block, lane, plane));
            s = hn::Add(s, size);
        });
        sum.Put(s, lane);
    }
    return sum.Total();
}

// 12 int p z n_z dA of whole triangles; `area` is that of their projection on the water.
HWY_INLINE Vectors WholeMoments(const Heights& h, const Vectors (&corner)[3], Lanes area,
                                Lanes sum) {
    const Vectors products =
        Add(Add(Scale(h.z0, corner[0]), Scale(h.z1, corner[1])), Scale(h.z2, corner[2]));
    const Vectors corners = Add(Add(corner[0], corner[1]), corner[2]);
    return Scale(area, Add(Scale(sum, corners), products));
}

// The corners' sum of the cut-off tips, and the apex once more: only its height is not 0.
HWY_INLINE Vectors TipCorners(const Heights& h, const Tip& tip, const Vectors (&corner)[3]) {
    const auto from = [&](int a, int b, int c) HWY_ATTR {
        return Choose(h.first, corner[a], Choose(h.second, corner[b], corner[c]));
    };
    const Vectors p = from(0, 1, 2), q = from(1, 2, 0), r = from(2, 0, 1);
    return Add(Scale(hn::Set(Tag(), 4.0), p),
               Add(Scale(tip.next, Sub(q, p)), Scale(tip.last, Sub(r, p))));
}

WettedIntegrals IntegrateWetted(const PanelBlocks& facets, const WaterPlane& water) {
    const Tag d;
    const Water plane(water);
    WettedIntegrals out;
    Sum volume;
    VectorSum first;
    for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(d)) {
        Lanes v = hn::Zero(d);
        Vectors m = Zero();
        for (const PanelBlock& block : facets.blocks) {
            const Heights h(block, lane, plane);
            const bool wet = !hn::AllFalse(d, hn::Or(hn::Or(h.wet0, h.wet1), h.wet2));
            out.any_dry |= !hn::AllTrue(d, hn::And(hn::And(h.wet0, h.wet1), h.wet2));
            if (!wet) continue;
            out.any_wet = true;
            const Vectors corner[3] = {Get(block.corner[0], lane), Get(block.corner[1], lane),
                                       Get(block.corner[2], lane)};
            const Lanes area = Dot(plane.up, Get(block.area, lane));
            const Tip tip(h);
            const Mask whole = hn::Or(hn::AndNot(h.cut, h.wet0), hn::AndNot(tip.wet, h.cut));
            const Lanes sum = hn::Add(hn::Add(h.z0, h.z1), h.z2);
            v = hn::Add(v, hn::IfThenElseZero(whole, hn::Mul(area, sum)));
            m = Add(m, Only(whole, WholeMoments(h, corner, area, sum)));
            if (hn::AllFalse(d, h.cut)) continue;
            const Lanes size = hn::Mul(hn::Mul(tip.next, tip.last), hn::Mul(area, tip.z));
            const Lanes part = hn::IfThenElse(tip.wet, size, hn::Neg(size));
            v = hn::Add(v, hn::IfThenElseZero(h.cut, part));
            m = Add(m, Only(h.cut, Scale(part, TipCorners(h, tip, corner))));
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
HWY_EXPORT(SumFacing);
HWY_EXPORT(SumFacingEven);

WettedIntegrals integrate_wetted(const PanelBlocks& facets, const WaterPlane& water) {
    return HWY_DYNAMIC_DISPATCH(IntegrateWetted)(facets, water);
}

FacingSums sum_facing(const PanelBlocks& panels, const WaterPlane& water, const Vec3& v,
                      const Vec3& w) {
    return HWY_DYNAMIC_DISPATCH(SumFacing)(panels, water, v, w);
}

double sum_facing(const PanelBlocks& panels, const WaterPlane& water, const Vec3& v) {
    return HWY_DYNAMIC_DISPATCH(SumFacingEven)(panels, water, v);
}
}  // namespace ice
#endif
