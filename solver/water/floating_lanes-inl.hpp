// SPDX-License-Identifier: GPL-3.0-or-later
// The water's sums over one form for as many bodies as the machine has lanes, with the bits of
// wetted_sums_reference.cpp: that sums eight facets beside each other, then over the eight.
#if defined(ICE_WATER_FLOATING_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_WATER_FLOATING_LANES_INL
#undef ICE_WATER_FLOATING_LANES_INL
#else
#define ICE_WATER_FLOATING_LANES_INL
#endif

#include <hwy/highway.h>

#include "solver/shape/shape.hpp"
#include "solver/water/facing_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

// One vector of a block for all bodies.
HWY_INLINE Vectors SetOf(const double (&from)[3][kLanes], std::size_t lane) {
    const Tag d;
    return {hn::Set(d, from[0][lane]), hn::Set(d, from[1][lane]), hn::Set(d, from[2][lane])};
}
HWY_INLINE Corners CornersOf(const FacetBlock& block, std::size_t lane) {
    return {SetOf(block.corner[0], lane), SetOf(block.corner[1], lane),
            SetOf(block.corner[2], lane)};
}

// Blocks that have a facet in this lane.
HWY_INLINE std::size_t BlocksWith(const FacetBlocks& facets, std::size_t lane) {
    return (facets.size() + kLanes - 1 - lane) / kLanes;
}

// Heights of a form's corners above the water. Triangles share theirs: where a form has few, each
// is computed once.
class FormHeights {
public:
    HWY_INLINE FormHeights(const Shape& form, const Water& water) : form_(form), water_(water) {
        const std::vector<Vec3>& vertices = form.mesh.vertices;
        few_ = vertices.size() <= kFew;
        for (std::size_t k = 0; few_ && k < vertices.size(); ++k)
            height_[k] = water.HeightOf(Set(vertices[k]));
    }
    HWY_INLINE Heights Of(std::size_t block, std::size_t lane) const {
        if (!few_) return HeightsOf(CornersOf(form_.facets.blocks[block], lane), water_);
        const auto& corner = form_.mesh.triangles[kLanes * block + lane];
        const auto at = [&](std::size_t k) { return static_cast<std::size_t>(corner[k]); };
        return {height_[at(0)], height_[at(1)], height_[at(2)]};
    }
    HWY_INLINE Vectors Up() const { return water_.up; }
    HWY_INLINE const FacetBlocks& Facets() const { return form_.facets; }

private:
    // Vertices up to which heights are kept [-]. More take stack of every call, fewer compute
    // shared corners again. The bits are the same.
    static constexpr std::size_t kFew = 64;

    const Shape& form_;
    Water water_;
    bool few_;
    Lanes height_[kFew];
};

// A number for each lane of the blocks, of each body.
struct Parts {
    Lanes s[kLanes];

    HWY_INLINE Lanes Over(double divisor) const {
        const Lanes low = hn::Add(hn::Add(s[0], s[1]), hn::Add(s[2], s[3]));
        const Lanes high = hn::Add(hn::Add(s[4], s[5]), hn::Add(s[6], s[7]));
        return hn::Div(hn::Add(low, high), hn::Set(Tag(), divisor));
    }
};
struct VectorParts {
    Parts x, y, z;

    HWY_INLINE void Put(Vectors v, std::size_t lane) {
        x.s[lane] = v.x;
        y.s[lane] = v.y;
        z.s[lane] = v.z;
    }
    HWY_INLINE Vectors Over(double divisor) const {
        return {x.Over(divisor), y.Over(divisor), z.Over(divisor)};
    }
};

// WettedIntegrals of each body.
struct FloatingWetted {
    Lanes volume;
    Vectors first;
    Mask any_wet, any_dry;
};
HWY_INLINE FloatingWetted IntegrateFloating(const FormHeights& heights) {
    const Tag d;
    const FacetBlocks& facets = heights.Facets();
    Parts volume;
    VectorParts first;
    FloatingWetted out;
    out.any_wet = out.any_dry = hn::FirstN(d, 0);
    // facets of one lane of the blocks first, then the lanes: the reference's order of sums
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        Wetted sum;
        for (std::size_t k = 0; k < BlocksWith(facets, lane); ++k) {
            const FacetBlock& block = facets.blocks[k];
            const Cut h = CutByWater(heights.Of(k, lane));
            out.any_wet = hn::Or(out.any_wet, h.AnyInside());
            out.any_dry = hn::Or(out.any_dry, hn::Not(h.AllInside()));
            if (hn::AllFalse(d, h.AnyInside())) continue;
            sum.Add(h, CornersOf(block, lane), Dot(heights.Up(), SetOf(block.area, lane)));
        }
        volume.s[lane] = sum.volume;
        first.Put(sum.first, lane);
    }
    out.volume = volume.Over(3.0);
    out.first = first.Over(12.0);
    return out;
}

// FacingIntegrals of each body in a flow v + w x p, body axes.
HWY_INLINE Facing IntegrateFloatingFacing(const FormHeights& heights, Vectors v, Vectors w) {
    const Tag d;
    const FacetBlocks& facets = heights.Facets();
    Parts flow;
    VectorParts first, square, mixed;
    // the order of sums of IntegrateFloating()
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        Facing sum;
        for (std::size_t k = 0; k < BlocksWith(facets, lane); ++k) {
            const FacetBlock& block = facets.blocks[k];
            const Cut h = CutByWater(heights.Of(k, lane));
            if (hn::AllFalse(d, h.AnyInside())) continue;
            AddWetted(h, Triangles(CornersOf(block, lane), SetOf(block.area, lane), v, w), sum);
        }
        flow.s[lane] = sum.flow;
        first.Put(sum.first, lane);
        square.Put(sum.square, lane);
        mixed.Put(sum.mixed, lane);
    }
    Facing out;
    out.flow = flow.Over(3.0);
    out.first = first.Over(12.0);
    out.square = square.Over(60.0);
    out.mixed = mixed.Over(60.0);
    return out;
}

// int f dA of each body in an even flow.
HWY_INLINE Lanes IntegrateFloatingFacing(const FormHeights& heights, Vectors v) {
    const Tag d;
    const FacetBlocks& facets = heights.Facets();
    Parts flow;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        flow.s[lane] = hn::Zero(d);
        for (std::size_t k = 0; k < BlocksWith(facets, lane); ++k) {
            const FacetBlock& block = facets.blocks[k];
            const Lanes facing = Dot(SetOf(block.area, lane), v);
            const Mask away = hn::Le(facing, hn::Zero(d));
            if (hn::AllTrue(d, away)) continue;
            const Lanes wetted = hn::Mul(facing, WettedShare(heights.Of(k, lane)));
            flow.s[lane] = hn::Add(flow.s[lane], hn::IfThenZeroElse(away, wetted));
        }
    }
    return flow.Over(1.0);
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
