// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces of the water's sums over facets: lanes are facets of a block, or bodies that share them.
// Included once per instruction set, hence the guard that lets it in again for each.
#if defined(ICE_WATER_FACET_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_WATER_FACET_LANES_INL
#undef ICE_WATER_FACET_LANES_INL
#else
#define ICE_WATER_FACET_LANES_INL
#endif

#include <hwy/highway.h>

#include "common/math/vector_lanes-inl.hpp"
#include "solver/water/wetted_sums.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kLanes = FacetBlock::kLanes;
static_assert(kLanes == 8);  // as many as Lanes hold at most

HWY_INLINE Vectors Get(const double (&from)[3][kLanes], std::size_t lane) {
    const Tag d;
    return {hn::Load(d, from[0] + lane), hn::Load(d, from[1] + lane), hn::Load(d, from[2] + lane)};
}
struct Corners {
    Vectors p[3];

    HWY_INLINE Corners(const FacetBlock& block, std::size_t lane)
        : p{Get(block.corner[0], lane), Get(block.corner[1], lane), Get(block.corner[2], lane)} {}
    HWY_INLINE Corners(Vectors p0, Vectors p1, Vectors p2) : p{p0, p1, p2} {}
};
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
    HWY_INLINE Water(Vectors up_in_body, Lanes of_origin) : up(up_in_body), height(of_origin) {}
    HWY_INLINE Lanes HeightOf(Vectors p) const { return hn::Add(Dot(up, p), height); }
};

HWY_INLINE Mask Wet(Lanes z) { return hn::Le(z, hn::Zero(Tag())); }

// How a quantity that is even on triangles cuts them at 0, from its values at the corners and which
// of these are inside. Where it does, the one of the three that is alone on its side is the apex.
struct Cut {
    Lanes z0, z1, z2;
    Mask in0, in1, in2, any, first, second;  // the latter: that corner is the apex, else the third

    HWY_INLINE Cut(Lanes v0, Lanes v1, Lanes v2, Mask i0, Mask i1, Mask i2)
        : z0(v0), z1(v1), z2(v2), in0(i0), in1(i1), in2(i2) {
        const Mask differ_01 = hn::Xor(in0, in1), differ_12 = hn::Xor(in1, in2);
        any = hn::Or(differ_01, differ_12);
        first = hn::AndNot(differ_12, differ_01);
        second = hn::And(differ_01, differ_12);
    }
    HWY_INLINE Mask AnyInside() const { return hn::Or(hn::Or(in0, in1), in2); }
    HWY_INLINE Mask AllInside() const { return hn::And(hn::And(in0, in1), in2); }
    // Of the values v0, v1, v2 at the corners that at the apex. v1, v2, v0 give that at the next
    // corner after it, v2, v0, v1 that at the last.
    HWY_INLINE Lanes AtApex(Lanes v0, Lanes v1, Lanes v2) const {
        return hn::IfThenElse(first, v0, hn::IfThenElse(second, v1, v2));
    }
    HWY_INLINE Vectors AtApex(Vectors v0, Vectors v1, Vectors v2) const {
        return Choose(first, v0, Choose(second, v1, v2));
    }
};

// The cut-off tip: value at the apex, shares of the two edges from there that are on its side.
struct Tip {
    Lanes z, next, last;
    Mask inside;

    HWY_INLINE explicit Tip(const Cut& h) : z(h.AtApex(h.z0, h.z1, h.z2)) {
        next = hn::Div(z, hn::Sub(z, h.AtApex(h.z1, h.z2, h.z0)));
        last = hn::Div(z, hn::Sub(z, h.AtApex(h.z2, h.z0, h.z1)));
        inside =
            hn::Or(hn::And(h.first, h.in0),
                   hn::Or(hn::And(h.second, h.in1), hn::AndNot(hn::Or(h.first, h.second), h.in2)));
    }
    // Positive where the tip is inside, negative where it is taken off the whole.
    HWY_INLINE Lanes Signed(Lanes size) const {
        return hn::IfThenElse(inside, size, hn::Neg(size));
    }
    // signed share of the triangle's area that the tip has
    HWY_INLINE Lanes Size() const { return Signed(hn::Mul(next, last)); }
};

// Does the whole triangle count, with or without a tip?
HWY_INLINE Mask CountsWhole(const Cut& cut, const Tip& tip) {
    return hn::Or(hn::AndNot(cut.any, cut.in0), hn::AndNot(tip.inside, cut.any));
}

