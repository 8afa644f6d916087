// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace ice::detail {

/// Name and version of the format: a reader refuses other ones.
constexpr const char* kFieldFormat = "icesolve-field";
constexpr std::int64_t kFieldVersion = 1;

/// The arrays of all shapes of a field one after the other, as in its file: rows of
/// docs/contract.md, section 7, lengths in m. Three numbers per row of centroid, center, vertex,
/// normal, crease_normal and triangle, nine of inertia (at 1 kg/m3), one of the others.
struct FieldArrays {
    std::vector<std::int64_t> spheres, surface, creases, vertices, triangles;  // rows per shape
    std::vector<double> volume, area, centroid, inertia;
    std::vector<double> center, share_volume, share_area, vertex;
    std::vector<float> normal, spread, crease_normal;
    std::vector<std::int32_t> crease_sphere, triangle;
};

}  // namespace ice::detail
