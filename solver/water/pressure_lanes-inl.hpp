// SPDX-License-Identifier: GPL-3.0-or-later
// pressure_load() for as many bodies of one form as the machine has lanes, with its bits.
#if defined(ICE_WATER_PRESSURE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_WATER_PRESSURE_LANES_INL
#undef ICE_WATER_PRESSURE_LANES_INL
#else
#define ICE_WATER_PRESSURE_LANES_INL
#endif

#include <hwy/highway.h>

#include "solver/water/floating_lanes-inl.hpp"
#include "solver/water/relative_drag.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

// Corners of triangles and the pressure there.
struct PressedTriangles {
    Vectors p[3];
    Lanes pressure[3];

    PressedTriangles() = default;
    // The part on the apex' side of the cut.
    HWY_INLINE PressedTriangles(const PressedTriangles& t, const Cut& cut, const Tip& tip) {
        const auto corner = [&](int a, int b, int c) HWY_ATTR {
            return Choose(cut.first, t.p[a], Choose(cut.second, t.p[b], t.p[c]));
        };
        const auto value = [&](int a, int b, int c) HWY_ATTR {
            return hn::IfThenElse(cut.first, t.pressure[a],
                                  hn::IfThenElse(cut.second, t.pressure[b], t.pressure[c]));
        };
        p[0] = corner(0, 1, 2);
        p[1] = Add(p[0], Scale(tip.next, Sub(corner(1, 2, 0), p[0])));
        p[2] = Add(p[0], Scale(tip.last, Sub(corner(2, 0, 1), p[0])));
        pressure[0] = value(0, 1, 2);
        pressure[1] = hn::Add(pressure[0], hn::Mul(tip.next, hn::Sub(value(1, 2, 0), pressure[0])));
        pressure[2] = hn::Add(pressure[0], hn::Mul(tip.last, hn::Sub(value(2, 0, 1), pressure[0])));
    }
};

// 3 and 12 times int p dA and int p r dA, in units of the triangle's area.
struct PressedSums {
    Lanes force;
    Vectors moment;

    HWY_INLINE PressedSums() : force(hn::Zero(Tag())), moment(Zero()) {}
    HWY_INLINE void AddOnly(Mask which, Lanes factor, const PressedTriangles& t) {
        const Lanes* p = t.pressure;
        const Lanes sum = hn::Add(hn::Add(p[0], p[1]), p[2]);
        const Vectors corners = Add(Add(t.p[0], t.p[1]), t.p[2]);
        const Vectors own = Add(Add(Scale(p[0], t.p[0]), Scale(p[1], t.p[1])), Scale(p[2], t.p[2]));
        force = hn::Add(force, hn::IfThenElseZero(which, hn::Mul(factor, sum)));
        moment = ice::HWY_NAMESPACE::Add(
            moment, Only(which, Scale(factor, ice::HWY_NAMESPACE::Add(Scale(sum, corners), own))));
    }
};

// Over the wetted part of quarters. @param h  how the water cuts them
HWY_INLINE void AddPressed(const Cut& h, const PressedTriangles& t, PressedSums& sums) {
    const Tag d;
    if (hn::AllFalse(d, h.AnyInside())) return;
    const Tip tip(h);
    const Mask whole = CountsWhole(h, tip);
    if (!hn::AllFalse(d, whole)) sums.AddOnly(whole, hn::Set(d, 1.0), t);
    if (hn::AllFalse(d, h.any)) return;
    const Lanes size = hn::Mul(tip.next, tip.last);
    sums.AddOnly(h.any, hn::IfThenElse(tip.inside, size, hn::Neg(size)),
                 PressedTriangles(t, h, tip));
}

struct Pressed {
    Vectors force, moment;
};

// In body axes. @param pressure  at the vertices and, numbered behind them, at the edges' middles
template <class Pressure>
HWY_INLINE Pressed IntegratePressure(const Shape& form, const Water& water,
                                     const Pressure& pressure) {
    const Tag d;
    Pressed out{Zero(), Zero()};
    for (std::size_t n = 0; n < form.mesh.triangles.size(); ++n) {
        Vec3 p[6];
        Lanes z[6], value[6];
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = form.mesh.corner(n, static_cast<int>(k));
            z[k] = water.HeightOf(Set(p[k]));
        }
        if (hn::AllFalse(d, CutByWater({z[0], z[1], z[2]}).AnyInside())) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            p[3 + k] = 0.5 * (p[k] + p[(k + 1) % 3]);
            z[3 + k] = water.HeightOf(Set(p[3 + k]));
            value[k] = pressure.At(static_cast<std::size_t>(form.mesh.triangles[n][k]));
            value[3 + k] = pressure.At(form.mesh.vertices.size() +
                                       static_cast<std::size_t>(form.edges.of_triangle[n][k]));
        }
        PressedSums sums;
        for (const auto& [i, j, k] : kQuarters) {
            PressedTriangles t;
            const std::size_t of[3] = {i, j, k};
            for (std::size_t m = 0; m < 3; ++m) {
                t.p[m] = Set(p[of[m]]);
                t.pressure[m] = value[of[m]];
            }
            AddPressed(CutByWater({z[i], z[j], z[k]}), t, sums);
        }
        const Vectors quarter =
            Scale(hn::Set(d, 0.25), SetOf(form.facets.blocks[n / kLanes].area, n % kLanes));
        out.force = Sub(out.force, Scale(hn::Div(sums.force, hn::Set(d, 3.0)), quarter));
        out.moment = Sub(out.moment, Cross(Scale(hn::Set(d, 1.0 / 12.0), sums.moment), quarter));
    }
    return out;
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
