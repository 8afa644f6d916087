// SPDX-License-Identifier: GPL-3.0-or-later
// The search for near spheres, as many at a time as the machine has lanes, compiled once per
// instruction set. The mathematics is in near_spheres_reference.cpp.
#include "solver/narrow/neighbours/near_spheres.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/narrow/neighbours/near_spheres_simd.cpp"
#include <hwy/foreach_target.h>  // must precede highway.h
#include <hwy/highway.h>

#include "solver/narrow/neighbours/compress_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kBlock = SphereBlocks::kGroup;

using Tag = hn::CappedTag<float, kBlock>;
using IdTag = hn::RebindToSigned<Tag>;
using Lanes = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

// Not CompressStore(), which is slow on AMD's AVX-512.
HWY_INLINE void Append(Lanes values, Mask which, float* to) {
    hn::StoreU(Compressed(Tag(), values, which), Tag(), to);
}

HWY_INLINE void Append(const std::int32_t* ids, Mask which, std::int32_t* to) {
    const IdTag d;
    hn::StoreU(Compressed(d, hn::LoadU(d, ids), hn::RebindMask(d, which)), d, to);
}

// Appends the numbers of those of 16 boxes from `first` on that touch `box` grown by `grow`.
HWY_INLINE std::size_t TouchingBoxes(const BoxRows& rows, std::size_t first, const FloatBox& box,
                                     float grow, std::int32_t* out) {
    const Tag d;
    const IdTag di;
    std::size_t found = 0;
    // boxes overlap unless one of six faces separates them; lanes are boxes
    for (std::size_t k = first; k < first + kBlock; k += hn::Lanes(d)) {
        Mask near = hn::Le(hn::LoadU(d, rows.low[0].data() + k), hn::Set(d, box.high[0] + grow));
        for (int axis = 0; axis < 3; ++axis) {
            if (axis > 0)
                near = hn::And(near, hn::Le(hn::LoadU(d, rows.low[axis].data() + k),
                                            hn::Set(d, box.high[axis] + grow)));
            near = hn::And(near, hn::Ge(hn::LoadU(d, rows.high[axis].data() + k),
                                        hn::Set(d, box.low[axis] - grow)));
        }
        const auto number = hn::Iota(di, static_cast<std::int32_t>(k));
        hn::StoreU(Compressed(di, number, hn::RebindMask(di, near)), di, out + found);
        found += hn::CountTrue(d, near);
    }
    return found;
}

void FindGroups(const SphereBlocks& spheres, const FloatBox& box, float grow,
                std::vector<std::int32_t>& out) {
    out.resize(spheres.groups.size() + 2 * kBlock);  // full vectors are stored behind the last
    std::size_t found = 0;
    std::int32_t clusters[2 * kBlock];
    // Two levels: a cluster is 16 groups; one test of 16 boxes rules out most groups.
    for (std::size_t k = 0; k < spheres.clusters.size(); k += kBlock) {
        const std::size_t near = TouchingBoxes(spheres.clusters, k, box, grow, clusters);
        for (std::size_t c = 0; c < near; ++c)
            found += TouchingBoxes(spheres.groups, kBlock * static_cast<std::size_t>(clusters[c]),
                                   box, grow, out.data() + found);
    }
    out.resize(found);
}

// The spheres picked so far: appends, and keeps the box around them.
class Picked {
public:
    Picked(const FloatBox& box, float grow, std::size_t most, NearSpheres& out)
        : box_(box), grow_(grow), out_(out) {
        const std::size_t room = most + kBlock;  // full vectors are stored behind the last
        if (out.id.size() >= room) return;
        for (auto* values :
             {&out.x, &out.y, &out.z, &out.normal_extent, &out.tangent_extent, &out.own})
            values->resize(room);
        out.id.resize(room);
    }

