// SPDX-License-Identifier: GPL-3.0-or-later
// The solver's sweeps, as many pairs of a block at a time as the machine has lanes, compiled once
// per instruction set. The mathematics is in sweep_reference.cpp. Mul then Add, not MulAdd: a fused
// product would differ from the reference.
#include "solver/contact/sweep.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/contact/sweep_simd.cpp"
#include <hwy/foreach_target.h>  // must precede highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "solver/shape/vector_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

static_assert(kLanes == 8);  // as many as Lanes hold at most

HWY_INLINE Lanes Get(const LaneValues& from, std::size_t lane) {
    return hn::LoadU(Tag(), from.v + lane);
}
HWY_INLINE void Put(Lanes value, LaneValues& to, std::size_t lane) {
    hn::StoreU(value, Tag(), to.v + lane);
}

HWY_INLINE Vectors Get(const LaneVectors& from, std::size_t lane) {
    return {Get(from[0], lane), Get(from[1], lane), Get(from[2], lane)};
}

// The bodies a or b of the pairs of a block while their contacts are swept.
struct Side {
    Vectors velocity, angular_velocity;
    Lanes inverse_mass, xx, yy, zz, xy, xz, yz;  // the latter of the inverse inertia

    HWY_INLINE void Load(const std::array<std::int32_t, kLanes>& body,
                         const std::vector<BodyMotion>& motion, const LaneValues& mass,
                         const std::array<LaneValues, 6>& inertia, std::size_t first) {
        // lanes without a pair have no mass and no contacts: any body will do
        LaneValues values[6];
        for (std::size_t k = 0; k < hn::Lanes(Tag()); ++k) {
            const BodyMotion& m = motion[static_cast<std::size_t>(std::max(body[first + k], 0))];
            for (std::size_t d = 0; d < 6; ++d) values[d].v[k] = m.v[d];
        }
        velocity = {Get(values[0], 0), Get(values[1], 0), Get(values[2], 0)};
        angular_velocity = {Get(values[3], 0), Get(values[4], 0), Get(values[5], 0)};
        inverse_mass = Get(mass, first);
        xx = Get(inertia[0], first);
        yy = Get(inertia[1], first);
        zz = Get(inertia[2], first);
        xy = Get(inertia[3], first);
        xz = Get(inertia[4], first);
        yz = Get(inertia[5], first);
    }
    HWY_INLINE Vectors At(Vectors arm) const {
        return ice::HWY_NAMESPACE::Add(velocity, Cross(angular_velocity, arm));
    }
    HWY_INLINE void Push(Vectors arm, Vectors j) {
        velocity = ice::HWY_NAMESPACE::Add(velocity, Scale(inverse_mass, j));
        const Vectors m = Cross(arm, j);
        angular_velocity = ice::HWY_NAMESPACE::Add(
            angular_velocity, {Dot({xx, xy, xz}, m), Dot({xy, yy, yz}, m), Dot({xz, yz, zz}, m)});
    }
    HWY_INLINE void Store(const std::array<std::int32_t, kLanes>& body, const LaneValues& mass,
                          std::size_t first, std::vector<BodyMotion>& motion) const {
        LaneValues values[6];
        Put(velocity.x, values[0], 0);
        Put(velocity.y, values[1], 0);
        Put(velocity.z, values[2], 0);
        Put(angular_velocity.x, values[3], 0);
        Put(angular_velocity.y, values[4], 0);
        Put(angular_velocity.z, values[5], 0);
        for (std::size_t k = 0; k < hn::Lanes(Tag()); ++k) {
            if (mass.v[first + k] == 0.0) continue;
            BodyMotion& m = motion[static_cast<std::size_t>(body[first + k])];
            for (std::size_t d = 0; d < 6; ++d) m.v[d] = values[d].v[k];
        }
    }
};

// Largest changes of velocity so far; the tangential one squared.
struct Changes {
    Lanes normal, tangent_sq;
};

HWY_INLINE void Solve(ContactRow& row, std::size_t lane, Side& a, Side& b, Changes& most) {
    const Tag d;
    const Vectors n = Get(row.normal, lane);
    const Vectors arm_a = Get(row.arm_a, lane), arm_b = Get(row.arm_b, lane);
    const Vectors v = Sub(b.At(arm_b), a.At(arm_a));
    const Lanes normal = Get(row.impulse.normal, lane);
    const Lanes reached = hn::Add(
        normal, hn::Mul(hn::Sub(Get(row.wanted, lane), Dot(n, v)), Get(row.normal_mass, lane)));
    const Lanes next = hn::Min(hn::Max(reached, hn::Zero(d)), Get(row.bound, lane));
    const Lanes change = hn::Sub(next, normal);
    Put(next, row.impulse.normal, lane);

    const Vectors after = Add(v, Scale(change, Get(row.response, lane)));
    const Vectors sliding = Sub(after, Scale(Dot(n, after), n));
    const Vectors before = Get(row.impulse.tangent, lane);
    const Vectors free = Sub(before, Scale(Get(row.tangent_mass, lane), sliding));
    const Lanes size_sq = Dot(free, free), limit = hn::Mul(Get(row.friction, lane), next);
    const auto slides = hn::Gt(size_sq, hn::Mul(limit, limit));
    const Lanes shorter =
        hn::IfThenElse(slides, hn::Div(limit, hn::Sqrt(size_sq)), hn::Set(d, 1.0));
    const Vectors tangent = Scale(shorter, free);
    const Vectors turned = Sub(tangent, before);
    Put(tangent.x, row.impulse.tangent[0], lane);
    Put(tangent.y, row.impulse.tangent[1], lane);
    Put(tangent.z, row.impulse.tangent[2], lane);

    const Vectors j = Add(Scale(change, n), turned);
    a.Push(arm_a, Scale(hn::Set(d, -1.0), j));
    b.Push(arm_b, j);
    const Lanes k = Get(row.tangent_response, lane);
    most.normal = hn::Max(most.normal, hn::Mul(hn::Abs(change), Get(row.normal_response, lane)));
    most.tangent_sq = hn::Max(most.tangent_sq, hn::Mul(Dot(turned, turned), hn::Mul(k, k)));
}

