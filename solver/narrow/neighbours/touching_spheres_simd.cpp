// SPDX-License-Identifier: GPL-3.0-or-later
// As many pairs at a time as the machine has lanes, compiled once per instruction set. The
// mathematics is in touching_spheres_reference.cpp.
#include "solver/narrow/neighbours/touching_spheres.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/narrow/neighbours/touching_spheres_simd.cpp"
#include <hwy/foreach_target.h>  // must precede highway.h
#include <hwy/highway.h>

#include "solver/narrow/neighbours/compress_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, ListedSpheres::kPairs>;
using IdTag = hn::RebindToSigned<Tag>;

// Whole units as floats.
HWY_INLINE hn::Vec<Tag> Get(const std::int16_t* units) {
    const hn::Rebind<std::int16_t, Tag> d;
    return hn::ConvertTo(Tag(), hn::PromoteTo(IdTag(), hn::Load(d, units)));
}

void FindTouching(std::span<const ListedSpheres> listed, const FloatPose& pose, float most,
                  TouchingSpheres& out) {
    const Tag d;
    const IdTag di;
    // full vectors are stored behind the last
    const std::size_t room = (listed.size() + 1) * ListedSpheres::kPairs;
    if (out.a.size() < room) out.a.resize(room);
    if (out.b.size() < room) out.b.resize(room);
    auto least = hn::Set(d, ListedSpheres::kNowhere);
    std::size_t found = 0;
    for (const ListedSpheres& s : listed)
        for (std::size_t k = 0; k < ListedSpheres::kPairs; k += hn::Lanes(d)) {
            const auto x = Get(s.bx + k), y = Get(s.by + k), z = Get(s.bz + k);
            // Mul then Add, not MulAdd: a fused product would differ from the reference
            const auto apart = [&](int axis, const std::int16_t* a) HWY_ATTR {
                const float* row = pose.rotation[axis];
                const auto moved = hn::Add(
                    hn::Add(hn::Mul(hn::Set(d, row[0]), x), hn::Mul(hn::Set(d, row[1]), y)),
                    hn::Add(hn::Mul(hn::Set(d, row[2]), z), hn::Set(d, pose.translation[axis])));
                return hn::Sub(moved, Get(a + k));
            };
            const auto dx = apart(0, s.ax), dy = apart(1, s.ay), dz = apart(2, s.az);
            const auto square = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
            const auto gap = hn::Sub(hn::Sqrt(square), Get(s.radii + k));
            least = hn::Min(least, gap);
            const auto touch = hn::Le(gap, hn::Set(d, most));
            if (hn::AllFalse(d, touch)) continue;
            // not CompressStore(), which is slow on AMD's AVX-512
            const auto ids = hn::RebindMask(di, touch);
            hn::StoreU(Compressed(di, hn::Load(di, s.a + k), ids), di, out.a.data() + found);
            hn::StoreU(Compressed(di, hn::Load(di, s.b + k), ids), di, out.b.data() + found);
            found += hn::CountTrue(d, touch);
        }
    out.count = found;
    out.least = hn::GetLane(hn::MinOfLanes(d, least));
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ice {
HWY_EXPORT(FindTouching);

void find_touching(std::span<const ListedSpheres> listed, const FloatPose& pose, float most,
                   TouchingSpheres& out) {
    HWY_DYNAMIC_DISPATCH(FindTouching)(listed, pose, most, out);
}
}  // namespace ice
#endif
