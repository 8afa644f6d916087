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

#include "solver/contact/motion_lanes-inl.hpp"
#include "solver/contact/row_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The bodies a or b of streams' pairs while their contacts are swept.
template <std::size_t N>
struct Side {
    WideVectors<N> velocity, angular_velocity;
    Wide<N> inverse_mass, xx, yy, zz, xy, xz, yz;  // the latter of the inverse inertia

    HWY_INLINE WideVectors<N> At(const WideVectors<N>& arm) const {
        return velocity + Cross(angular_velocity, arm);
    }
    HWY_INLINE void Push(const WideVectors<N>& arm, const WideVectors<N>& j) {
        velocity = velocity + inverse_mass * j;
        const WideVectors<N> m = Cross(arm, j);
        angular_velocity =
            angular_velocity +
            WideVectors<N>{Dot({xx, xy, xz}, m), Dot({xy, yy, yz}, m), Dot({xz, yz, zz}, m)};
    }
    template <std::size_t M>
    HWY_INLINE void Take(const Side<M>& from, std::size_t s, std::size_t as) {
        const auto take = [&](Wide<N>& to, const Wide<M>& value)
                              HWY_ATTR { to.of[as] = value.of[s]; };
        const auto take_vector = [&](WideVectors<N>& to, const WideVectors<M>& value) HWY_ATTR {
            take(to.x, value.x), take(to.y, value.y), take(to.z, value.z);
        };
        take_vector(velocity, from.velocity);
        take_vector(angular_velocity, from.angular_velocity);
        take(inverse_mass, from.inverse_mass);
        take(xx, from.xx), take(yy, from.yy), take(zz, from.zz);
        take(xy, from.xy), take(xz, from.xz), take(yz, from.yz);
    }
};

HWY_INLINE Side<1> LoadSide(const std::array<std::int32_t, kLanes>& body,
                            const std::vector<BodyMotion>& motion, const LaneValues& mass,
                            const std::array<LaneValues, 6>& inverse_inertia, std::size_t first) {
    // lanes without a pair have no mass and no contacts: any body will do
    const Motions m = LoadMotions(body.data() + first, motion);
    const auto value = [&](std::size_t d) HWY_ATTR { return Wide<1>{{m.entry[d]}}; };
    const auto entry = [&](std::size_t k)
                           HWY_ATTR { return Wide<1>{{Get(inverse_inertia[k], first)}}; };
    return {{value(0), value(1), value(2)},
            {value(3), value(4), value(5)},
            {{Get(mass, first)}},
            entry(0),
            entry(1),
            entry(2),
            entry(3),
            entry(4),
            entry(5)};
}

template <std::size_t N>
HWY_INLINE void StoreSide(const Side<N>& side, std::size_t s,
                          const std::array<std::int32_t, kLanes>& body, const LaneValues& mass,
                          std::size_t first, std::vector<BodyMotion>& motion) {
    const Lanes unused = hn::Zero(Tag());
    StoreMotions({{side.velocity.x.of[s], side.velocity.y.of[s], side.velocity.z.of[s],
                   side.angular_velocity.x.of[s], side.angular_velocity.y.of[s],
                   side.angular_velocity.z.of[s], unused, unused}},
                 body.data() + first, mass.v + first, motion);
}

// Largest changes of velocity so far; the tangential one squared.
struct Changes {
    Lanes normal, tangent_sq;
};

// As many pairs of a block as the machine has lanes, at one of their rows.
struct Stream {
    const PairBlock* block;
    std::size_t lane;
    ContactRow* row;
    std::int32_t left;  // rows
};

