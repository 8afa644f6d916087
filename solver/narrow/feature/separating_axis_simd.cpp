// SPDX-License-Identifier: GPL-3.0-or-later
// Separating axes, as many planes or edges of a piece at a time as the machine has lanes, compiled
// once per instruction set. The mathematics is in separating_axis_reference.cpp.
#include "common/base/assert.hpp"
#include "solver/narrow/feature/separating_axis.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/narrow/feature/separating_axis_simd.cpp"
#include <hwy/foreach_target.h>  // must precede highway.h
#include <hwy/highway.h>

#include "common/math/vector_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kBlock = VectorBlock::kLanes;
constexpr std::size_t kMostCorners = ConvexPiece::kMost / kBlock;

HWY_INLINE Vectors Get(const VectorBlock& from, std::size_t lane) {
    const Tag d;
    return {hn::Load(d, from.x + lane), hn::Load(d, from.y + lane), hn::Load(d, from.z + lane)};
}
HWY_INLINE Vectors Broadcast(const VectorBlock& from, std::size_t lane) {
    const Tag d;
    return {hn::Set(d, from.x[lane]), hn::Set(d, from.y[lane]), hn::Set(d, from.z[lane])};
}
HWY_INLINE void Put(Vectors v, VectorBlock& to, std::size_t lane) {
    const Tag d;
    hn::Store(v.x, d, to.x + lane);
    hn::Store(v.y, d, to.y + lane);
    hn::Store(v.z, d, to.z + lane);
}

struct Pose {
    Vectors row[3], translation;
};

HWY_INLINE Pose Broadcast(const RelativePose& pose) {
    Pose out;
    for (int r = 0; r < 3; ++r) out.row[r] = Set(Vec3(pose.rotation.row(r)));
    out.translation = Set(pose.translation);
    return out;
}
HWY_INLINE Vectors Turned(const Pose& pose, Vectors v) {
    return {Dot(pose.row[0], v), Dot(pose.row[1], v), Dot(pose.row[2], v)};
}

// Vectors of b in a's axes: moved once, instead of for each vector of a.
template <std::size_t kBlocks>
struct Moved {
    VectorBlock blocks[kBlocks];

    template <class Move>
    HWY_INLINE void Fill(const VectorBlocks& from, const Move& move) {
        const Tag d;
        for (std::size_t k = 0; k < from.blocks().size(); ++k)
            for (std::size_t lane = 0; lane < kBlock; lane += hn::Lanes(d))
                Put(move(Get(from.blocks()[k], lane)), blocks[k], lane);
    }
};

// The widest gap and its number, the first of equals.
struct Widest {
    double gap = SeparatingAxes::kNone;
    std::int32_t number = -1;
};

HWY_INLINE void Reduce(Lanes gaps, std::size_t first, std::size_t count, Widest& widest) {
    const Tag d;
    HWY_ALIGN double gap[kBlock];
    hn::Store(gaps, d, gap);
    // lanes in ascending order, so that the first of equals wins as in the reference
    for (std::size_t lane = 0; lane < hn::Lanes(d) && first + lane < count; ++lane)
        if (gap[lane] > widest.gap) {
            widest.gap = gap[lane];
            widest.number = static_cast<std::int32_t>(first + lane);
        }
}

// The widest gap of planes to corners in the same axes. Lanes are planes, so that each has its own
// minimum over the corners and no sum is across lanes.
template <class Offset>
HWY_INLINE Widest GapOfPlanes(const VectorBlock* normals, std::size_t planes, const Offset& offset,
                              const VectorBlock* corners, std::size_t corner_count) {
    const Tag d;
    Widest widest;
    for (std::size_t k = 0; k < planes; k += kBlock)
        for (std::size_t lane = 0; lane < kBlock; lane += hn::Lanes(d)) {
            const Vectors n = Get(normals[k / kBlock], lane);
            Lanes least = hn::Set(d, std::numeric_limits<double>::infinity());
            // one corner at a time against as many planes as there are lanes
            for (std::size_t c = 0; c < corner_count; ++c)
                least = hn::Min(least, Dot(n, Broadcast(corners[c / kBlock], c % kBlock)));
            Reduce(hn::Sub(least, offset(k + lane, n)), k + lane, planes, widest);
        }
    return widest;
}

struct Crossing {
    Lanes gap, edge_a;
};

