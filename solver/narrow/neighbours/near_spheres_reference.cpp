// SPDX-License-Identifier: GPL-3.0-or-later
// Which spheres of two bodies may meet, group by group: the definition, one sphere at a time.
// near_spheres_simd.cpp finds the same in lanes.
#include <algorithm>

#include "solver/narrow/neighbours/near_spheres.hpp"

namespace ice::reference {

void find_groups(const SphereBlocks& spheres, const FloatBox& box, float grow,
                 std::vector<std::int32_t>& out) {
    out.clear();
    const BoxRows& rows = spheres.groups;
    for (std::size_t g = 0; g < spheres.group_count; ++g) {
        bool near = true;
        // boxes overlap unless one of six faces separates them
        for (int d = 0; d < 3; ++d)
            near = near && rows.low[d][g] <= box.high[d] + grow &&
                   rows.high[d][g] >= box.low[d] - grow;
        if (near) out.push_back(static_cast<std::int32_t>(g));
    }
}

namespace {

void clear(NearSpheres& out) {
    for (auto* values : {&out.x, &out.y, &out.z, &out.normal_extent, &out.tangent_extent, &out.own})
        values->clear();
    out.id.clear();
    out.count = 0;
    out.box = {{kBeyondAll, kBeyondAll, kBeyondAll}, {-kBeyondAll, -kBeyondAll, -kBeyondAll}};
}

// Appends sphere k of `from`, which is at `at`, where it lies in the box.
template <class Spheres>
void pick(const Spheres& from, std::size_t k, const float (&at)[3], const FloatBox& box, float grow,
          NearSpheres& out) {
    const float limit = grow + from.own[k];
    for (int d = 0; d < 3; ++d)
        if (at[d] < box.low[d] - limit || at[d] > box.high[d] + limit) return;
    out.x.push_back(at[0]);
    out.y.push_back(at[1]);
    out.z.push_back(at[2]);
    out.normal_extent.push_back(from.normal_extent[k]);
    out.tangent_extent.push_back(from.tangent_extent[k]);
    out.own.push_back(from.own[k]);
    out.id.push_back(from.id[k]);
    ++out.count;
    for (int d = 0; d < 3; ++d) {
        // the box of the picked spheres narrows the search in the other body
        out.box.low[d] = std::min(out.box.low[d], at[d]);
        out.box.high[d] = std::max(out.box.high[d], at[d]);
    }
}

}  // namespace

void pick_spheres(const SphereBlocks& spheres, const std::vector<std::int32_t>& groups,
                  const FloatPose& pose, const FloatBox& box, float grow, NearSpheres& out) {
    clear(out);
    for (const std::int32_t g : groups)
        for (std::size_t k = SphereBlocks::kGroup * static_cast<std::size_t>(g);
             k < SphereBlocks::kGroup * (static_cast<std::size_t>(g) + 1); ++k) {
            float at[3];
            for (int d = 0; d < 3; ++d) {
                const float* row = pose.rotation[d];
                // The order of the SIMD kernel's operations: both must round alike.
                at[d] = (row[0] * spheres.x[k] + row[1] * spheres.y[k]) +
                        (row[2] * spheres.z[k] + pose.translation[d]);
            }
            pick(spheres, k, at, box, grow, out);
        }
}

void pick_spheres(const NearSpheres& from, const FloatBox& box, float grow, NearSpheres& out) {
    clear(out);
    for (std::size_t k = 0; k < from.count; ++k)
        pick(from, k, {from.x[k], from.y[k], from.z[k]}, box, grow, out);
}

void find_near_pairs(const NearSpheres& few, std::size_t first, std::size_t last,
                     const NearSpheres& many, const SearchRange& range, NearPairs& out) {
    out.partner.clear();
    out.end.clear();
    for (std::size_t f = first; f < last; ++f) {
        for (std::size_t m = 0; m < many.count; ++m) {
            const float dx = many.x[m] - few.x[f], dy = many.y[m] - few.y[f],
                        dz = many.z[m] - few.z[f];
            // The limits along and across the normal make a cylinder; the sphere around it
            // needs no normal.
            const float along =
                many.normal_extent[m] + (few.normal_extent[f] + range.normal_extent);
            const float across =
                many.tangent_extent[m] + (few.tangent_extent[f] + range.tangent_extent);
            if (dx * dx + dy * dy + dz * dz <= along * along + across * across)
                out.partner.push_back(many.id[m]);
        }
        out.end.push_back(static_cast<std::int32_t>(out.partner.size()));
    }
}

}  // namespace ice::reference
