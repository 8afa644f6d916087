// SPDX-License-Identifier: GPL-3.0-or-later
// Operations of the conjugate gradients on rows and motions, as many lanes at a time as the machine
// has, compiled once per instruction set. The mathematics is in sweep_memory_reference.cpp.
#include "solver/contact/sweep_memory.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/contact/sweep_memory_simd.cpp"
#include <hwy/foreach_target.h>  // must precede highway.h
#include <hwy/highway.h>

#include "solver/contact/row_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// |g|^2 = sum k(n) |dJ|^2 of (11): weighted with the inverse effective mass, so that impulses on
// light floes count as much as on heavy ones.
double MeasureChange(const std::vector<ContactRow>& rows, const SweepMemory& memory) {
    const Tag d;
    LaneValues sum{};
    for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(d)) {
        Lanes part = hn::Zero(d);
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const RowImpulses &now = rows[r].impulse, &before = memory.before[r];
            const Lanes normal = hn::Sub(Get(now.normal, lane), Get(before.normal, lane));
            const Vectors tangent = Sub(Get(now.tangent, lane), Get(before.tangent, lane));
            part = hn::Add(part, hn::Mul(hn::Add(hn::Mul(normal, normal), Dot(tangent, tangent)),
                                         Get(rows[r].inverse_effective_mass, lane)));
        }
        Put(part, sum, lane);
    }
    const double* s = sum.v;
    // as the reference sums its lanes
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
}

// J := J + beta d, then d := beta d + g with g the change in the last sweep. Velocities move along
// with the impulses, as they are linear in them: nothing is computed from impulses anew.
HWY_INLINE void MoveOn(double* values, double* before, double* direction, Lanes beta) {
    const Tag d;
    for (std::size_t k = 0; k < kLanes; k += hn::Lanes(d)) {
        const Lanes value = hn::LoadU(d, values + k), old = hn::LoadU(d, direction + k);
        const Lanes change = hn::Sub(value, hn::LoadU(d, before + k));
        const Lanes step = hn::Mul(beta, old);
        const Lanes next = hn::Add(value, step);
        hn::StoreU(next, d, values + k);
        hn::StoreU(hn::Add(step, change), d, direction + k);
        hn::StoreU(next, d, before + k);
    }
}

void MoveOnAll(std::vector<ContactRow>& rows, std::vector<BodyMotion>& motion, double beta,
               SweepMemory& memory) {
    const Lanes share = hn::Set(Tag(), beta);
    for (std::size_t r = 0; r < rows.size(); ++r) {
        RowImpulses &now = rows[r].impulse, &before = memory.before[r],
                    &direction = memory.direction[r];
        MoveOn(now.normal.v, before.normal.v, direction.normal.v, share);
        for (std::size_t axis = 0; axis < 3; ++axis)
            MoveOn(now.tangent[axis].v, before.tangent[axis].v, direction.tangent[axis].v, share);
    }
    for (std::size_t k = 0; k < motion.size(); ++k)
        MoveOn(motion[k].v, memory.motion_before[k].v, memory.motion_direction[k].v, share);
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ice {
HWY_EXPORT(MeasureChange);
HWY_EXPORT(MoveOnAll);

double measure_change(const std::vector<ContactRow>& rows, const SweepMemory& memory) {
    return HWY_DYNAMIC_DISPATCH(MeasureChange)(rows, memory);
}

void move_on(std::vector<ContactRow>& rows, std::vector<BodyMotion>& motion, double beta,
             SweepMemory& memory) {
    HWY_DYNAMIC_DISPATCH(MoveOnAll)(rows, motion, beta, memory);
}
}  // namespace ice
#endif
