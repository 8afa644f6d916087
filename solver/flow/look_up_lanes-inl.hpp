// SPDX-License-Identifier: GPL-3.0-or-later
// One look-up in a table, its four numbers in lanes; look_up_flow_reference.cpp has the
// mathematics. Included once per instruction set, hence the guard that lets it in again for each.
// Mul then Add, not MulAdd: a fused product would differ from it.
#if defined(ICE_LOOK_UP_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_LOOK_UP_LANES_INL
#undef ICE_LOOK_UP_LANES_INL
#else
#define ICE_LOOK_UP_LANES_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "solver/flow/look_up_flow.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

// @param out  velocity x, y, z and potential
HWY_INLINE void LookUp(const FlowGrid& g, double x, double y, double z, double* HWY_RESTRICT out) {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::CappedTag<double, FlowGrid::kNumbers> d;
    const hn::Rebind<float, decltype(d)> narrow;
    out[0] = out[1] = out[2] = out[3] = 0.0;
    if (g.empty()) return;
    const bool mirrored = g.symmetric && y < 0.0;
    const double gx = (x - g.origin.x()) * g.per_spacing;
    const double off_y = ((mirrored ? -y : y) - g.origin.y()) * g.per_spacing;
    const double gy = g.stride_y > 0 ? off_y : 0.0;
    const double gz = std::min((std::min(z, 0.0) - g.origin.z()) * g.per_spacing, g.last_z);
    const bool within = gx >= 0.0 && gx <= g.last_x && gy >= 0.0 && gy <= g.last_y && gz >= 0.0;
    if (!within) return;
    // not floor(), a call on the oldest machines: the places are not negative
    const auto cell = [](double place, double last) HWY_ATTR {
        return std::min(static_cast<double>(static_cast<std::int64_t>(place)),
                        std::max(last - 1.0, 0.0));
    };
    const double i = cell(gx, g.last_x), j = cell(gy, g.last_y), k = cell(gz, g.last_z);
    const auto fx = hn::Set(d, gx - i), fy = hn::Set(d, gy - j), fz = hn::Set(d, gz - k);
    const float* HWY_RESTRICT first =
        g.node.data() + FlowGrid::kNumbers * static_cast<std::size_t>(i) +
        g.stride_y * static_cast<std::size_t>(j) + g.stride_z * static_cast<std::size_t>(k);
    const auto between = [](auto a, auto b, auto f)
                             HWY_ATTR { return hn::Add(a, hn::Mul(f, hn::Sub(b, a))); };
    for (std::size_t n = 0; n < FlowGrid::kNumbers; n += hn::Lanes(d)) {
        const auto along_x = [&](std::size_t at) HWY_ATTR {
            const float* from = first + at + n;
            return between(hn::PromoteTo(d, hn::LoadU(narrow, from)),
                           hn::PromoteTo(d, hn::LoadU(narrow, from + FlowGrid::kNumbers)), fx);
        };
        const auto low = between(along_x(0), along_x(g.stride_y), fy);
        const auto high = between(along_x(g.stride_z), along_x(g.stride_z + g.stride_y), fy);
        hn::StoreU(between(low, high, fz), d, out + n);
    }
    if (mirrored) out[1] = -out[1];
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
