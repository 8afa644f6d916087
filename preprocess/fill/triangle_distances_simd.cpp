// SPDX-License-Identifier: GPL-3.0-or-later
// measure_distances for as many points at a time as the machine has lanes, compiled once per
// instruction set. The mathematics is in triangle_distances_reference.cpp.
#include "preprocess/fill/triangle_distances.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "preprocess/fill/triangle_distances_simd.cpp"
#include <hwy/foreach_target.h>  // must precede highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, PointBatch::kPadding>;
using Lanes = hn::Vec<Tag>;

// Mul then Add, not MulAdd: a fused product would differ from the reference
HWY_INLINE Lanes Dot(Lanes ax, Lanes ay, Lanes az, Lanes bx, Lanes by, Lanes bz) {
    return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
}

void MeasureDistances(const TriangleSides& t, const PointBatch& points, double* out) {
    const Tag d;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0);
    for (std::size_t k = 0; k < points.count; k += hn::Lanes(d)) {
        const auto px = hn::LoadU(d, points.x.data() + k);
        const auto py = hn::LoadU(d, points.y.data() + k);
        const auto pz = hn::LoadU(d, points.z.data() + k);
        // A point whose foot lies inside all three edges is nearest to the face, else to the rim:
        // both distances are computed and selected by lane, in the reference's order of operations.
        auto least = zero, rim = zero, height = zero;
        for (std::size_t e = 0; e < 3; ++e) {
            const Vec3 &from = t.corner[e], &edge = t.edge[e], &in = t.inward[e];
            const auto x = hn::Sub(px, hn::Set(d, from.x()));
            const auto y = hn::Sub(py, hn::Set(d, from.y()));
            const auto z = hn::Sub(pz, hn::Set(d, from.z()));
            const auto ex = hn::Set(d, edge.x()), ey = hn::Set(d, edge.y()),
                       ez = hn::Set(d, edge.z());
            const auto over =
                Dot(hn::Set(d, in.x()), hn::Set(d, in.y()), hn::Set(d, in.z()), x, y, z);
            const auto along = hn::Mul(Dot(ex, ey, ez, x, y, z), hn::Set(d, t.per_edge_sq[e]));
            const auto part = hn::Min(hn::Max(along, zero), one);
            const auto dx = hn::Sub(x, hn::Mul(part, ex));
            const auto dy = hn::Sub(y, hn::Mul(part, ey));
            const auto dz = hn::Sub(z, hn::Mul(part, ez));
            const auto square = Dot(dx, dy, dz, dx, dy, dz);
            if (e == 0)
                height = Dot(hn::Set(d, t.normal.x()), hn::Set(d, t.normal.y()),
                             hn::Set(d, t.normal.z()), x, y, z);
            least = e == 0 ? over : hn::Min(least, over);
            rim = e == 0 ? square : hn::Min(rim, square);
        }
        // both answers cost less than a branch: neighbouring points fall on both sides
        const auto face = hn::Mul(hn::Mul(height, height), hn::Set(d, t.per_area_sq));
        hn::StoreU(hn::IfThenElse(hn::Ge(least, zero), face, rim), d, out + k);
    }
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ice {
HWY_EXPORT(MeasureDistances);

void measure_distances(const TriangleSides& triangle, const PointBatch& points, double* out) {
    HWY_DYNAMIC_DISPATCH(MeasureDistances)(triangle, points, out);
}
}  // namespace ice
#endif
