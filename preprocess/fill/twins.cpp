// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/twins.hpp"

#include <numeric>

#include "preprocess/fill/point_cells.hpp"

namespace ice {

std::vector<std::int32_t> find_twins(const SphereSet& set) {
    const auto spheres = std::span(set.centers).first(set.surface_count);
    std::vector<std::int32_t> twin(spheres.size());
    std::iota(twin.begin(), twin.end(), 0);
    std::vector<std::size_t> apart;
    const auto image = [&](std::size_t k) {
        return Vec3(spheres[k].x(), -spheres[k].y(), spheres[k].z());
    };
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        if (spheres[k].y() <= 0.0) continue;
        // a conforming layer has them side by side
        if (k + 1 < spheres.size() && spheres[k + 1] == image(k)) {
            twin[k] = static_cast<std::int32_t>(k + 1);
            twin[k + 1] = static_cast<std::int32_t>(k);
        } else {
            apart.push_back(k);
        }
    }
    if (apart.empty()) return twin;
    // a lattice's twins are rows apart: each image is searched
    const PointCells cells(spheres, set.spacing);
    for (const std::size_t k : apart) {
        const auto near = cells.nearest(image(k));
        if (near.distance > 0.0) continue;
        twin[k] = near.index;
        twin[static_cast<std::size_t>(near.index)] = static_cast<std::int32_t>(k);
    }
    return twin;
}

}  // namespace ice
