// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/mirror_shares.hpp"

#include <array>
#include <cmath>
#include <map>

namespace ice {

void mirror_shares(SphereSet& set) {
    std::map<std::array<double, 3>, std::size_t> port;
    for (std::size_t k = 0; k < set.size(); ++k) {
        const Vec3& c = set.centers[k];
        if (c.y() > 0.0) port[{c.x(), c.y(), c.z()}] = k;
        if (c.y() != 0.0 || set.layers[k] == 0) continue;
        Vec3 flat = set.normals[k];
        flat.y() = 0.0;
        // a part exactly as broad as the sphere touches on both sides: its normal points across
        if (flat.norm() > 1e-3) set.normals[k] = flat.normalized();
    }
    for (std::size_t k = 0; k < set.size(); ++k) {
        const Vec3& c = set.centers[k];
        if (c.y() >= 0.0) continue;
        const auto image = port.find({c.x(), -c.y(), c.z()});
        if (image == port.end()) continue;
        const std::size_t p = image->second;
        set.areas[k] = set.areas[p] = 0.5 * (set.areas[k] + set.areas[p]);
        set.volumes[k] = set.volumes[p] = 0.5 * (set.volumes[k] + set.volumes[p]);
        set.normals[k] = Vec3(set.normals[p].x(), -set.normals[p].y(), set.normals[p].z());
        set.normal_spread[k] = set.normal_spread[p];
    }
}

}  // namespace ice
