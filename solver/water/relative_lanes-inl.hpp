// SPDX-License-Identifier: GPL-3.0-or-later
// relative_drag() for as many bodies of one form as the machine has lanes, with its bits.
#if defined(ICE_WATER_RELATIVE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_WATER_RELATIVE_LANES_INL
#undef ICE_WATER_RELATIVE_LANES_INL
#else
#define ICE_WATER_RELATIVE_LANES_INL
#endif

#include <hwy/highway.h>

#include "solver/water/floating_lanes-inl.hpp"
#include "solver/water/relative_drag.hpp"

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
        const auto part = [&](const Vectors(&of)[3], Vectors(&out)[3]) HWY_ATTR {
            const auto from = [&](int a, int b, int c) HWY_ATTR {
                return Choose(cut.first, of[a], Choose(cut.second, of[b], of[c]));
            };
            out[0] = from(0, 1, 2);
            out[1] = Add(out[0], Scale(tip.next, Sub(from(1, 2, 0), out[0])));
            out[2] = Add(out[0], Scale(tip.last, Sub(from(2, 0, 1), out[0])));
        };
        part(t.p, p);
        part(t.u, u);
        const auto flow = [&](int a, int b, int c) HWY_ATTR {
            return hn::IfThenElse(cut.first, t.f[a], hn::IfThenElse(cut.second, t.f[b], t.f[c]));
        };
        f[0] = flow(0, 1, 2);
        f[1] = hn::Add(f[0], hn::Mul(tip.next, hn::Sub(flow(1, 2, 0), f[0])));
        f[2] = hn::Add(f[0], hn::Mul(tip.last, hn::Sub(flow(2, 0, 1), f[0])));
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

HWY_INLINE RelativeSums IntegratePart(const RelativeTriangles& t, Mask of) {
    const Tag d;
    const Lanes zero = hn::Zero(d);
    const Cut cut(t.f[0], t.f[1], t.f[2], hn::Gt(t.f[0], zero), hn::Gt(t.f[1], zero),
                  hn::Gt(t.f[2], zero));
    RelativeSums out;
    if (hn::AllFalse(d, hn::And(of, cut.AnyInside()))) return out;
    const Tip tip(cut);
    const Mask whole = CountsWhole(cut, tip);
    if (!hn::AllFalse(d, hn::And(of, whole)))
        out.AddOnly(whole, hn::Set(d, 1.0), IntegrateWhole(t));
    if (hn::AllFalse(d, hn::And(of, cut.any))) return out;
    out.AddOnly(cut.any, SizeOf(tip), IntegrateWhole(RelativeTriangles(t, cut, tip)));
    return out;
}

// Over the wetted part of quarters. @param h  how the water cuts them
HWY_INLINE void AddWetted(const Cut& h, const RelativeTriangles& t, RelativeSums& sums) {
    const Tag d;
    if (hn::AllFalse(d, h.AnyInside())) return;
    const Tip tip(h);
    const Mask whole = CountsWhole(h, tip);
    if (!hn::AllFalse(d, whole)) sums.AddOnly(whole, hn::Set(d, 1.0), IntegratePart(t, whole));
    if (hn::AllFalse(d, h.any)) return;
    sums.AddOnly(h.any, SizeOf(tip), IntegratePart(RelativeTriangles(t, h, tip), h.any));
}

// Over the wetted surface. @param u  relative to the water, body axes: at the vertices and,
// numbered behind them, at the middles of the edges
template <class Relative>
HWY_INLINE RelativeSums IntegrateRelative(const Shape& form, const Water& water,
                                          const Relative& u) {
    const Tag d;
    RelativeSums sums;
    for (std::size_t n = 0; n < form.mesh.triangles.size(); ++n) {
        Vec3 p[6];
        Lanes z[6], f[6];
        Vectors at[6];
        std::size_t place[6];
        for (std::size_t k = 0; k < 3; ++k) {
            place[k] = static_cast<std::size_t>(form.mesh.triangles[n][k]);
            place[3 + k] =
                form.mesh.vertices.size() + static_cast<std::size_t>(form.edges.of_triangle[n][k]);
            p[k] = form.mesh.vertices[place[k]];
            z[k] = water.HeightOf(Set(p[k]));
        }
        if (hn::AllFalse(d, CutByWater({z[0], z[1], z[2]}).AnyInside())) continue;
        const Vectors quarter =
            Scale(hn::Set(d, 0.25), SetOf(form.facets.blocks[n / kLanes].area, n % kLanes));
        for (std::size_t k = 0; k < 3; ++k) {
            p[3 + k] = 0.5 * (p[k] + p[(k + 1) % 3]);
            z[3 + k] = water.HeightOf(Set(p[3 + k]));
        }
        for (std::size_t k = 0; k < 6; ++k) {
            at[k] = u.At(place[k]);
            f[k] = Dot(quarter, at[k]);
        }
        for (const auto& [i, j, k] : kQuarters) {
            RelativeTriangles t;
            const std::size_t of[3] = {i, j, k};
            for (std::size_t m = 0; m < 3; ++m) {
                t.p[m] = Set(p[of[m]]);
                t.u[m] = at[of[m]];
                t.f[m] = f[of[m]];
            }
            AddWetted(CutByWater({z[i], z[j], z[k]}), t, sums);
        }
    }
    return sums;
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
