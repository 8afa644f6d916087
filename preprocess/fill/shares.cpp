// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/shares.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/parallel.hpp"
#include "preprocess/fill/nearest_points.hpp"
#include "preprocess/fill/offset_surface.hpp"

namespace ice {

namespace {

constexpr double kMostCells = 3e5;  // sampling points of the volume
constexpr int kMostPasses = 50;     // of the moments; two where no share comes near zero

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

// Lattice points inside the solid: a plain grid over its box, half a pitch off its faces.
std::vector<Vec3> volume_points(const SurfaceTree& tree, const SphereSet& set) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : tree.mesh().vertices) box.extend(v);
    const bool flat = set.dimension == 2;
    Vec3 size = box.sizes();
    if (flat) size.y() = 1.0;
    const double pitch =
        std::max(0.4 * set.radius, flat ? std::sqrt(size.x() * size.z() / kMostCells)
                                        : std::cbrt(size.prod() / kMostCells));
    std::size_t n[3];
    for (int d = 0; d < 3; ++d)
        n[d] = flat && d == 1 ? 1 : static_cast<std::size_t>(std::ceil(size[d] / pitch));
    const auto point = [&](std::size_t i, std::size_t row) {
        const Vec3 cell(static_cast<double>(i), static_cast<double>(row % n[1]),
                        static_cast<double>(row / n[1]));
        const Vec3 count(static_cast<double>(n[0]), static_cast<double>(n[1]),
                         static_cast<double>(n[2]));
        Vec3 p =
            box.min() + (cell + Vec3::Constant(0.5)).cwiseQuotient(count).cwiseProduct(box.sizes());
        if (flat) p.y() = 0.0;
        return p;
    };
    std::vector<std::vector<Vec3>> rows(n[1] * n[2]);
    parallel_for(rows.size(), 16, [&](std::size_t row) {
        const double step = box.sizes().x() / static_cast<double>(n[0]);
        for (std::size_t i = 0; i < n[0];) {
            // no surface is nearer than the foot, so neighbours within that distance are like this
            const Foot foot = tree.closest(point(i, row));
            const auto like = 1 + static_cast<std::size_t>(0.999 * foot.distance / step);
            const std::size_t end = std::min(n[0], i + like);
            for (; i < end; ++i)
                if (foot.inside) rows[row].push_back(point(i, row));
        }
    });
    std::vector<Vec3> out;
    for (const auto& row : rows) out.insert(out.end(), row.begin(), row.end());
    return out;
}

// Distance from the centroid of the shares to the solid's [m]; along y there is none in 2D.
double moment_error(const SphereSet& set) {
    double sum = 0.0;
    Vec3 first = Vec3::Zero();
    for (std::size_t k = 0; k < set.size(); ++k) {
        sum += set.volumes[k];
        first += set.volumes[k] * (set.centers[k] - set.solid.centroid);
    }
    if (set.dimension == 2) first.y() = 0.0;
    return first.norm() / sum;
}

// Multiplies the shares so that sum v = V and sum v x = V centroid, changing them least. Repeated:
// for the rounding, and where a share would become negative, which is then held just above zero.
void match_moments(SphereSet& set) {
    const double least = 1e-3 * set.solid.volume / static_cast<double>(set.size());
    for (int pass = 0; pass < kMostPasses; ++pass) {
        Vec3 mean = Vec3::Zero();
        double sum = 0.0;
        for (std::size_t k = 0; k < set.size(); ++k) {
            sum += set.volumes[k];
            mean += set.volumes[k] * set.centers[k];
        }
        mean /= sum;
        Eigen::Matrix4d moments = Eigen::Matrix4d::Zero();
        for (std::size_t k = 0; k < set.size(); ++k) {
            Eigen::Vector4d u;
            u << 1.0, set.centers[k] - mean;
            moments += set.volumes[k] * u * u.transpose();
        }
        Eigen::Vector4d target;
        target << set.solid.volume, set.solid.volume * (set.solid.centroid - mean);
        // where the spheres have no spread (y in 2D) least squares leaves the factor alone
        const Eigen::Vector4d lack = target - moments.col(0);
        const Eigen::Vector4d factor = moments.completeOrthogonalDecomposition().solve(lack);
        bool raised = false;
        for (std::size_t k = 0; k < set.size(); ++k) {
            double& v = set.volumes[k];
            v *= 1.0 + factor[0] + factor.tail<3>().dot(set.centers[k] - mean);
            if (v >= 0.5 * least) continue;
            v = least;
            raised = true;
        }
        if (!raised && pass > 0) return;
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

    const NearestPoints surface(std::span(set.centers).first(count));
    std::vector<std::int32_t> owner(samples.size());
    parallel_for(samples.size(), 1024, [&](std::size_t k) {
        owner[k] = surface.nearest(samples[k].point - set.radius * samples[k].normal).index;
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
    const double whole = set.dimension == 2 ? total : set.solid.area;
    for (std::size_t k = 0; k < count; ++k) {
        set.areas[k] *= whole / total;
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
        set.volumes.assign(set.size(), 0.0);
        const NearestPoints spheres(set.centers);
        const auto points = volume_points(tree, set);
        std::vector<std::int32_t> owner(points.size());
        parallel_for(points.size(), 1024,
                     [&](std::size_t k) { owner[k] = spheres.nearest(points[k]).index; });
        for (const std::int32_t sphere : owner)
            set.volumes[static_cast<std::size_t>(sphere)] += 1.0;
    }
    match_moments(set);
    return moment_error(set);
}

}  // namespace ice