// The widest gap between a's edges and these of b, and the first of a's edges that has it.
HWY_INLINE Crossing CrossEdges(const ConvexPiece& a, Vectors eb, Vectors b1, Vectors b2,
                               Vectors pb) {
    const Tag d;
    const Lanes zero = hn::Zero(d), none = hn::Set(d, SeparatingAxes::kNone);
    const Lanes parallel = hn::Set(d, SeparatingAxes::kParallelSquared);
    Crossing best{none, hn::Set(d, -1.0)};
    for (std::size_t k = 0; k < a.edges.size(); ++k) {
        const std::size_t block = k / kBlock, at = k % kBlock;
        const Vectors ea = Broadcast(a.edge_along.blocks()[block], at);
        const Vectors a1 = Broadcast(a.edge_left.blocks()[block], at);
        const Vectors a2 = Broadcast(a.edge_right.blocks()[block], at);
        // arcs_cross of the reference, on one of a's edges and as many of b's as there are
        // lanes
        const Lanes b1_ea = Dot(b1, ea), a2_eb = Dot(a2, eb);
        const Mask cross = hn::And(hn::And(hn::Lt(hn::Mul(b1_ea, Dot(b2, ea)), zero),
                                           hn::Lt(hn::Mul(Dot(a1, eb), a2_eb), zero)),
                                   hn::Lt(hn::Mul(b1_ea, a2_eb), zero));
        if (hn::AllFalse(d, cross)) continue;
        // The gap along the common perpendicular; `outward` turns it away from a. Parallel edges
        // divide by nearly 0 and are masked out below.
        const Vectors across = Cross(ea, eb);
        const Lanes square = Dot(across, across);
        const Lanes apart = Dot(across, Sub(pb, Broadcast(a.edge_middle.blocks()[block], at)));
        const Mask outward = hn::Ge(Dot(across, Add(a1, a2)), zero);
        const Lanes gap = hn::Div(hn::IfThenElse(outward, apart, hn::Neg(apart)), hn::Sqrt(square));
        const Mask better =
            hn::And(hn::And(cross, hn::Gt(square, parallel)), hn::Gt(gap, best.gap));
        best.gap = hn::IfThenElse(better, gap, best.gap);
        best.edge_a = hn::IfThenElse(better, hn::Set(d, static_cast<double>(k)), best.edge_a);
    }
    return best;
}

// Lanes are b's edges: a's are broadcast one by one, and most of them have no lane that crosses.
HWY_INLINE void FindCrossing(const ConvexPiece& a, const ConvexPiece& b, const Pose& pose,
                             SeparatingAxes& out) {
    const Tag d;
    for (std::size_t k = 0; k < b.edges.size(); k += kBlock)
        for (std::size_t lane = 0; lane < kBlock; lane += hn::Lanes(d)) {
            const std::size_t block = k / kBlock;
            const auto turned = [&](const VectorBlocks& of) HWY_ATTR {
                return Turned(pose, Get(of.blocks()[block], lane));
            };
            const Vectors eb = turned(b.edge_along), b1 = turned(b.edge_left),
                          b2 = turned(b.edge_right),
                          pb = Add(turned(b.edge_middle), pose.translation);
            const Crossing found = CrossEdges(a, eb, b1, b2, pb);
            HWY_ALIGN double gap[kBlock], edge_a[kBlock];
            hn::Store(found.gap, d, gap);
            hn::Store(found.edge_a, d, edge_a);
            // The reference walks a's edges outside and b's inside: of equal gaps the smaller
            // number of a's edge wins, then the smaller of b's.
            for (std::size_t n = 0; n < hn::Lanes(d) && k + lane + n < b.edges.size(); ++n) {
                const auto ka = static_cast<std::int32_t>(edge_a[n]);
                if (gap[n] < out.edges || ka < 0) continue;
                if (gap[n] == out.edges && ka >= out.edge_a) continue;
                out.edges = gap[n];
                out.edge_a = ka;
                out.edge_b = static_cast<std::int32_t>(k + lane + n);
            }
        }
}

SeparatingAxes FindAxes(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& relative,
                        double enough) {
    const Tag d;
    const Pose pose = Broadcast(relative);
    SeparatingAxes out;
    // From the cheapest test to the dearest: a's planes against b's corners, b's planes against a's
    // corners, and all pairs of edges. Any gap above `enough` ends the search: the
    // pair is apart.
    Moved<kMostCorners> moved;
    moved.Fill(b.corners,
               [&](Vectors v) HWY_ATTR { return Add(Turned(pose, v), pose.translation); });
    const Widest face_a = GapOfPlanes(
        a.normals.blocks().data(), a.normals.size(),
        [&](std::size_t k, Vectors) HWY_ATTR { return hn::LoadU(d, a.offsets.data() + k); },
        moved.blocks, b.corners.size());
    out.face_a = face_a.gap;
    out.plane_a = face_a.number;
    if (out.face_a > enough) return out;
    moved.Fill(b.normals, [&](Vectors v) HWY_ATTR { return Turned(pose, v); });
    const Widest face_b = GapOfPlanes(
        moved.blocks, b.normals.size(),
        [&](std::size_t k, Vectors n) HWY_ATTR {
            return hn::Add(hn::LoadU(d, b.offsets.data() + k), Dot(n, pose.translation));
        },
        a.corners.blocks().data(), a.corners.size());
    out.face_b = face_b.gap;
    out.plane_b = face_b.number;
    if (out.face_b > enough) return out;
    FindCrossing(a, b, pose, out);
    return out;
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ice {
HWY_EXPORT(FindAxes);

SeparatingAxes find_axes(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                         double enough) {
    ICE_ASSERT(!a.empty() && !b.empty());
    return HWY_DYNAMIC_DISPATCH(FindAxes)(a, b, pose, enough);
}
}  // namespace ice
#endif
