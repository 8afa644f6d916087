// SPDX-License-Identifier: GPL-3.0-or-later
// Tolerances: 1e-9 and 1e-12 are rounding of sums over the shares of thousands of spheres, the
// former with a reserve.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "common/formats/sphere_set.hpp"
#include "tests/support/tolerance.hpp"

namespace ice::test {

/// Areas and volumes sum to the solid's and first moments to its centroid, and none is negative.
inline void check_shares(const SphereSet& set) {
    const double volume = std::accumulate(set.volumes.begin(), set.volumes.end(), 0.0);
    const double area = std::accumulate(set.areas.begin(), set.areas.end(), 0.0);
    Vec3 first = Vec3::Zero();
    for (std::size_t k = 0; k < set.size(); ++k) {
        REQUIRE(set.volumes[k] > 0.0);
        REQUIRE(set.area(k) >= 0.0);
        first += set.volumes[k] * set.centers[k];
    }
    Vec3 centroid = set.solid.centroid;
    if (set.dimension == 2) centroid.y() = 0.0;
    CHECK(volume == Near(set.solid.volume).epsilon(1e-12));
    CHECK(area == Near(set.solid.area).epsilon(1e-9));
    const double size = std::cbrt(set.solid.volume);
    CHECK((first / volume - centroid).norm() < tolerance(1e-9) * (centroid.norm() + size));
}

}  // namespace ice::test
