// SPDX-License-Identifier: GPL-3.0-or-later
// The flow of source panels, with points in lanes, compiled once per instruction set. The
// mathematics is in panel_sums_reference.cpp and own_functions.hpp. Mul then Add, not MulAdd: a
// fused product would differ from them.
#include "solver/flow/panel_sums.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/flow/panel_sums_simd.cpp"
#include <hwy/foreach_target.h>  // must precede highway.h
#include <hwy/highway.h>

#include "common/math/vector_lanes-inl.hpp"
#include "solver/flow/own_functions.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

HWY_INLINE Lanes All(double value) { return hn::Set(Tag(), value); }

HWY_INLINE Lanes AtanhSeries(Lanes square) {
    Lanes sum = All(1.0 / (2 * own::kTerms - 1));
    for (int k = own::kTerms - 2; k >= 0; --k)
        sum = hn::Add(hn::Mul(sum, square), All(1.0 / (2 * k + 1)));
    return sum;
}

// own::log()
HWY_INLINE Lanes Log(Lanes x) {
    const Tag d;
    const hn::RebindToUnsigned<Tag> u;
    const auto bits = hn::BitCast(u, x);
    const auto shifted = hn::Or(hn::ShiftRight<52>(bits), hn::Set(u, own::kTwo52));
    const Lanes whole = hn::Sub(hn::BitCast(d, shifted), All(own::kTwo52AndBias));
    const auto in_one_to_two =
        hn::Or(hn::And(bits, hn::Set(u, own::kMantissa)), hn::Set(u, own::kOne));
    const Lanes full = hn::BitCast(d, in_one_to_two);
    // x = 2^e m with m between sqrt(1/2) and sqrt(2), where the series of log m = 2 atanh((m - 1) /
    // (m + 1)) converges fastest. Own series, because a library's last bit differs between systems.
    const Mask large = hn::Gt(full, All(own::kSqrt2));
    const Lanes m = hn::IfThenElse(large, hn::Mul(All(0.5), full), full);
    const Lanes exponent = hn::IfThenElse(large, hn::Add(whole, All(1.0)), whole);
    const Lanes t = hn::Div(hn::Sub(m, All(1.0)), hn::Add(m, All(1.0)));
    return hn::Add(hn::Mul(exponent, All(own::kLn2)),
                   hn::Mul(hn::Mul(All(2.0), t), AtanhSeries(hn::Mul(t, t))));
}

// own::quarter_angle(): all three bounds are tested and the part's numbers chosen, with no branch.
HWY_INLINE Lanes QuarterAngle(Lanes y, Lanes x) {
    const Mask first = hn::Gt(y, hn::Mul(All(own::kBound[0]), x)), second = hn::Gt(y, x),
               third = hn::Gt(y, hn::Mul(All(own::kBound[2]), x));
    const auto pick = [&](const std::array<double, 4>& of) HWY_ATTR {
        const Lanes high = hn::IfThenElse(third, All(of[3]), All(of[2]));
        return hn::IfThenElse(second, high, hn::IfThenElse(first, All(of[1]), All(of[0])));
    };
    const Lanes c = pick(own::kCos), s = pick(own::kSin);
    const Lanes up = hn::Sub(hn::Mul(y, c), hn::Mul(x, s));
    const Lanes down = hn::Add(hn::Mul(x, c), hn::Mul(y, s));
    const Lanes t = hn::Div(up, hn::Max(down, All(own::kLeast)));
    return hn::Add(pick(own::kMiddle), hn::Mul(t, AtanhSeries(hn::Neg(hn::Mul(t, t)))));
}

// own::half_plane_angle()
HWY_INLINE Lanes HalfPlaneAngle(Lanes y, Lanes x) {
    const Lanes r = hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
    const Mask ahead = hn::Ge(x, hn::Zero(Tag()));
    return hn::Mul(All(2.0), QuarterAngle(hn::IfThenElse(ahead, y, hn::Sub(r, x)),
                                          hn::IfThenElse(ahead, hn::Add(r, x), y)));
}

struct Flow {
    Vectors v;
    Lanes phi;
};
HWY_INLINE Flow Sum(const Flow& a, const Flow& b) { return {Add(a.v, b.v), hn::Add(a.phi, b.phi)}; }

HWY_INLINE Flow NearFlow(const SourcePanel& p, Vectors at) {
    // as near_flow() of the reference, in its order of operations
    Vectors a[3];
    Lanes r[3];
    for (std::size_t k = 0; k < 3; ++k) {
        a[k] = Sub(Set(p.corner[k]), at);
        r[k] = hn::Sqrt(Dot(a[k], a[k]));
    }
    Flow out{Zero(), hn::Zero(Tag())};
    for (std::size_t k = 0; k < 3; ++k) {
        const Lanes sum = hn::Add(r[k], r[(k + 1) % 3]), l = All(p.length[k]);
        // L_k of (22). On the edge itself r_k + r_k+1 = l_k and L_k is infinite: the bound keeps it
        // a number.
        const Lanes gap = hn::Max(hn::Sub(sum, l), All(kLeastGap * p.length[k]));
        const Lanes log = Log(hn::Div(hn::Add(sum, l), gap));
        const Vectors outward = Set(p.outward[k]);
        out.v = Add(out.v, Scale(log, outward));
        out.phi = hn::Sub(out.phi, hn::Mul(log, Dot(outward, a[k])));
    }
    const Vectors normal = Set(p.normal);
    const Lanes height = Dot(normal, a[0]);
    const Lanes up = hn::Mul(All(2.0 * p.area), height);
    const Lanes down =
        hn::Add(hn::Add(hn::Mul(hn::Mul(r[0], r[1]), r[2]), hn::Mul(Dot(a[0], a[1]), r[2])),
                hn::Add(hn::Mul(Dot(a[1], a[2]), r[0]), hn::Mul(Dot(a[2], a[0]), r[1])));
    // Omega of (22): its sign is that of -h, h the height of the face over the point.
    const Lanes size = hn::Mul(All(2.0), HalfPlaneAngle(hn::Abs(up), down));
    const Lanes angle = hn::IfThenElse(hn::Gt(height, hn::Zero(Tag())), hn::Neg(size), size);
    out.v = Add(out.v, Scale(angle, normal));
    out.phi = hn::Sub(out.phi, hn::Mul(angle, height));
    return out;
}

