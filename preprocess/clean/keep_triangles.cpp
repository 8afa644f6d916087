// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/keep_triangles.hpp"

namespace ice {

void keep_triangles(TriangleMesh& mesh, const std::vector<std::uint8_t>& keep) {
    TriangleMesh out;
    out.region_names = mesh.region_names;
    // In the order of first use: the result depends on the kept triangles alone.
    std::vector<std::int32_t> renumbered(mesh.vertices.size(), -1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!keep[t]) continue;
        std::array<std::int32_t, 3> corner = mesh.triangles[t];
        for (std::int32_t& v : corner) {
            std::int32_t& index = renumbered[static_cast<std::size_t>(v)];
            if (index < 0) {
                index = static_cast<std::int32_t>(out.vertices.size());
                out.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
            }
            v = index;
        }
        out.triangles.push_back(corner);
        out.region.push_back(mesh.region[t]);
    }
    mesh = std::move(out);
}

}  // namespace ice
