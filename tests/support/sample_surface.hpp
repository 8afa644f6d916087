// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "preprocess/fill/surface_samples.hpp"

namespace ice::test {

/// All samples of a small mesh in 3D, about `size` [m] large, in triangle order.
inline std::vector<SurfaceSample> sample_surface(const TriangleMesh& mesh, double size) {
    const SurfaceSampler sampler(mesh, size, 3);
    std::vector<SurfaceSample> out, part;
    for (std::size_t t = 0; t < sampler.triangle_count(); ++t) {
        sampler.sample(t, part);
        out.insert(out.end(), part.begin(), part.end());
    }
    return out;
}

}  // namespace ice::test
