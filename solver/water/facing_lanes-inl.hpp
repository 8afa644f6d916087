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
        OnTip(cut, tip, t.p, p);
        OnTip(cut, tip, t.f, f);
    }
};

// 3, 12 and 60 times the integrals.
struct Facing {
    Lanes flow;
    Vectors first, square, mixed;

    HWY_INLINE Facing() : flow(hn::Zero(Tag())), first(Zero()), square(Zero()), mixed(Zero()) {}

    // Adds m by a factor where `which`.
    HWY_INLINE void AddOnly(Mask which, Lanes factor, const Facing& m) {
        flow = hn::Add(flow, hn::IfThenElseZero(which, hn::Mul(factor, m.flow)));
        first = Add(first, Only(which, Scale(factor, m.first)));
        square = Add(square, Only(which, Scale(factor, m.square)));
        mixed = Add(mixed, Only(which, Scale(factor, m.mixed)));
    }
};

// Over all of the triangles; integrate_whole() of wetted_sums_reference.cpp.
HWY_INLINE Facing IntegrateWhole(const Triangles& t) {
    const Tag d;
    Facing out;
    out.flow = hn::Add(hn::Add(t.f[0], t.f[1]), t.f[2]);
    const Vectors sum = Add(Add(t.p[0], t.p[1]), t.p[2]);
    const Vectors g = Add(Add(Scale(t.f[0], t.p[0]), Scale(t.f[1], t.p[1])), Scale(t.f[2], t.p[2]));
    out.first = Add(Scale(out.flow, sum), g);
    // (F + 2 f) p at each corner, then the sums of wetted_sums.hpp, component by component
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

// IntegrateWhole() as the integral of AddInside().
struct OverWhole {
    template <class T>
    HWY_INLINE auto operator()(const T& t, Mask) const {
        return IntegrateWhole(t);
    }
};

// Over the part where the flow t.f comes from outside. @param count  the triangles whose sums are
// read
template <class T>
HWY_INLINE auto IntegratePart(const T& t, Mask count) {
    const Lanes zero = hn::Zero(Tag());
    const Cut cut(t.f[0], t.f[1], t.f[2], hn::Gt(t.f[0], zero), hn::Gt(t.f[1], zero),
                  hn::Gt(t.f[2], zero));
    decltype(IntegrateWhole(t)) out;
    AddInside(cut, count, t, OverWhole(), out);
    return out;
}

// IntegratePart() as the integral of AddInside().
struct OverPart {
    template <class T>
    HWY_INLINE auto operator()(const T& t, Mask count) const {
        return IntegratePart(t, count);
    }
};

// Adds IntegratePart() of the wetted part. @param h  how the water cuts the triangles
template <class T, class Sums>
HWY_INLINE void AddWetted(const Cut& h, const T& t, Sums& sums) {
    AddInside(h, h.AnyInside(), t, OverPart(), sums);
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