// N streams that share no free body.
template <std::size_t N>
struct Streams {
    Stream of[N];
    Side<N> a, b;

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

template <std::size_t N>
HWY_INLINE void Streams<N>::Solve(Changes& most) {
    const Tag d;
    const auto vectors = [&](LaneVectors ContactRow::*part) HWY_ATTR {
        return ReadVectors([=](const ContactRow& row) -> const LaneVectors& { return row.*part; });
    };
    const auto values = [&](LaneValues ContactRow::*part) HWY_ATTR {
        return Read([=](const ContactRow& row) -> const LaneValues& { return row.*part; });
    };
    // normal impulse: what brings v_r . n to its target, between 0 and its bound
    const WideVectors<N> n = vectors(&ContactRow::normal);
    const WideVectors<N> arm_a = vectors(&ContactRow::arm_a), arm_b = vectors(&ContactRow::arm_b);
    const WideVectors<N> v = b.At(arm_b) - a.At(arm_a);
    const auto normal_of = [](auto& row) -> auto& { return row.impulse.normal; };
    const Wide<N> normal = Read(normal_of), bound = values(&ContactRow::max_impulse);
    Wide<N> next = normal + (values(&ContactRow::target_velocity) - Dot(n, v)) *
                                values(&ContactRow::effective_mass);
    for (std::size_t s = 0; s < N; ++s)
        next.of[s] = hn::Min(hn::Max(next.of[s], hn::Zero(d)), bound.of[s]);
    const Wide<N> change = next - normal;
    Write(next, normal_of);

    // friction against the sliding that is left, cut back to the cone
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

template <std::size_t N>
HWY_INLINE void Begin(const Stream& stream, const std::vector<BodyMotion>& motion,
                      Streams<N>& streams, std::size_t s) {
    const PairBlock& pairs = *stream.block;
    const std::size_t lane = stream.lane;
    streams.of[s] = stream;
    streams.a.Take(LoadSide(pairs.a, motion, pairs.inverse_mass_a, pairs.inverse_inertia_a, lane),
                   0, s);
    streams.b.Take(LoadSide(pairs.b, motion, pairs.inverse_mass_b, pairs.inverse_inertia_b, lane),
                   0, s);
}

template <std::size_t N>
HWY_INLINE void End(const Streams<N>& streams, std::size_t s, std::vector<BodyMotion>& motion) {
    const Stream& stream = streams.of[s];
    const PairBlock& pairs = *stream.block;
    StoreSide(streams.a, s, pairs.a, pairs.inverse_mass_a, stream.lane, motion);
    StoreSide(streams.b, s, pairs.b, pairs.inverse_mass_b, stream.lane, motion);
}

template <std::size_t N>
HWY_INLINE Streams<N - 1> Without(std::size_t left_out, const Streams<N>& streams) {
    Streams<N - 1> out;
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
    std::size_t lane;
    std::vector<ContactRow>* rows;

    HWY_INLINE bool IsEmpty() const { return block == end; }
    HWY_INLINE Stream Next() {
        const Stream out{block, lane, rows->data() + block->first_row, block->rows};
        lane += hn::Lanes(Tag());
        if (lane == kLanes) {
            lane = 0;
            ++block;
        }
        return out;
    }
};

// Takes streams to their ends. Where one ends another begins; the last ones end alone.
template <std::size_t N>
HWY_INLINE void Finish(Streams<N>& streams, Waiting& waiting, std::vector<BodyMotion>& motion,
                       Changes& most) {
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
                Streams<N - 1> others = Without(s, streams);
                Finish(others, waiting, motion, most);
            }
            return;
        }
    }
}

// Begins up to N streams, and takes all to their ends.
template <std::size_t N>
HWY_INLINE void Run(Waiting waiting, std::vector<BodyMotion>& motion, Changes& most) {
    if constexpr (N > 1) {
        const auto streams =
            static_cast<std::size_t>(waiting.end - waiting.block) * (kLanes / hn::Lanes(Tag()));
        if (streams < N) return Run<N - 1>(waiting, motion, most);
    }
    Streams<N> streams;
    for (std::size_t s = 0; s < N; ++s) Begin(waiting.Next(), motion, streams, s);
    Finish(streams, waiting, motion, most);
}

// Streams beside each other; a third gains nothing.
constexpr std::size_t kStreams = 2;

double Sweep(const std::vector<PairBlock>& blocks, std::vector<ContactRow>& rows,
             std::vector<BodyMotion>& motion) {
    const Tag d;
    Changes most{hn::Zero(d), hn::Zero(d)};
    const PairBlock* const end = blocks.data() + blocks.size();
    for (const PairBlock* first = blocks.data(); first != end;) {
        const PairBlock* last = first;
        while (last != end && last->colour == first->colour) ++last;
        Run<kStreams>({first, last, 0, &rows}, motion, most);
        first = last;
    }
    return std::max(hn::GetLane(hn::MaxOfLanes(d, most.normal)),
                    std::sqrt(hn::GetLane(hn::MaxOfLanes(d, most.tangent_sq))));
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ice {
HWY_EXPORT(Sweep);

double sweep(const std::vector<PairBlock>& blocks, std::vector<ContactRow>& rows,
             std::vector<BodyMotion>& motion) {
    return HWY_DYNAMIC_DISPATCH(Sweep)(blocks, rows, motion);
}
}  // namespace ice
#endif