    // Spheres k, k + 1, ... of `from` as far as `valid`, which are at x, y, z.
    template <class Spheres>
    HWY_INLINE void Add(const Spheres& from, std::size_t k, Mask valid, Lanes x, Lanes y, Lanes z) {
        const Tag d;
        // Each sphere has a limit of its own: a common one would be that of the largest and let
        // most pass.
        const auto own = hn::LoadU(d, from.own.data() + k);
        const auto limit = hn::Add(hn::Set(d, grow_), own);
        const auto inside = [&](Lanes at, int axis) {
            return hn::And(hn::Ge(at, hn::Sub(hn::Set(d, box_.low[axis]), limit)),
                           hn::Le(at, hn::Add(hn::Set(d, box_.high[axis]), limit)));
        };
        const Mask picked =
            hn::And(hn::And(valid, inside(x, 0)), hn::And(inside(y, 1), inside(z, 2)));
        if (hn::AllFalse(d, picked)) return;
        Append(x, picked, out_.x.data() + count_);
        Append(y, picked, out_.y.data() + count_);
        Append(z, picked, out_.z.data() + count_);
        Append(hn::LoadU(d, from.normal_extent.data() + k), picked,
               out_.normal_extent.data() + count_);
        Append(hn::LoadU(d, from.tangent_extent.data() + k), picked,
               out_.tangent_extent.data() + count_);
        Append(own, picked, out_.own.data() + count_);
        Append(from.id.data() + k, picked, out_.id.data() + count_);
        count_ += hn::CountTrue(d, picked);
        // Bounds are kept per lane and joined once, in Finish(): least and largest need no order.
        low_x_ = hn::Min(low_x_, hn::IfThenElse(picked, x, low_x_));
        low_y_ = hn::Min(low_y_, hn::IfThenElse(picked, y, low_y_));
        low_z_ = hn::Min(low_z_, hn::IfThenElse(picked, z, low_z_));
        high_x_ = hn::Max(high_x_, hn::IfThenElse(picked, x, high_x_));
        high_y_ = hn::Max(high_y_, hn::IfThenElse(picked, y, high_y_));
        high_z_ = hn::Max(high_z_, hn::IfThenElse(picked, z, high_z_));
    }

    void Finish() {
        const Tag d;
        const auto least = [&](Lanes v) { return hn::GetLane(hn::MinOfLanes(d, v)); };
        const auto most = [&](Lanes v) { return hn::GetLane(hn::MaxOfLanes(d, v)); };
        out_.count = count_;
        out_.box = {{least(low_x_), least(low_y_), least(low_z_)},
                    {most(high_x_), most(high_y_), most(high_z_)}};
    }

private:
    FloatBox box_;
    float grow_;
    NearSpheres& out_;
    std::size_t count_ = 0;
    Lanes low_x_ = hn::Set(Tag(), kBeyondAll), low_y_ = low_x_, low_z_ = low_x_;
    Lanes high_x_ = hn::Set(Tag(), -kBeyondAll), high_y_ = high_x_, high_z_ = high_x_;
};

// Unlike sums, tests of single spheres may use as many lanes as there are: no bit depends on them.
void PickMoved(const SphereBlocks& spheres, const std::vector<std::int32_t>& groups,
               const FloatPose& pose, const FloatBox& box, float grow, NearSpheres& out) {
    const Tag d;
    Picked picked(box, grow, groups.size() * kBlock, out);
    for (const std::int32_t g : groups)
        for (std::size_t k = kBlock * static_cast<std::size_t>(g);
             k < kBlock * (static_cast<std::size_t>(g) + 1); k += hn::Lanes(d)) {
            const auto x = hn::LoadU(d, spheres.x.data() + k);
            const auto y = hn::LoadU(d, spheres.y.data() + k);
            const auto z = hn::LoadU(d, spheres.z.data() + k);
            // Mul then Add, not MulAdd: a fused product would differ from the reference
            const auto moved = [&](int axis) {
                const float* row = pose.rotation[axis];
                return hn::Add(
                    hn::Add(hn::Mul(hn::Set(d, row[0]), x), hn::Mul(hn::Set(d, row[1]), y)),
                    hn::Add(hn::Mul(hn::Set(d, row[2]), z), hn::Set(d, pose.translation[axis])));
            };
            picked.Add(spheres, k, hn::FirstN(d, kBlock), moved(0), moved(1), moved(2));
        }
    picked.Finish();
}

void PickNear(const NearSpheres& from, const FloatBox& box, float grow, NearSpheres& out) {
    const Tag d;
    Picked picked(box, grow, from.count, out);
    for (std::size_t k = 0; k < from.count; k += hn::Lanes(d))
        picked.Add(from, k, hn::FirstN(d, from.count - k), hn::LoadU(d, from.x.data() + k),
                   hn::LoadU(d, from.y.data() + k), hn::LoadU(d, from.z.data() + k));
    picked.Finish();
}

// Bytes of a stored mask: StoreMaskBits writes no more.
constexpr std::size_t kMaskBytes = (hn::MaxLanes(Tag()) + 7) / 8;

// Rows that are tested together [-]: each sphere of the many is loaded once for all of them. Four
// take 0.078 instead of 0.148 ns a test on AVX-512; the pairs are the same.
constexpr std::size_t kRowsAtOnce = 4;

