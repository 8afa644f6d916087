// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/certify/shared_triangles.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/parallel.hpp"

namespace ice {

namespace {

using Key = std::array<std::int32_t, 3>;

Key sorted(Key key) {
    std::sort(key.begin(), key.end());
    return key;
}

}  // namespace

PlacedVertices::PlacedVertices(const TriangleMesh& mesh, double tolerance) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    // Twice the tolerance: places on both sides of a grid line are then missed only if they lie
    // near it. A triangle that is missed so is measured, which costs time and nothing else.
    if (tolerance > 0.0 && !box.isEmpty()) grid_ = 2.0 * tolerance * box.diagonal().norm();
    places_.resize(mesh.vertices.size());
    for (std::size_t v = 0; v < places_.size(); ++v)
        places_[v] = {key(mesh.vertices[v]), static_cast<std::int32_t>(v)};
    // Sorted places are found by bisection; of equal places the first vertex counts.
    std::sort(places_.begin(), places_.end());
}

std::array<double, 3> PlacedVertices::key(const Vec3& p) const {
    std::array<double, 3> out{};
    for (int d = 0; d < 3; ++d)
        // places rounded to a grid are equal within it; without a tolerance equal bits decide
        out[static_cast<std::size_t>(d)] =
            grid_ > 0.0 ? std::round(p[d] / grid_) : p[d] + 0.0;  // -0 is 0
    return out;
}

std::int32_t PlacedVertices::find(const Vec3& p) const {
    const auto wanted = key(p);
    const auto at = std::lower_bound(
        places_.begin(), places_.end(), wanted,
        [](const auto& place, const std::array<double, 3>& k) { return place.first < k; });
    return at != places_.end() && at->first == wanted ? at->second : -1;
}

std::vector<std::uint8_t> shared_triangles(const TriangleMesh& mesh, const TriangleMesh& other,
                                           const PlacedVertices& places) {
    const auto keys_of = [&](const TriangleMesh& m) {
        std::vector<std::int32_t> place(m.vertices.size());
        parallel_for(place.size(), 4096,
                     [&](std::size_t v) { place[v] = places.find(m.vertices[v]); });
        std::vector<Key> keys(m.triangles.size());
        for (std::size_t t = 0; t < keys.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k)
                keys[t][k] = place[static_cast<std::size_t>(m.triangles[t][k])];
        // Sorted corners: a repair may turn a triangle over or begin it at another corner.
        for (Key& key : keys) key = sorted(key);
        return keys;
    };
    std::vector<Key> known = keys_of(other);
    std::sort(known.begin(), known.end());
    const std::vector<Key> asked = keys_of(mesh);
    std::vector<std::uint8_t> shared(asked.size(), 0);
    parallel_for(asked.size(), 4096, [&](std::size_t t) {
        // A corner without a place has -1, which is first among the sorted ones.
        shared[t] = asked[t][0] >= 0 && std::binary_search(known.begin(), known.end(), asked[t]);
    });
    return shared;
}

}  // namespace ice
