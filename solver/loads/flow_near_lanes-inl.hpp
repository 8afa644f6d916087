// SPDX-License-Identifier: GPL-3.0-or-later
// The hull's flow at the places of floes of one shape, in lanes as in afloat_lanes-inl.hpp.
#if defined(ICE_FLOW_NEAR_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_FLOW_NEAR_LANES_INL
#undef ICE_FLOW_NEAR_LANES_INL
#else
#define ICE_FLOW_NEAR_LANES_INL
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "solver/flow/look_up_lanes-inl.hpp"
#include "solver/loads/afloat_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

// The table's flow at places, for a ship at 1 m/s. @pre water.flows()
HWY_INLINE Vectors TableFlowAt(const WaterFlow& water, Vectors x) {
    const Tag d;
    HWY_ALIGN double at[3][kMostLanes], flow[3][kMostLanes];
    hn::Store(hn::Sub(x.x, All(water.ship.x())), d, at[0]);
    hn::Store(hn::Sub(x.y, All(water.ship.y())), d, at[1]);
    hn::Store(x.z, d, at[2]);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k) {
        double value[FlowGrid::kNumbers];
        LookUp(water.grid, at[0][k], at[1][k], at[2][k], value);
        for (int axis = 0; axis < 3; ++axis) flow[axis][k] = value[axis];
    }
    return {hn::Load(d, flow[0]), hn::Load(d, flow[1]), hn::Load(d, flow[2])};
}

// reference::water_at(), from what the table has there. @pre water.flows()
HWY_INLINE Vectors WaterOf(const WaterFlow& water, Vectors flow) {
    return Add(Set(water.current), Scale(All(water.speed), flow));
}
HWY_INLINE Vectors WaterAt(const WaterFlow& water, Vectors x) {
    return WaterOf(water, TableFlowAt(water, x));
}

// The table's values at a shape's vertices and, numbered behind them, at the middles of its edges:
// drag and pressure need each several times. Values beyond the buffer are looked up each time.
class FlowNear {
public:
    HWY_INLINE FlowNear(const Afloat& floes, const WaterFlow& water)
        : floes_(floes),
          water_(water),
          vertices_(floes.shape.mesh.vertices.size()),
          known_(std::min(kFew, vertices_ + floes.shape.edges.middle.size())) {
        for (std::size_t k = 0; k < known_; ++k) flow_[k] = LookedUp(k);
    }
    HWY_INLINE Vectors At(std::size_t k) const { return k < known_ ? flow_[k] : LookedUp(k); }
    HWY_INLINE Vec3 Point(std::size_t k) const {
        const Shape& shape = floes_.shape;
        return k < vertices_ ? shape.mesh.vertices[k] : shape.edges.middle[k - vertices_];
    }

private:
    // Places that are kept [-], those of some 60 triangles. More take stack of every call; fewer
    // look up known values again. The bits are the same.
    static constexpr std::size_t kFew = 128;

    HWY_INLINE Vectors LookedUp(std::size_t k) const {
        return TableFlowAt(water_, Add(floes_.position, Product(floes_.rotation, Set(Point(k)))));
    }

    const Afloat& floes_;
    const WaterFlow& water_;
    std::size_t vertices_, known_;
    Vectors flow_[kFew];
};

// The floes around which the ship may move the water.
HWY_INLINE Mask InFlow(const WaterFlow& water, const Afloat& floes) {
    const Tag d;
    if (!water.flows()) return hn::FirstN(d, 0);
    HWY_ALIGN double at[3][kMostLanes], in[kMostLanes];
    hn::Store(floes.position.x, d, at[0]);
    hn::Store(floes.position.y, d, at[1]);
    hn::Store(floes.position.z, d, at[2]);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k)
        in[k] = water.reaches(Vec3(at[0][k], at[1][k], at[2][k]), floes.shape.bounding_radius)
                    ? 1.0
                    : 0.0;
    return hn::Gt(hn::Load(d, in), hn::Zero(d));
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