// Tests rows f .. f + N - 1 against all of the many, a mask for every vector of these: the masks of
// a row follow each other. Has a row any partner?
template <std::size_t N>
HWY_INLINE void TestRows(const NearSpheres& few, std::size_t f, const NearSpheres& many,
                         const SearchRange& range, std::uint8_t* masks, std::size_t row_bytes,
                         bool* any) {
    const Tag d;
    const std::size_t lanes = hn::Lanes(d);
    const Mask all = hn::FirstN(d, lanes);
    Lanes x[N], y[N], z[N], along[N], across[N];
    Mask hits[N];
    for (std::size_t r = 0; r < N; ++r) {
        x[r] = hn::Set(d, few.x[f + r]);
        y[r] = hn::Set(d, few.y[f + r]);
        z[r] = hn::Set(d, few.z[f + r]);
        along[r] = hn::Set(d, few.normal_extent[f + r] + range.normal_extent);
        across[r] = hn::Set(d, few.tangent_extent[f + r] + range.tangent_extent);
        hits[r] = hn::FirstN(d, 0);
    }
    std::uint8_t* to = masks;
    for (std::size_t m = 0; m < many.count; m += lanes, to += kMaskBytes) {
        const Lanes mx = hn::LoadU(d, many.x.data() + m), my = hn::LoadU(d, many.y.data() + m);
        const Lanes mz = hn::LoadU(d, many.z.data() + m);
        const Lanes m_normal = hn::LoadU(d, many.normal_extent.data() + m);
        const Lanes m_tangent = hn::LoadU(d, many.tangent_extent.data() + m);
        Mask valid = all;
        if (many.count - m < lanes) valid = hn::FirstN(d, many.count - m);
        for (std::size_t r = 0; r < N; ++r) {
            const Lanes dx = hn::Sub(mx, x[r]), dy = hn::Sub(my, y[r]), dz = hn::Sub(mz, z[r]);
            const Lanes a = hn::Add(m_normal, along[r]), c = hn::Add(m_tangent, across[r]);
            const Lanes apart = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
            const Mask near = hn::And(hn::Le(apart, hn::Add(hn::Mul(a, a), hn::Mul(c, c))), valid);
            hits[r] = hn::Or(hits[r], near);
            hn::StoreMaskBits(d, near, to + r * row_bytes);
        }
    }
    // a row without partners is not decoded
    for (std::size_t r = 0; r < N; ++r) any[r] = !hn::AllFalse(d, hits[r]);
}

void FindNearPairs(const NearSpheres& few, std::size_t first, std::size_t last,
                   const NearSpheres& many, const SearchRange& range, NearPairs& out) {
    const Tag d;
    const std::size_t lanes = hn::Lanes(d), vectors = (many.count + lanes - 1) / lanes;
    // room for every pair: appending then needs no test
    const std::size_t room = (last - first) * many.count + kBlock;
    if (out.partner.size() < room) out.partner.resize(room);
    const std::size_t row_bytes = vectors * kMaskBytes;
    // eight bytes are read for a mask
    if (out.masks.size() < kRowsAtOnce * row_bytes + 8)
        out.masks.resize(kRowsAtOnce * row_bytes + 8);
    out.end.clear();
    std::size_t found = 0;
    for (std::size_t f = first; f < last;) {
        const std::size_t rows = last - f < kRowsAtOnce ? 1 : kRowsAtOnce;
        // four rows at a time, the last ones one by one
        bool any[kRowsAtOnce];
        rows == 1 ? TestRows<1>(few, f, many, range, out.masks.data(), row_bytes, any)
                  : TestRows<kRowsAtOnce>(few, f, many, range, out.masks.data(), row_bytes, any);
        for (std::size_t r = 0; r < rows; ++r) {
            // bits to ids, in the order of the many
            for (std::size_t v = 0; any[r] && v < vectors; ++v) {
                const Mask near =
                    hn::LoadMaskBits(d, out.masks.data() + r * row_bytes + v * kMaskBytes);
                if (hn::AllFalse(d, near)) continue;
                Append(many.id.data() + v * lanes, near, out.partner.data() + found);
                found += hn::CountTrue(d, near);
            }
            out.end.push_back(static_cast<std::int32_t>(found));
        }
        f += rows;
    }
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ice {
HWY_EXPORT(FindGroups);
HWY_EXPORT(PickMoved);
HWY_EXPORT(PickNear);
HWY_EXPORT(FindNearPairs);

void find_groups(const SphereBlocks& spheres, const FloatBox& box, float grow,
                 std::vector<std::int32_t>& out) {
    HWY_DYNAMIC_DISPATCH(FindGroups)(spheres, box, grow, out);
}

void pick_spheres(const SphereBlocks& spheres, const std::vector<std::int32_t>& groups,
                  const FloatPose& pose, const FloatBox& box, float grow, NearSpheres& out) {
    HWY_DYNAMIC_DISPATCH(PickMoved)(spheres, groups, pose, box, grow, out);
}

void pick_spheres(const NearSpheres& from, const FloatBox& box, float grow, NearSpheres& out) {
    HWY_DYNAMIC_DISPATCH(PickNear)(from, box, grow, out);
}

void find_near_pairs(const NearSpheres& few, std::size_t first, std::size_t last,
                     const NearSpheres& many, const SearchRange& range, NearPairs& out) {
    HWY_DYNAMIC_DISPATCH(FindNearPairs)(few, first, last, many, range, out);
}
}  // namespace ice
#endif
