// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/shares.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/parallel.hpp"
#include "preprocess/fill/offset_surface.hpp"
#include "preprocess/fill/point_grid.hpp"

namespace ice {

namespace {

constexpr double kMostCells = 3e5;  // sampling points of the volume

std::size_t surface_count(const SphereSet& set) {
    return static_cast<std::size_t>(
        std::count(set.layers.begin(), set.layers.end(), std::uint8_t{1}));
}

void set_normals(const SurfaceTree& tree, SphereSet& set, std::size_t count) {
    parallel_for(count, 64, [&](std::size_t k) {
        auto directions = touch_directions(tree, set.centers[k], set.radii[k]);
        if (set.dimension == 2)
            std::erase_if(directions, [](const Vec3& d) { return std::abs(d.y()) > 0.5; });
        if (directions.empty())
            directions.push_back(
                (tree.closest(set.centers[k]).point - set.centers[k]).normalized());
        Vec3 sum = Vec3::Zero();
        for (const Vec3& d : directions) sum += d;
        // opposite faces cancel where a part is exactly as thick as the sphere
        const Vec3 normal = sum.norm() > 1e-6 ? Vec3(sum.normalized()) : directions.front();
        double least = 1.0;
        for (const Vec3& d : directions) least = std::min(least, d.dot(normal));
        set.normals[k] = normal;
        set.normal_spread[k] = directions.size() > 1 ? std::acos(std::max(least, -1.0)) : 0.0;
    });
}

// Lattice points inside the solid: a plain grid over its box, shifted off its faces.
std::vector<Vec3> volume_points(const SurfaceTree& tree, const SphereSet& set) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : tree.mesh().vertices) box.extend(v);
    Vec3 size = box.sizes();
    if (set.dimension == 2) size.y() = 1.0;
    const double pitch =
        set.dimension == 2 ? std::max(0.4 * set.radius, std::sqrt(size.x() * size.z() / kMostCells))
                           : std::max(0.4 * set.radius, std::cbrt(size.prod() / kMostCells));
    std::int64_t n[3];
    for (int d = 0; d < 3; ++d)
        n[d] =
            set.dimension == 2 && d == 1
                ? 1
                : std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(size[d] / pitch)));
    std::vector<Vec3> points(static_cast<std::size_t>(n[0] * n[1] * n[2]));
    std::vector<std::uint8_t> inside(points.size());
    parallel_for(points.size(), 1024, [&](std::size_t k) {
        const auto i = static_cast<std::int64_t>(k);
        const double at[3] = {static_cast<double>(i % n[0]), static_cast<double>(i / n[0] % n[1]),
                              static_cast<double>(i / (n[0] * n[1]))};
        for (int d = 0; d < 3; ++d)
            points[k][d] =
                box.min()[d] + (at[d] + 0.5) / static_cast<double>(n[d]) * box.sizes()[d];
        if (set.dimension == 2) points[k].y() = 0.0;
        inside[k] = tree.closest(points[k]).inside;
    });
    std::vector<Vec3> out;
    for (std::size_t k = 0; k < points.size(); ++k)
        if (inside[k]) out.push_back(points[k]);
    return out;
}

// Multiplies the shares so that sum v = V and sum v x = V centroid, changing them least.
void match_moments(SphereSet& set) {
    Vec3 mean = Vec3::Zero();
    double sum = 0.0;
    for (std::size_t k = 0; k < set.size(); ++k) {
        sum += set.volumes[k];
        mean += set.volumes[k] * set.centers[k];
    }
    mean /= sum;
    // twice: the second pass takes out the rounding of the first
    for (int pass = 0; pass < 2; ++pass) {
        Eigen::Matrix4d moments = Eigen::Matrix4d::Zero();
        for (std::size_t k = 0; k < set.size(); ++k) {
            Eigen::Vector4d u;
            u << 1.0, set.centers[k] - mean;
            moments += set.volumes[k] * u * u.transpose();
        }
        Eigen::Vector4d target;
        target << set.solid.volume, set.solid.volume * (set.solid.centroid - mean);
        // in 2D y has no spread: least squares leaves its factor alone
        const Eigen::Vector4d lack = target - moments.col(0);
        const Eigen::Vector4d factor = moments.completeOrthogonalDecomposition().solve(lack);
        for (std::size_t k = 0; k < set.size(); ++k)
            set.volumes[k] *= 1.0 + factor[0] + factor.tail<3>().dot(set.centers[k] - mean);
    }
}

}  // namespace

void share_surface(const SurfaceTree& tree, const std::vector<SurfaceSample>& samples,
                   SphereSet& set) {
    const std::size_t count = surface_count(set);
    set.normals.assign(set.size(), Vec3::Zero());
    set.normal_spread.assign(set.size(), 0.0);
    set.areas.assign(set.size(), 0.0);
    set.regions.assign(set.size(), 0);
    set_normals(tree, set, count);

    PointGrid grid(set.spacing);
    for (std::size_t k = 0; k < count; ++k) grid.add(set.centers[k]);
    std::vector<std::int32_t> owner(samples.size());
    parallel_for(samples.size(), 1024, [&](std::size_t k) {
        const Vec3 at = samples[k].point - set.radius * samples[k].normal;
        double limit = set.spacing;
        do {
            owner[k] = grid.nearest(at, limit).index;
            limit *= 4.0;
        } while (owner[k] < 0);
    });
    std::vector<std::map<std::int32_t, double>> by_region(count);
    double total = 0.0;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        const auto sphere = static_cast<std::size_t>(owner[k]);
        set.areas[sphere] += samples[k].area;
        total += samples[k].area;
        by_region[sphere][tree.mesh().region[static_cast<std::size_t>(samples[k].triangle)]] +=
            samples[k].area;
    }
    // in 2D the two flat ends belong to no disc
    const double surface = set.dimension == 2 ? total : set.solid.area;
    for (std::size_t k = 0; k < count; ++k) {
        set.areas[k] *= surface / total;
        double most = 0.0;
        for (const auto& [region, area] : by_region[k])
            if (area > most) {
                most = area;
                set.regions[k] = region;
            }
        if (by_region[k].empty())
            set.regions[k] =
                tree.mesh().region[static_cast<std::size_t>(tree.closest(set.centers[k]).triangle)];
    }
}

double share_volume(const SurfaceTree& tree, bool equal, SphereSet& set) {
    if (equal) {
        set.volumes.assign(set.size(), 1.0);
    } else {
        set.volumes.assign(set.size(), 1e-3);  // no share is zero
        PointGrid grid(set.spacing);
        for (const Vec3& c : set.centers) grid.add(c);
        const auto points = volume_points(tree, set);
        std::vector<std::int32_t> owner(points.size());
        parallel_for(points.size(), 1024, [&](std::size_t k) {
            double limit = set.spacing;
            do {
                owner[k] = grid.nearest(points[k], limit).index;
                limit *= 4.0;
            } while (owner[k] < 0);
        });
        for (const std::int32_t sphere : owner)
            set.volumes[static_cast<std::size_t>(sphere)] += 1.0;
    }
    match_moments(set);
    Vec3 first = Vec3::Zero();
    for (std::size_t k = 0; k < set.size(); ++k) {
        if (!(set.volumes[k] > 0.0)) return std::nan("");
        first += set.volumes[k] * set.centers[k];
    }
    return (first / set.solid.volume - set.solid.centroid).norm();
}

}  // namespace ice
