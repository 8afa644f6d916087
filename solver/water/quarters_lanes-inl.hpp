// SPDX-License-Identifier: GPL-3.0-or-later
// The quarters of a triangle over the water for as many bodies of one shape as the machine has
// lanes, with the bits of cut_triangle.hpp.
#if defined(ICE_WATER_QUARTERS_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_WATER_QUARTERS_LANES_INL
#undef ICE_WATER_QUARTERS_LANES_INL
#else
#define ICE_WATER_QUARTERS_LANES_INL
#endif

#include <hwy/highway.h>

#include "solver/water/floating_lanes-inl.hpp"
#include "solver/water/six_points.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

// A triangle's six points [m], their heights over the water [m], and the area [m2] of each quarter
// along the outward normal.
struct Quarters {
    SixPoints points;
    Vectors p[6], area;
    Lanes z[6];

    HWY_INLINE Quarters(const Shape& shape, const Water& water, std::size_t triangle)
        : points(shape, triangle),
          area(Scale(hn::Set(Tag(), 0.25),
                     SetOf(shape.facets.blocks[triangle / kLanes].area, triangle % kLanes))) {
        for (std::size_t k = 0; k < 6; ++k) {
            p[k] = Set(points.at[k]);
            z[k] = water.HeightOf(p[k]);
        }
    }
    // Without a wet corner of any body the triangle is dry.
    HWY_INLINE bool AnyCornerWet() const {
        return !hn::AllFalse(Tag(), CutByWater({z[0], z[1], z[2]}).AnyInside());
    }
    HWY_INLINE Cut CutOf(const Quarter& q) const { return CutByWater({z[q[0]], z[q[1]], z[q[2]]}); }
};

// Of values at the six points those at a quarter's corners.
template <class T>
HWY_INLINE void Pick(const T (&of)[6], const Quarter& quarter, T (&out)[3]) {
    for (std::size_t k = 0; k < 3; ++k) out[k] = of[quarter[k]];
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
