// SPDX-License-Identifier: GPL-3.0-or-later
// Values of contact rows in lanes, also of several streams beside each other. Included once per
// instruction set, hence the guard that lets it in again for each. Mul then Add, not MulAdd: a
// fused product would differ from the scalar references.
#if defined(ICE_ROW_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_ROW_LANES_INL
#undef ICE_ROW_LANES_INL
#else
#define ICE_ROW_LANES_INL
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "common/math/vector_lanes-inl.hpp"
#include "solver/contact/contact_rows.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

static_assert(kLanes == 8);  // as many as Lanes hold at most

HWY_INLINE Lanes Get(const LaneValues& from, std::size_t lane) {
    return hn::LoadU(Tag(), from.v + lane);
}
HWY_INLINE Vectors Get(const LaneVectors& from, std::size_t lane) {
    return {Get(from[0], lane), Get(from[1], lane), Get(from[2], lane)};
}
HWY_INLINE void Put(Lanes value, LaneValues& to, std::size_t lane) {
    hn::StoreU(value, Tag(), to.v + lane);
}

// Lanes of N streams of contacts. A contact takes a chain of operations in which each one waits
// for the last, longer than the machine's window: streams' operations have to be beside each
// other, so that one computes while the others wait.
template <std::size_t N>
struct Wide {
    Lanes of[N];

    friend HWY_INLINE Wide operator+(Wide a, Wide b) {
        for (std::size_t s = 0; s < N; ++s) a.of[s] = hn::Add(a.of[s], b.of[s]);
        return a;
    }
    friend HWY_INLINE Wide operator-(Wide a, Wide b) {
        for (std::size_t s = 0; s < N; ++s) a.of[s] = hn::Sub(a.of[s], b.of[s]);
        return a;
    }
    friend HWY_INLINE Wide operator*(Wide a, Wide b) {
        for (std::size_t s = 0; s < N; ++s) a.of[s] = hn::Mul(a.of[s], b.of[s]);
        return a;
    }
};

template <std::size_t N>
struct WideVectors {
    Wide<N> x, y, z;

    friend HWY_INLINE WideVectors operator+(const WideVectors& a, const WideVectors& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend HWY_INLINE WideVectors operator-(const WideVectors& a, const WideVectors& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend HWY_INLINE WideVectors operator*(const Wide<N>& s, const WideVectors& a) {
        return {s * a.x, s * a.y, s * a.z};
    }
    friend HWY_INLINE Wide<N> Dot(const WideVectors& a, const WideVectors& b) {
        return a.x * b.x + a.y * b.y + a.z * b.z;
    }
    friend HWY_INLINE WideVectors Cross(const WideVectors& a, const WideVectors& b) {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
};

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