// The value at a share of the edge from one corner to another.
HWY_INLINE Lanes OnEdge(Lanes from, Lanes to, Lanes share) {
    return hn::Add(from, hn::Mul(share, hn::Sub(to, from)));
}
HWY_INLINE Vectors OnEdge(Vectors from, Vectors to, Lanes share) {
    return Add(from, Scale(share, Sub(to, from)));
}

// A quantity that is linear on triangles, from its values at the corners: at those of the part on
// the apex' side of the cut, the apex and the points in which the cut crosses its two edges.
template <class T>
HWY_INLINE void OnTip(const Cut& cut, const Tip& tip, const T (&of)[3], T (&out)[3]) {
    out[0] = cut.AtApex(of[0], of[1], of[2]);
    out[1] = OnEdge(out[0], cut.AtApex(of[1], of[2], of[0]), tip.next);
    out[2] = OnEdge(out[0], cut.AtApex(of[2], of[0], of[1]), tip.last);
}

// Adds an integral over the part of triangles that is inside; add_inside() of cut_triangle.hpp.
// @param count     the triangles whose sums are read
// @param integral  over the whole of triangles, in units of their area; its mask is as `count`
template <class T, class Integral, class Sums>
HWY_INLINE void AddInside(const Cut& cut, Mask count, const T& t, const Integral& integral,
                          Sums& sums) {
    const Tag d;
    if (hn::AllFalse(d, hn::And(count, cut.AnyInside()))) return;
    const Tip tip(cut);
    const Mask whole = CountsWhole(cut, tip);
    if (!hn::AllFalse(d, hn::And(count, whole)))
        sums.AddOnly(whole, hn::Set(d, 1.0), integral(t, whole));
    if (hn::AllFalse(d, hn::And(count, cut.any))) return;
    sums.AddOnly(cut.any, tip.Size(), integral(T(t, cut, tip), cut.any));
}

// Heights of the three corners.
struct Heights {
    Lanes z0, z1, z2;
};
HWY_INLINE Heights HeightsOf(const Corners& corner, const Water& water) {
    return {water.HeightOf(corner.p[0]), water.HeightOf(corner.p[1]), water.HeightOf(corner.p[2])};
}
HWY_INLINE Cut CutByWater(Heights h) {
    return Cut(h.z0, h.z1, h.z2, Wet(h.z0), Wet(h.z1), Wet(h.z2));
}

// 12 int p z n_z dA of whole triangles; `area` is that of their projection on the water.
HWY_INLINE Vectors WholeMoments(const Cut& h, const Corners& corner, Lanes area, Lanes sum) {
    const Vectors products =
        Add(Add(Scale(h.z0, corner.p[0]), Scale(h.z1, corner.p[1])), Scale(h.z2, corner.p[2]));
    const Vectors corners = Add(Add(corner.p[0], corner.p[1]), corner.p[2]);
    return Scale(area, Add(Scale(sum, corners), products));
}

// The corners' sum of the cut-off tips, and the apex once more: only its height is not 0.
HWY_INLINE Vectors TipCorners(const Cut& h, const Tip& tip, const Corners& corner) {
    const Vectors(&c)[3] = corner.p;
    const Vectors p = h.AtApex(c[0], c[1], c[2]), q = h.AtApex(c[1], c[2], c[0]),
                  r = h.AtApex(c[2], c[0], c[1]);
    return Add(Scale(hn::Set(Tag(), 4.0), p),
               Add(Scale(tip.next, Sub(q, p)), Scale(tip.last, Sub(r, p))));
}

// 3 and 12 times the integrals.
struct Wetted {
    Lanes volume;
    Vectors first;

    HWY_INLINE Wetted() : volume(hn::Zero(Tag())), first(Zero()) {}

    HWY_INLINE void Add(const Cut& h, const Corners& corner, Lanes area) {
        const Tag d;
        const Tip tip(h);
        const Mask whole = CountsWhole(h, tip);
        const Lanes sum = hn::Add(hn::Add(h.z0, h.z1), h.z2);
        volume = hn::Add(volume, hn::IfThenElseZero(whole, hn::Mul(area, sum)));
        first = ice::HWY_NAMESPACE::Add(first, Only(whole, WholeMoments(h, corner, area, sum)));
        if (hn::AllFalse(d, h.any)) return;
        const Lanes size = hn::Mul(hn::Mul(tip.next, tip.last), hn::Mul(area, tip.z));
        const Lanes part = tip.Signed(size);
        volume = hn::Add(volume, hn::IfThenElseZero(h.any, part));
        first =
            ice::HWY_NAMESPACE::Add(first, Only(h.any, Scale(part, TipCorners(h, tip, corner))));
    }
};

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