// A panel of strength 1 at as many points as there are lanes: points beside each other in space are
// mostly all far from it, or all near.
HWY_INLINE Flow UnitFlow(const SourcePanel& p, Vectors at) {
    const Tag d;
    const Vectors off = Sub(at, Set(p.centre));
    const Lanes square = Dot(off, off);
    const Mask far = hn::Gt(square, All(p.far_squared));
    const Lanes phi = hn::Div(All(p.area), hn::Sqrt(square));
    const Flow point{Scale(hn::Div(phi, square), off), hn::Neg(phi)};
    // most pairs of panel and point are far apart: the face's sums are left out where all lanes
    // are
    if (hn::AllTrue(d, far)) return point;
    const Flow face = NearFlow(p, at);
    return {Choose(far, point.v, face.v), hn::IfThenElse(far, point.phi, face.phi)};
}

HWY_INLINE Flow WithImageBelow(const PanelBody& body, const SourcePanel& p, Vectors at) {
    const Flow own = UnitFlow(p, at), image = UnitFlow(p, {at.x, at.y, hn::Neg(at.z)});
    // The image in z = 0 has the panel's sign for a flat surface (phi_z = 0), the opposite one for
    // phi = 0. Its flow is that of the panel at the mirrored point, mirrored back.
    const Lanes s = All(body.image);
    return Sum(own, {{hn::Mul(s, image.v.x), hn::Mul(s, image.v.y), hn::Neg(hn::Mul(s, image.v.z))},
                     hn::Mul(s, image.phi)});
}

// Half a symmetric hull and its image in y = 0: a quarter of the entries of the whole one's matrix.
HWY_INLINE Flow ImagedFlow(const PanelBody& body, const SourcePanel& p, Vectors at) {
    const Flow here = WithImageBelow(body, p, at);
    if (!body.symmetric) return here;
    const Flow there = WithImageBelow(body, p, {at.x, hn::Neg(at.y), at.z});
    return Sum(here, {{there.v.x, hn::Neg(there.v.y), there.v.z}, there.phi});
}

void SumPanels(const PanelBody& body, std::span<const double> strength,
               std::span<const Vec3> points, std::span<FlowSample> out) {
    const Tag d;
    const std::size_t lanes = hn::Lanes(d);
    for (std::size_t first = 0; first < points.size(); first += lanes) {
        HWY_ALIGN double place[3][kMostLanes], value[4][kMostLanes];
        const std::size_t count = std::min(lanes, points.size() - first);
        for (std::size_t k = 0; k < lanes; ++k)  // those beyond the last are the last once more
            for (int axis = 0; axis < 3; ++axis)
                place[axis][k] = points[first + std::min(k, count - 1)][axis];
        const Vectors at{hn::Load(d, place[0]), hn::Load(d, place[1]), hn::Load(d, place[2])};
        Flow sum{Zero(), hn::Zero(d)};
        for (std::size_t j = 0; j < body.panels.size(); ++j) {
            const Flow f = ImagedFlow(body, body.panels[j], at);
            const Lanes s = All(strength[j]);
            sum = Sum(sum, {Scale(s, f.v), hn::Mul(s, f.phi)});
        }
        const Lanes parts[4] = {sum.v.x, sum.v.y, sum.v.z, sum.phi};
        for (int n = 0; n < 4; ++n) hn::Store(hn::Mul(All(kPerSphere), parts[n]), d, value[n]);
        for (std::size_t k = 0; k < count; ++k) {
            out[first + k].velocity = Vec3(value[0][k], value[1][k], value[2][k]);
            out[first + k].potential = value[3][k];
        }
    }
}

void MeanFluxes(const PanelBody& body, const FluxTargets& t, std::span<double> out) {
    const Tag d;
    constexpr std::size_t n = FluxTargets::kCount;
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
        Vectors at[3];
        for (std::size_t q = 0; q < 3; ++q)
            at[q] = {hn::LoadU(d, t.x[q] + i), hn::LoadU(d, t.y[q] + i), hn::LoadU(d, t.z[q] + i)};
        const Vectors normal{hn::LoadU(d, t.nx + i), hn::LoadU(d, t.ny + i),
                             hn::LoadU(d, t.nz + i)};
        for (std::size_t j = 0; j < body.panels.size(); ++j) {
            Lanes sum = hn::Zero(d);
            for (std::size_t q = 0; q < 3; ++q)
                sum = hn::Add(sum, Dot(ImagedFlow(body, body.panels[j], at[q]).v, normal));
            hn::StoreU(hn::Mul(All(kPerSphere / 3.0), sum), d, out.data() + n * j + i);
        }
    }
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ice {
HWY_EXPORT(SumPanels);
HWY_EXPORT(MeanFluxes);

void sum_panels(const PanelBody& body, std::span<const double> strength,
                std::span<const Vec3> points, std::span<FlowSample> out) {
    HWY_DYNAMIC_DISPATCH(SumPanels)(body, strength, points, out);
}

void mean_fluxes(const PanelBody& body, const FluxTargets& targets, std::span<double> out) {
    HWY_DYNAMIC_DISPATCH(MeanFluxes)(body, targets, out);
}
}  // namespace ice
#endif
