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

#include "solver/contact/side_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Largest changes of velocity so far; the tangential one squared.
struct Changes {
    Lanes normal, tangent_sq;
};

// As many pairs of a block as the machine has lanes, at one of their rows.
struct Stream {
    const PairBlock* block;
    const PairExcess* excess;  // of the block; null where no body has added mass
    std::size_t lane;
    ContactRow* row;
    std::int32_t left;  // rows
};

// N streams that share no free body.
template <std::size_t N, bool kWater>
struct Streams {
    Stream of[N];
    Side<N, kWater> a, b;

    template <class Part>
    HWY_INLINE Wide<N> Read(const Part& part) const {
        Wide<N> out;
        for (std::size_t s = 0; s < N; ++s) out.of[s] = Get(part(*of[s].row), of[s].lane);
        return out;
    }
    template <class Part>
    HWY_INLINE WideVectors<N> ReadVectors(const Part& part) const {
        const auto axis = [&](std::size_t d) HWY_ATTR {
            return Read([&](const ContactRow& row) -> const LaneValues& { return part(row)[d]; });
        };
        return {axis(0), axis(1), axis(2)};
    }
    template <class Part>
    HWY_INLINE void Write(const Wide<N>& value, const Part& part) {
        for (std::size_t s = 0; s < N; ++s) Put(value.of[s], part(*of[s].row), of[s].lane);
    }

    HWY_INLINE void Solve(Changes& most);
};

// One row of each stream: reference solve() of sweep_reference.cpp. The single operations of the
// streams alternate: row by row in turn a contact took 6.5 instead of 5.0 ns on AVX-512
// (docs/design-notes.md).
template <std::size_t N, bool kWater>
HWY_INLINE void Streams<N, kWater>::Solve(Changes& most) {
    const Tag d;
    const auto vectors = [&](LaneVectors ContactRow::*part) HWY_ATTR {
        return ReadVectors([=](const ContactRow& row) -> const LaneVectors& { return row.*part; });
    };
    const auto values = [&](LaneValues ContactRow::*part) HWY_ATTR {
        return Read([=](const ContactRow& row) -> const LaneValues& { return row.*part; });
    };
    // (9): the normal impulse that brings v_r . n to its target, between 0 and its bound
    const WideVectors<N> n = vectors(&ContactRow::normal);
    const WideVectors<N> arm_a = vectors(&ContactRow::arm_a), arm_b = vectors(&ContactRow::arm_b);
    const WideVectors<N> v = b.At(arm_b) - a.At(arm_a);
    const auto normal_of = [](auto& row) -> auto& { return row.impulse.normal; };
    const Wide<N> normal = Read(normal_of), bound = values(&ContactRow::max_impulse);
    Wide<N> next = normal + (values(&ContactRow::target_velocity) - Dot(n, v)) *
                                values(&ContactRow::effective_mass);
    // lanes without a contact have bound 0 and effective mass 0: their impulse stays 0
    for (std::size_t s = 0; s < N; ++s)
        next.of[s] = hn::Min(hn::Max(next.of[s], hn::Zero(d)), bound.of[s]);
    const Wide<N> change = next - normal;
    Write(next, normal_of);

    // (10): friction against the sliding that the normal impulse leaves, shortened to the cone
    const WideVectors<N> after = v + change * vectors(&ContactRow::response);
    const WideVectors<N> sliding = after - Dot(n, after) * n;
    const WideVectors<N> before = ReadVectors(
        [](const ContactRow& row) -> const LaneVectors& { return row.impulse.tangent; });
    const WideVectors<N> free = before - values(&ContactRow::tangent_effective_mass) * sliding;
    const Wide<N> size_sq = Dot(free, free), limit = values(&ContactRow::friction) * next;
    const Wide<N> limit_sq = limit * limit;
    Wide<N> shorter;
    for (std::size_t s = 0; s < N; ++s)
        shorter.of[s] =
            hn::IfThenElse(hn::Gt(size_sq.of[s], limit_sq.of[s]),
                           hn::Div(limit.of[s], hn::Sqrt(size_sq.of[s])), hn::Set(d, 1.0));
    const WideVectors<N> tangent = shorter * free;
    const WideVectors<N> turned = tangent - before;
    Write(tangent.x, [](ContactRow& row) -> LaneValues& { return row.impulse.tangent[0]; });
    Write(tangent.y, [](ContactRow& row) -> LaneValues& { return row.impulse.tangent[1]; });
    Write(tangent.z, [](ContactRow& row) -> LaneValues& { return row.impulse.tangent[2]; });

    // both bodies take the change; the largest change of a velocity decides when sweeps end
    const WideVectors<N> j = change * n + turned;
    Wide<N> minus;
    for (std::size_t s = 0; s < N; ++s) minus.of[s] = hn::Set(d, -1.0);
    a.Push(arm_a, minus * j);
    b.Push(arm_b, j);
    const Wide<N> k = values(&ContactRow::tangent_inverse_effective_mass);
    const Wide<N> slid = Dot(turned, turned) * (k * k);
    const Wide<N> response = values(&ContactRow::inverse_effective_mass);
    for (std::size_t s = 0; s < N; ++s) ++of[s].row;
    for (std::size_t s = 0; s < N; ++s) {
        most.normal = hn::Max(most.normal, hn::Mul(hn::Abs(change.of[s]), response.of[s]));
        most.tangent_sq = hn::Max(most.tangent_sq, slid.of[s]);
    }
}