// As many pairs of a block as the machine has lanes, with their bodies' velocities.
struct Stream {
    const PairBlock* block;
    std::size_t lane;
    ContactRow* row;
    Side a, b;

    HWY_INLINE void Begin(const PairBlock& pairs, std::size_t first, std::vector<ContactRow>& rows,
                          const std::vector<BodyMotion>& motion) {
        block = &pairs;
        lane = first;
        row = rows.data() + pairs.first_row;
        a.Load(pairs.a, motion, pairs.inverse_mass_a, pairs.inverse_inertia_a, lane);
        b.Load(pairs.b, motion, pairs.inverse_mass_b, pairs.inverse_inertia_b, lane);
    }
    HWY_INLINE void End(std::vector<BodyMotion>& motion) const {
        a.Store(block->a, block->inverse_mass_a, lane, motion);
        b.Store(block->b, block->inverse_mass_b, lane, motion);
    }
};

// A contact waits for the one before it in its pair. Two streams that share no free body are taken
// in turn: one computes while the other waits.
double Sweep(const std::vector<PairBlock>& blocks, std::vector<ContactRow>& rows,
             std::vector<BodyMotion>& motion) {
    const Tag d;
    const std::size_t parts = kLanes / hn::Lanes(d), streams = parts * blocks.size();
    Changes most{hn::Zero(d), hn::Zero(d)};
    for (std::size_t k = 0; k < streams;) {
        const PairBlock& pairs = blocks[k / parts];
        Stream one, two;
        one.Begin(pairs, k % parts * hn::Lanes(d), rows, motion);
        ++k;
        std::int32_t r = 0;
        if (k < streams && blocks[k / parts].colour == pairs.colour) {
            two.Begin(blocks[k / parts], k % parts * hn::Lanes(d), rows, motion);
            ++k;
            for (; r < two.block->rows; ++r) {  // the later block has no more rows
                Solve(one.row[r], one.lane, one.a, one.b, most);
                Solve(two.row[r], two.lane, two.a, two.b, most);
            }
            two.End(motion);
        }
        for (; r < pairs.rows; ++r) Solve(one.row[r], one.lane, one.a, one.b, most);
        one.End(motion);
    }
    return std::max(hn::GetLane(hn::MaxOfLanes(d, most.normal)),
                    std::sqrt(hn::GetLane(hn::MaxOfLanes(d, most.tangent_sq))));
}

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
                                         Get(rows[r].normal_response, lane)));
        }
        Put(part, sum, lane);
    }
    const double* s = sum.v;
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
}

HWY_INLINE void MoveOn(double* values, double* before, double* way, Lanes beta) {
    const Tag d;
    for (std::size_t k = 0; k < kLanes; k += hn::Lanes(d)) {
        const Lanes value = hn::LoadU(d, values + k), direction = hn::LoadU(d, way + k);
        const Lanes change = hn::Sub(value, hn::LoadU(d, before + k));
        const Lanes step = hn::Mul(beta, direction);
        const Lanes next = hn::Add(value, step);
        hn::StoreU(next, d, values + k);
        hn::StoreU(hn::Add(step, change), d, way + k);
        hn::StoreU(next, d, before + k);
    }
}

void MoveOnAll(std::vector<ContactRow>& rows, std::vector<BodyMotion>& motion, double beta,
               SweepMemory& memory) {
    const Lanes share = hn::Set(Tag(), beta);
    for (std::size_t r = 0; r < rows.size(); ++r) {
        RowImpulses &now = rows[r].impulse, &before = memory.before[r], &way = memory.way[r];
        MoveOn(now.normal.v, before.normal.v, way.normal.v, share);
        for (std::size_t axis = 0; axis < 3; ++axis)
            MoveOn(now.tangent[axis].v, before.tangent[axis].v, way.tangent[axis].v, share);
    }
    for (std::size_t k = 0; k < motion.size(); ++k)
        MoveOn(motion[k].v, memory.motion_before[k].v, memory.motion_way[k].v, share);
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ice {
HWY_EXPORT(Sweep);
HWY_EXPORT(MeasureChange);
HWY_EXPORT(MoveOnAll);

double sweep(const std::vector<PairBlock>& blocks, std::vector<ContactRow>& rows,
             std::vector<BodyMotion>& motion) {
    return HWY_DYNAMIC_DISPATCH(Sweep)(blocks, rows, motion);
}

double measure_change(const std::vector<ContactRow>& rows, const SweepMemory& memory) {
    return HWY_DYNAMIC_DISPATCH(MeasureChange)(rows, memory);
}

void move_on(std::vector<ContactRow>& rows, std::vector<BodyMotion>& motion, double beta,
             SweepMemory& memory) {
    HWY_DYNAMIC_DISPATCH(MoveOnAll)(rows, motion, beta, memory);
}
}  // namespace ice
#endif
