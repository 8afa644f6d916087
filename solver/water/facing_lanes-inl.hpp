// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces of the integrals over what a flow meets of wetted surfaces; lanes as in
// facet_lanes-inl.hpp.
#if defined(ICE_WATER_FACING_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_WATER_FACING_LANES_INL
#undef ICE_WATER_FACING_LANES_INL
#else
#define ICE_WATER_FACING_LANES_INL
#endif

#include <hwy/highway.h>

#include "solver/water/facet_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

// Triangles, and the flow through all of each if it were everywhere that at a corner [m3/s].
struct Triangles {
    Vectors p[3];
    Lanes f[3];

    HWY_INLINE Triangles(const Corners& corner, Vectors area, Vectors v, Vectors w) {
        const Vectors turning = Cross(area, w);
        const Lanes even = Dot(area, v);
        for (int k = 0; k < 3; ++k) {
            p[k] = corner.p[k];
            f[k] = hn::Add(even, Dot(turning, p[k]));
        }
    }
    // The part on the apex' side of the cut, with the area of the whole.
    HWY_INLINE Triangles(const Triangles& t, const Cut& cut, const Tip& tip) {
        const auto from = [&](int a, int b, int c) HWY_ATTR {
            return Choose(cut.first, t.p[a], Choose(cut.second, t.p[b], t.p[c]));
        };
        const auto flow = [&](int a, int b, int c) HWY_ATTR {
            return hn::IfThenElse(cut.first, t.f[a], hn::IfThenElse(cut.second, t.f[b], t.f[c]));
        };
        p[0] = from(0, 1, 2);
        p[1] = Add(p[0], Scale(tip.next, Sub(from(1, 2, 0), p[0])));
        p[2] = Add(p[0], Scale(tip.last, Sub(from(2, 0, 1), p[0])));
        f[0] = flow(0, 1, 2);
        f[1] = hn::Add(f[0], hn::Mul(tip.next, hn::Sub(flow(1, 2, 0), f[0])));
        f[2] = hn::Add(f[0], hn::Mul(tip.last, hn::Sub(flow(2, 0, 1), f[0])));
    }
};

// 3, 12 and 60 times the integrals.
struct Facing {
    Lanes flow;
    Vectors first, square, mixed;

    HWY_INLINE Facing() : flow(hn::Zero(Tag())), first(Zero()), square(Zero()), mixed(Zero()) {}

    // Adds m where `which`.
    HWY_INLINE void AddOnly(Mask which, const Facing& m) {
        flow = hn::Add(flow, hn::IfThenElseZero(which, m.flow));
        first = Add(first, Only(which, m.first));
        square = Add(square, Only(which, m.square));
        mixed = Add(mixed, Only(which, m.mixed));
    }
    HWY_INLINE Facing Times(Lanes s) const {
        Facing out;
        out.flow = hn::Mul(s, flow);
        out.first = Scale(s, first);
        out.square = Scale(s, square);
        out.mixed = Scale(s, mixed);
        return out;
    }
};

HWY_INLINE Facing IntegrateWhole(const Triangles& t) {
    const Tag d;
    Facing out;
    out.flow = hn::Add(hn::Add(t.f[0], t.f[1]), t.f[2]);
    const Vectors sum = Add(Add(t.p[0], t.p[1]), t.p[2]);
    const Vectors g = Add(Add(Scale(t.f[0], t.p[0]), Scale(t.f[1], t.p[1])), Scale(t.f[2], t.p[2]));
    out.first = Add(Scale(out.flow, sum), g);
    Vectors e[3];
    for (int k = 0; k < 3; ++k)
        e[k] = Scale(hn::Add(out.flow, hn::Mul(hn::Set(d, 2.0), t.f[k])), t.p[k]);
    const auto second = [&](Lanes Vectors::*i, Lanes Vectors::*j) HWY_ATTR {
        const Lanes of_sums = hn::Add(hn::Mul(out.first.*i, sum.*j), hn::Mul(sum.*i, g.*j));
        const Lanes of_two = hn::Add(hn::Mul(t.p[0].*i, e[0].*j), hn::Mul(t.p[1].*i, e[1].*j));
        return hn::Add(hn::Add(of_sums, of_two), hn::Mul(t.p[2].*i, e[2].*j));
    };
    out.square = {second(&Vectors::x, &Vectors::x), second(&Vectors::y, &Vectors::y),
                  second(&Vectors::z, &Vectors::z)};
    out.mixed = {second(&Vectors::x, &Vectors::y), second(&Vectors::x, &Vectors::z),
                 second(&Vectors::y, &Vectors::z)};
    return out;
}

HWY_INLINE Lanes SizeOf(const Tip& tip) {
    const Lanes size = hn::Mul(tip.next, tip.last);
    return hn::IfThenElse(tip.inside, size, hn::Neg(size));
}

// Over the part where the flow comes from outside. @param of  the triangles that count
HWY_INLINE Facing IntegratePart(const Triangles& t, Mask of) {
    const Tag d;
    const Lanes zero = hn::Zero(d);
    const Cut cut(t.f[0], t.f[1], t.f[2], hn::Gt(t.f[0], zero), hn::Gt(t.f[1], zero),
                  hn::Gt(t.f[2], zero));
    Facing out;
    if (hn::AllFalse(d, hn::And(of, cut.AnyInside()))) return out;
    const Tip tip(cut);
    const Mask whole = CountsWhole(cut, tip);
    if (!hn::AllFalse(d, hn::And(of, whole))) out.AddOnly(whole, IntegrateWhole(t));
    if (hn::AllFalse(d, hn::And(of, cut.any))) return out;
    out.AddOnly(cut.any, IntegrateWhole(Triangles(t, cut, tip)).Times(SizeOf(tip)));
    return out;
}

// Adds what flows in through the wetted part of triangles that the water cuts so.
HWY_INLINE void AddWetted(const Cut& h, const Triangles& t, Facing& sum) {
    const Tag d;
    const Tip tip(h);
    const Mask whole = CountsWhole(h, tip);
    if (!hn::AllFalse(d, whole)) sum.AddOnly(whole, IntegratePart(t, whole));
    if (hn::AllFalse(d, h.any)) return;
    sum.AddOnly(h.any, IntegratePart(Triangles(t, h, tip), h.any).Times(SizeOf(tip)));
}

// wetted_share()
HWY_INLINE Lanes WettedShare(Heights h) {
    const Tag d;
    const Lanes one = hn::Set(d, 1.0);
    const Lanes z0 = h.z0, z1 = h.z1, z2 = h.z2;
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

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
