// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors beside each other, eight doubles or as many at a time as the machine has lanes. Included
// once per instruction set, hence the guard that lets it in again for each. Mul then Add, not
// MulAdd: a fused product would differ from the scalar references.
#if defined(ICE_VECTOR_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_VECTOR_LANES_INL
#undef ICE_VECTOR_LANES_INL
#else
#define ICE_VECTOR_LANES_INL
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "common/geometry/triangle_mesh.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, 8>;
using Lanes = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

// Lanes of the widest build [-]: the size of arrays on the stack. 8 doubles fill an AVX-512
// register.
constexpr std::size_t kMostLanes = hn::MaxLanes(Tag());

// One vector per lane, in the unit of the caller.
struct Vectors {
    Lanes x, y, z;
};
HWY_INLINE Vectors Zero() { return {hn::Zero(Tag()), hn::Zero(Tag()), hn::Zero(Tag())}; }
HWY_INLINE Vectors Choose(Mask which, Vectors yes, Vectors no) {
    return {hn::IfThenElse(which, yes.x, no.x), hn::IfThenElse(which, yes.y, no.y),
            hn::IfThenElse(which, yes.z, no.z)};
}
HWY_INLINE Vectors Only(Mask which, Vectors v) {
    return {hn::IfThenElseZero(which, v.x), hn::IfThenElseZero(which, v.y),
            hn::IfThenElseZero(which, v.z)};
}
HWY_INLINE Vectors Set(const Vec3& v) {
    const Tag d;
    return {hn::Set(d, v[0]), hn::Set(d, v[1]), hn::Set(d, v[2])};
}
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
HWY_INLINE Vectors Cross(Vectors a, Vectors b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
            hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
