// SPDX-License-Identifier: GPL-3.0-or-later
// relative_drag() for as many bodies of one form as the machine has lanes, with its bits.
#if defined(ICE_WATER_RELATIVE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_WATER_RELATIVE_LANES_INL
#undef ICE_WATER_RELATIVE_LANES_INL
#else
#define ICE_WATER_RELATIVE_LANES_INL
#endif

#include <hwy/highway.h>

#include "solver/water/quarters_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

// Triangles, the velocity relative to the water at their corners, and the flow through all of each
// if it were everywhere that at a corner [m3/s].
struct RelativeTriangles {
    Vectors p[3], u[3];
    Lanes f[3];

    RelativeTriangles() = default;
    // The part on the apex' side of the cut, with the area of the whole.
    HWY_INLINE RelativeTriangles(const RelativeTriangles& t, const Cut& cut, const Tip& tip) {
        OnTip(cut, tip, t.p, p);
        OnTip(cut, tip, t.u, u);
        OnTip(cut, tip, t.f, f);
    }
};

// 12, 60 and 60 times int f u, int f p x u and int f u . u.
struct RelativeSums {
    Vectors force, moment;
    Lanes loss;

    HWY_INLINE RelativeSums() : force(Zero()), moment(Zero()), loss(hn::Zero(Tag())) {}
    HWY_INLINE void AddOnly(Mask which, Lanes factor, const RelativeSums& m) {
        force = Add(force, Only(which, Scale(factor, m.force)));
        moment = Add(moment, Only(which, Scale(factor, m.moment)));
        loss = hn::Add(loss, hn::IfThenElseZero(which, hn::Mul(factor, m.loss)));
    }
};

// Over all of the triangles; integrate_whole() of relative_drag.cpp.
HWY_INLINE RelativeSums IntegrateWhole(const RelativeTriangles& t) {
    RelativeSums out;
    const Lanes flow = hn::Add(hn::Add(t.f[0], t.f[1]), t.f[2]), two = hn::Set(Tag(), 2.0);
    const auto weighted = [&](const Vectors(&g)[3]) HWY_ATTR {
        return Add(Add(Scale(t.f[0], g[0]), Scale(t.f[1], g[1])), Scale(t.f[2], g[2]));
    };
    const Vectors sum_p = Add(Add(t.p[0], t.p[1]), t.p[2]);
    const Vectors sum_u = Add(Add(t.u[0], t.u[1]), t.u[2]);
    const Vectors base_p = Add(Scale(flow, sum_p), weighted(t.p));
    const Vectors base_u = Add(Scale(flow, sum_u), weighted(t.u));
    // int f g h = 1/60 sum_k h_k e_k, with e_k as in the reference
    out.force = base_u;
    for (int k = 0; k < 3; ++k) {
        const Lanes own = hn::Add(flow, hn::Mul(two, t.f[k]));
        const Vectors e_p = Add(base_p, Add(Scale(own, t.p[k]), Scale(t.f[k], sum_p)));
        const Vectors e_u = Add(base_u, Add(Scale(own, t.u[k]), Scale(t.f[k], sum_u)));
        out.moment = Add(out.moment, Cross(e_p, t.u[k]));
        out.loss = hn::Add(out.loss, Dot(e_u, t.u[k]));
    }
    return out;
}

// Over the wetted surface. @param u  relative to the water, body axes: at the vertices and,
// numbered behind them, at the middles of the edges
template <class Relative>
HWY_INLINE RelativeSums IntegrateRelative(const Shape& shape, const Water& water,
                                          const Relative& u) {
    RelativeSums sums;
    for (std::size_t n = 0; n < shape.mesh.triangles.size(); ++n) {
        const Quarters quarters(shape, water, n);
        if (!quarters.AnyCornerWet()) continue;
        // (25): the flow is linear over each quarter
        Lanes f[6];
        Vectors at[6];
        for (std::size_t k = 0; k < 6; ++k) {
            at[k] = u.At(quarters.points.place[k]);
            f[k] = Dot(quarters.area, at[k]);
        }
        for (const Quarter& quarter : kQuarters) {
            RelativeTriangles t;
            Pick(quarters.p, quarter, t.p);
            Pick(at, quarter, t.u);
            Pick(f, quarter, t.f);
            AddWetted(quarters.CutOf(quarter), t, sums);
        }
    }
    return sums;
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
