// SPDX-License-Identifier: GPL-3.0-or-later
// The bodies of pairs in lanes while their contacts are swept, to the bits of sweep_reference.cpp.
// Included once per instruction set, hence the guard that lets it in again for each. Mul then Add,
// not MulAdd: a fused product would differ from it.
#if defined(ICE_SIDE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_SIDE_LANES_INL
#undef ICE_SIDE_LANES_INL
#else
#define ICE_SIDE_LANES_INL
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <type_traits>

#include "solver/contact/motion_lanes-inl.hpp"
#include "solver/contact/row_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A symmetric matrix of each pair.
template <std::size_t N>
struct WideMatrices {
    Wide<N> xx, yy, zz, xy, xz, yz;

    HWY_INLINE WideVectors<N> operator*(const WideVectors<N>& v) const {
        return {Dot({xx, xy, xz}, v), Dot({xy, yy, yz}, v), Dot({xz, yz, zz}, v)};
    }
    template <std::size_t M>
    HWY_INLINE void Take(const WideMatrices<M>& from, std::size_t s, std::size_t as) {
        xx.of[as] = from.xx.of[s], yy.of[as] = from.yy.of[s], zz.of[as] = from.zz.of[s];
        xy.of[as] = from.xy.of[s], xz.of[as] = from.xz.of[s], yz.of[as] = from.yz.of[s];
    }
};
HWY_INLINE WideMatrices<1> GetMatrices(const std::array<LaneValues, 6>& from, std::size_t first) {
    const auto entry = [&](std::size_t k) HWY_ATTR { return Wide<1>{{Get(from[k], first)}}; };
    return {entry(0), entry(1), entry(2), entry(3), entry(4), entry(5)};
}
struct NoMatrices {};

// The bodies a or b of streams' pairs while their contacts are swept.
// @tparam kWater  they have added mass
template <std::size_t N, bool kWater>
struct Side {
    WideVectors<N> velocity, angular_velocity;
    Wide<N> inverse_mass;
    WideMatrices<N> inverse_inertia;
    std::conditional_t<kWater, WideMatrices<N>, NoMatrices> excess;  // of the inverse mass

    HWY_INLINE WideVectors<N> At(const WideVectors<N>& arm) const {
        return velocity + Cross(angular_velocity, arm);
    }
    HWY_INLINE void Push(const WideVectors<N>& arm, const WideVectors<N>& j) {
        velocity = velocity + inverse_mass * j;
        if constexpr (kWater) velocity = velocity + excess * j;
        angular_velocity = angular_velocity + inverse_inertia * Cross(arm, j);
    }
    template <std::size_t M>
    HWY_INLINE void Take(const Side<M, kWater>& from, std::size_t s, std::size_t as) {
        const auto take = [&](Wide<N>& to, const Wide<M>& value)
                              HWY_ATTR { to.of[as] = value.of[s]; };
        const auto take_vector = [&](WideVectors<N>& to, const WideVectors<M>& value) HWY_ATTR {
            take(to.x, value.x), take(to.y, value.y), take(to.z, value.z);
        };
        take_vector(velocity, from.velocity);
        take_vector(angular_velocity, from.angular_velocity);
        take(inverse_mass, from.inverse_mass);
        inverse_inertia.Take(from.inverse_inertia, s, as);
        if constexpr (kWater) excess.Take(from.excess, s, as);
    }
};

// @param excess  used with kWater only
template <bool kWater>
HWY_INLINE Side<1, kWater> LoadSide(const std::array<std::int32_t, kLanes>& body,
                                    const std::vector<BodyMotion>& motion, const LaneValues& mass,
                                    const std::array<LaneValues, 6>& inverse_inertia,
                                    const std::array<LaneValues, 6>* excess, std::size_t first) {
    // lanes without a pair have no mass and no contacts: any body will do
    const Motions m = LoadMotions(body.data() + first, motion);
    const auto value = [&](std::size_t d) HWY_ATTR { return Wide<1>{{m.entry[d]}}; };
    Side<1, kWater> out{{value(0), value(1), value(2)},
                        {value(3), value(4), value(5)},
                        {{Get(mass, first)}},
                        GetMatrices(inverse_inertia, first),
                        {}};
    if constexpr (kWater) out.excess = GetMatrices(*excess, first);
    return out;
}

template <std::size_t N, bool kWater>
HWY_INLINE void StoreSide(const Side<N, kWater>& side, std::size_t s,
                          const std::array<std::int32_t, kLanes>& body, const LaneValues& mass,
                          std::size_t first, std::vector<BodyMotion>& motion) {
    const Lanes unused = hn::Zero(Tag());
    StoreMotions({{side.velocity.x.of[s], side.velocity.y.of[s], side.velocity.z.of[s],
                   side.angular_velocity.x.of[s], side.angular_velocity.y.of[s],
                   side.angular_velocity.z.of[s], unused, unused}},
                 body.data() + first, mass.v + first, motion);
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