// Velocities of a block's pairs go to registers, where they stay until its last row.
template <std::size_t N, bool kWater>
HWY_INLINE void Begin(const Stream& stream, const std::vector<BodyMotion>& motion,
                      Streams<N, kWater>& streams, std::size_t s) {
    const PairBlock& pairs = *stream.block;
    const std::size_t lane = stream.lane;
    streams.of[s] = stream;
    const PairExcess* water = stream.excess;
    streams.a.Take(LoadSide<kWater>(pairs.a, motion, pairs.inverse_mass_a, pairs.inverse_inertia_a,
                                    kWater ? &water->a : nullptr, lane),
                   0, s);
    streams.b.Take(LoadSide<kWater>(pairs.b, motion, pairs.inverse_mass_b, pairs.inverse_inertia_b,
                                    kWater ? &water->b : nullptr, lane),
                   0, s);
}

// ... and back; immovable bodies, which other pairs share, are not written (StoreMotions).
template <std::size_t N, bool kWater>
HWY_INLINE void End(const Streams<N, kWater>& streams, std::size_t s,
                    std::vector<BodyMotion>& motion) {
    const Stream& stream = streams.of[s];
    const PairBlock& pairs = *stream.block;
    StoreSide(streams.a, s, pairs.a, pairs.inverse_mass_a, stream.lane, motion);
    StoreSide(streams.b, s, pairs.b, pairs.inverse_mass_b, stream.lane, motion);
}

// The streams that are left when one has ended and none waits.
template <std::size_t N, bool kWater>
HWY_INLINE Streams<N - 1, kWater> Without(std::size_t left_out, const Streams<N, kWater>& streams) {
    Streams<N - 1, kWater> out;
    for (std::size_t s = 0; s + 1 < N; ++s) {
        const std::size_t from = s < left_out ? s : s + 1;
        out.of[s] = streams.of[from];
        out.a.Take(streams.a, from, s);
        out.b.Take(streams.b, from, s);
    }
    return out;
}

// The streams of a colour that have not begun.
struct Waiting {
    const PairBlock* block;
    const PairBlock* end;
    const PairExcess* excess;  // of the block, or null
    std::size_t lane;
    std::vector<ContactRow>* rows;

    HWY_INLINE bool IsEmpty() const { return block == end; }
    HWY_INLINE Stream Next() {
        const Stream out{block, excess, lane, rows->data() + block->first_row, block->rows};
        lane += hn::Lanes(Tag());
        if (lane == kLanes) {
            lane = 0;
            ++block;
            if (excess != nullptr) ++excess;
        }
        return out;
    }
};

// Takes streams to their ends. Where one ends another begins; the last ones end alone.
template <std::size_t N, bool kWater>
HWY_INLINE void Finish(Streams<N, kWater>& streams, Waiting& waiting,
                       std::vector<BodyMotion>& motion, Changes& most) {
    // All streams do as many rows as the shortest has left, so that no lane is masked.
    while (true) {
        std::int32_t together = streams.of[0].left;
        for (std::size_t s = 1; s < N; ++s) together = std::min(together, streams.of[s].left);
        for (std::int32_t r = 0; r < together; ++r) streams.Solve(most);
        for (std::size_t s = 0; s < N; ++s) streams.of[s].left -= together;
        for (std::size_t s = 0; s < N; ++s) {
            if (streams.of[s].left > 0) continue;
            End(streams, s, motion);
            if (!waiting.IsEmpty()) {
                Begin(waiting.Next(), motion, streams, s);
                continue;
            }
            if constexpr (N > 1) {
                Streams<N - 1, kWater> others = Without(s, streams);
                Finish(others, waiting, motion, most);
            }
            return;
        }
    }
}

// Begins up to N streams, and takes all to their ends.
template <std::size_t N, bool kWater>
HWY_INLINE void Run(Waiting waiting, std::vector<BodyMotion>& motion, Changes& most) {
    if constexpr (N > 1) {
        const auto streams =
            static_cast<std::size_t>(waiting.end - waiting.block) * (kLanes / hn::Lanes(Tag()));
        // a narrower kernel, so that no stream is a dummy
        if (streams < N) return Run<N - 1, kWater>(waiting, motion, most);
    }
    Streams<N, kWater> streams;
    for (std::size_t s = 0; s < N; ++s) Begin(waiting.Next(), motion, streams, s);
    Finish(streams, waiting, motion, most);
}

// Streams side by side [-]. Each row waits for the velocities that the row before it has left, and
// a second stream uses that time; a third gains nothing, and with four velocities no longer stay in
// registers. The bits are the same.
constexpr std::size_t kStreams = 2;

double Sweep(const std::vector<PairBlock>& blocks, std::vector<ContactRow>& rows,
             std::vector<BodyMotion>& motion, const std::vector<PairExcess>& excess) {
    const Tag d;
    Changes most{hn::Zero(d), hn::Zero(d)};
    const PairBlock* const end = blocks.data() + blocks.size();
    // colour by colour: pairs of one colour share no free body and may be swept in any order
    for (const PairBlock* first = blocks.data(); first != end;) {
        const PairBlock* last = first;
        while (last != end && last->colour == first->colour) ++last;
        if (excess.empty())
            Run<kStreams, false>({first, last, nullptr, 0, &rows}, motion, most);
        else
            Run<kStreams, true>({first, last, &excess[first - blocks.data()], 0, &rows}, motion,
                                most);
        first = last;
    }
    // a maximum needs no order, unlike a sum: the same on every machine
    return std::max(hn::GetLane(hn::MaxOfLanes(d, most.normal)),
                    std::sqrt(hn::GetLane(hn::MaxOfLanes(d, most.tangent_sq))));
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ice {
HWY_EXPORT(Sweep);

double sweep(const std::vector<PairBlock>& blocks, std::vector<ContactRow>& rows,
             std::vector<BodyMotion>& motion, const std::vector<PairExcess>& excess) {
    return HWY_DYNAMIC_DISPATCH(Sweep)(blocks, rows, motion, excess);
}
}  // namespace ice
#endif
