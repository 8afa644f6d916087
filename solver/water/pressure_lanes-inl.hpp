// SPDX-License-Identifier: GPL-3.0-or-later
// pressure_load() for as many bodies of one form as the machine has lanes, with its bits.
#if defined(ICE_WATER_PRESSURE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_WATER_PRESSURE_LANES_INL
#undef ICE_WATER_PRESSURE_LANES_INL
#else
#define ICE_WATER_PRESSURE_LANES_INL
#endif

#include <hwy/highway.h>

#include "solver/water/quarters_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

// Corners of triangles and the pressure there.
struct PressedTriangles {
    Vectors p[3];
    Lanes pressure[3];

    PressedTriangles() = default;
    // The part on the apex' side of the cut.
    HWY_INLINE PressedTriangles(const PressedTriangles& t, const Cut& cut, const Tip& tip) {
        OnTip(cut, tip, t.p, p);
        OnTip(cut, tip, t.pressure, pressure);
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
        moment = Add(moment, Only(which, Scale(factor, Add(Scale(sum, corners), own))));
    }
};

// The triangles themselves as the integral of AddInside(): PressedSums integrates.
struct Itself {
    HWY_INLINE const PressedTriangles& operator()(const PressedTriangles& t, Mask) const {
        return t;
    }
};

struct Pressed {
    Vectors force, moment;
};

// In body axes. @param pressure  at the vertices and, numbered behind them, at the edges' middles
template <class Pressure>
HWY_INLINE Pressed IntegratePressure(const Shape& shape, const Water& water,
                                     const Pressure& pressure) {
    const Tag d;
    Pressed out{Zero(), Zero()};
    for (std::size_t n = 0; n < shape.mesh.triangles.size(); ++n) {
        const Quarters quarters(shape, water, n);
        if (!quarters.AnyCornerWet()) continue;
        // (P1): the pressure is linear over each quarter, and pushes inwards
        Lanes value[6];
        for (std::size_t k = 0; k < 6; ++k) value[k] = pressure.At(quarters.points.place[k]);
        PressedSums sums;
        for (const Quarter& quarter : kQuarters) {
            PressedTriangles t;
            Pick(quarters.p, quarter, t.p);
            Pick(value, quarter, t.pressure);
            const Cut h = quarters.CutOf(quarter);
            AddInside(h, h.AnyInside(), t, Itself(), sums);
        }
        out.force = Sub(out.force, Scale(hn::Div(sums.force, hn::Set(d, 3.0)), quarters.area));
        out.moment =
            Sub(out.moment, Cross(Scale(hn::Set(d, 1.0 / 12.0), sums.moment), quarters.area));
    }
    return out;
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
