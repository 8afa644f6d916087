// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/shares.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "common/base/parallel.hpp"
#include "preprocess/fill/narrowest_cone.hpp"
#include "preprocess/fill/offset_surface.hpp"

namespace ice {

namespace {

// Passes of the moments at most [-]: two where no share comes near zero. Where 50 are not enough,
// no positive shares have the centroid. Fewer give up on sets that have such shares.
constexpr int kMostPasses = 50;
// Least share of the volume [-] that interior cells leave to the surface spheres: their shares must
// be positive. A larger value makes the cells of thin solids smaller, a smaller one leaves the
// surface spheres there almost no volume.
constexpr double kLeastRest = 0.02;
// Least share of a surface sphere over the mean one [-], of the area and of the volume: none is
// zero or negative. Larger takes more from the others, smaller leaves spheres nearly without a
// share.
constexpr double kLeastOfMean = 1e-3;
// A share is held at its least where it falls below this much of it [-]: a half, so that one that
// is held is not held again for rounding. Nearer to 1 more passes are made, smaller lets shares
// become as small.
constexpr double kHeld = 0.5;
// Length of a normal's part in the centre plane [-] below which a cone lies athwart: the part's
// direction has few digits. Larger leaves normals beside the plane, smaller takes rounding for one.
constexpr double kAthwart = 1e-3;

// The directions in which a sphere touches; never empty.
std::vector<Vec3> directions_of(const SurfaceTree& tree, const SphereSet& set, std::size_t k,
                                bool in_centre_plane) {
    auto directions = touch_directions(tree, set.centers[k], set.radii[k]);
    if (set.dimension == 2)
        std::erase_if(directions, [](const Vec3& d) { return std::abs(d.y()) > 0.5; });
    if (directions.empty())
        directions.push_back((tree.closest(set.centers[k]).point - set.centers[k]).normalized());
    if (!in_centre_plane) return directions;
    // a part exactly as broad as the sphere touches on both sides, a lattice sphere has its foot
    // on one: neither side is the other's better
    const std::size_t count = directions.size();
    for (std::size_t d = 0; d < count; ++d) {
        const Vec3 image(directions[d].x(), -directions[d].y(), directions[d].z());
        if (std::none_of(directions.begin(), directions.end(),
                         [&](const Vec3& other) { return other.dot(image) > kSameTouch; }))
            directions.push_back(image);
    }
    return directions;
}

// Sum of value(k) over [from, to), by blocks: the same bits for any number of threads.
template <class Sum, class Value>
Sum sum_of(std::size_t from, std::size_t to, Sum zero, const Value& value) {
    // shares added up in one go [-]: another size changes the last digits of the sum
    constexpr std::size_t kBlock = 1 << 16;
    std::vector<Sum> parts((to - from + kBlock - 1) / kBlock, zero);
    parallel_tasks(parts.size(), true, [&](std::size_t b) {
        const std::size_t end = std::min(to, from + (b + 1) * kBlock);
        Sum sum = zero;
        for (std::size_t k = from + b * kBlock; k < end; ++k) sum += value(k);
        parts[b] = sum;
    });
    for (const Sum& part : parts) zero += part;
    return zero;
}

// First moment of the shares of [from, to) about the solid's centroid.
Vec3 moment_of(const SphereSet& set, std::size_t from, std::size_t to) {
    return sum_of(from, to, Vec3(Vec3::Zero()), [&](std::size_t k) -> Vec3 {
        return set.volumes[k] * (set.centers[k] - set.solid.centroid);
    });
}

// Multiplies the first `count` shares, by factors as near to 1 as possible, so that with `others`
// sum v = V and sum v x = V centroid. A pass leaves rounding; a share that would become negative is
// set just above zero. Both need further passes. If that has no solution, the shares keep their
// proportions.
// @param others  volume and first moment about the centroid of the shares that stay
void match_moments(std::size_t count, const Eigen::Vector4d& others, bool mirror, SphereSet& set) {
    Eigen::Vector4d target = -others;
    target[0] += set.solid.volume;
    // a share that would become negative is held there
    const double least = kLeastOfMean * target[0] / static_cast<double>(count);
    const std::vector<double> before(set.volumes.begin(),
                                     set.volumes.begin() + static_cast<std::ptrdiff_t>(count));
    for (int pass = 0; pass < kMostPasses; ++pass) {
        // least squares: factors 1 + f0 + f . (x - centroid) for which the shares have the
        // volume and the centroid
        Eigen::Matrix4d moments = sum_of(0, count, Eigen::Matrix4d(Eigen::Matrix4d::Zero()),
                                         [&](std::size_t k) -> Eigen::Matrix4d {
                                             Eigen::Vector4d u;
                                             u << 1.0, set.centers[k] - set.solid.centroid;
                                             return set.volumes[k] * u * u.transpose();
                                         });
        // where the spheres have no spread (y in 2D) least squares leaves the factor alone
        Eigen::Vector4d lack = target - moments.col(0);
        if (mirror) {  // along y it is so but for the rounding
            lack[2] = 0.0;
            moments.row(2).setZero();
            moments.col(2).setZero();
        }
        const Eigen::Vector4d factor = moments.completeOrthogonalDecomposition().solve(lack);
        bool raised = false;
        for (std::size_t k = 0; k < count; ++k) {
            double& v = set.volumes[k];
            const Vec3 from = set.centers[k] - set.solid.centroid;
            v *= 1.0 + factor[0] + factor[1] * from.x() + (mirror ? 0.0 : factor[2] * from.y()) +
                 factor[3] * from.z();
            if (v >= kHeld * least) continue;
            v = least;
            raised = true;
        }
        if (!raised && pass > 0) return;
    }
    // no positive shares have their centroid there: then at least their sum is the volume
    const double sum = std::accumulate(before.begin(), before.end(), 0.0);
    for (std::size_t k = 0; k < count; ++k) set.volumes[k] = before[k] * target[0] / sum;
}

// Distance from the centroid of all shares to the solid's [m]; along y there is none in 2D.
double centroid_miss(const Eigen::Vector4d& others, std::size_t count, const SphereSet& set) {
    Vec3 first = moment_of(set, 0, count) + others.tail<3>();
    if (set.dimension == 2) first.y() = 0.0;
    return first.norm() / set.solid.volume;
}

// Which region has most of each sphere's area. Nearly all spheres see one: the others wait in a
// list.
class RegionAreas {
public:
    explicit RegionAreas(std::size_t count) : first_(count) {}

    void add(std::size_t sphere, std::int32_t region, double area) {
        Part& first = first_[sphere];
        if (first.region < 0) first.region = region;
        if (first.region == region)
            first.area += area;
        else
            others_[{sphere, region}] += area;
    }

    /// -1 for spheres that no area was added to.
    std::vector<std::int32_t> largest() const {
        std::vector<Part> best = first_;
        for (const auto& [key, area] : others_)
            if (area > best[key.first].area) best[key.first] = {key.second, area};
        std::vector<std::int32_t> out;
        for (const Part& part : best) out.push_back(part.region);
        return out;
    }

private:
    struct Part {
        std::int32_t region = -1;
        double area = 0.0;
    };
    std::vector<Part> first_;
    std::map<std::pair<std::size_t, std::int32_t>, double> others_;
};

}  // namespace

void set_normals(const SurfaceTree& tree, const std::vector<std::int32_t>& twins, SphereSet& set) {
    const std::size_t count = set.surface_count;
    set.normals.assign(count, Vec3::Zero());
    set.normal_spread.assign(count, 0.0);
    std::vector<std::vector<Vec3>> creases(count);
    parallel_for(count, 4096, [&](std::size_t k) {
        const double y = set.centers[k].y();
        // Of a symmetric solid only the half y >= 0 is measured; the other half copies it, so that
        // both sides have the same bits mirrored.
        if (!twins.empty() && y < 0.0 && twins[k] != static_cast<std::int32_t>(k)) return;
        auto directions = directions_of(tree, set, k, !twins.empty() && y == 0.0);
        const Cone cone = narrowest_cone(directions);
        set.normals[k] = cone.axis;
        if (!twins.empty() && y == 0.0) {
            // A sphere in the plane of symmetry is its own twin: its normal lies in that plane,
            // unless the cone is nearly athwart.
            const Vec3 flat(cone.axis.x(), 0.0, cone.axis.z());
            if (flat.norm() > kAthwart) set.normals[k] = flat.normalized();
        }
        set.normal_spread[k] = directions.size() > 1 ? cone.half_angle : 0.0;
        if (directions.size() > 1) creases[k] = std::move(directions);
    });
    const auto image = [](const Vec3& n) { return Vec3(n.x(), -n.y(), n.z()); };
    set.creases.clear();
    for (std::size_t k = 0; k < count; ++k) {
        const auto twin = twins.empty() ? k : static_cast<std::size_t>(twins[k]);
        const bool mirrored = twin != k && set.centers[k].y() < 0.0;
        if (mirrored) {
            set.normals[k] = image(set.normals[twin]);
            set.normal_spread[k] = set.normal_spread[twin];
        }
        for (const Vec3& n : creases[mirrored ? twin : k])
            set.creases.push_back({static_cast<std::int32_t>(k), mirrored ? image(n) : n});
    }
}

void share_surface(const SurfaceTree& tree, const std::vector<Sight>& sights,
                   const std::vector<std::int32_t>& twins, SphereSet& set) {
    const std::size_t count = set.surface_count;
    set.areas.assign(count, 0.0);
    RegionAreas regions(count);
    double total = 0.0;
    for (const Sight& sight : sights) {
        auto sphere = static_cast<std::size_t>(sight.owner);
        // samples in y >= 0 count for port, whichever twin is nearer
        if (!twins.empty() && set.centers[sphere].y() < 0.0)
            sphere = static_cast<std::size_t>(twins[sphere]);
        set.areas[sphere] += sight.area;
        total += sight.area;
        regions.add(sphere, tree.mesh().region[static_cast<std::size_t>(sight.triangle)],
                    sight.area);
    }
    // a region by the largest part of the sphere's area
    set.regions = regions.largest();
    // in 2D the two flat ends belong to no disc
    double whole = set.dimension == 2 ? total : set.solid.area;
    // both sides of a symmetric solid have half of the area each
    if (!twins.empty()) whole *= 0.5;
    for (std::size_t k = 0; k < count; ++k) {
        if (!twins.empty() && set.centers[k].y() < 0.0) continue;
        const bool alone = !twins.empty() && twins[k] == static_cast<std::int32_t>(k);
        set.areas[k] *= (alone ? 2.0 : 1.0) * whole / total;
        if (set.regions[k] < 0)
            set.regions[k] =
                tree.mesh().region[static_cast<std::size_t>(tree.closest(set.centers[k]).triangle)];
        if (twins.empty() || alone) continue;
        const auto twin = static_cast<std::size_t>(twins[k]);
        set.areas[twin] = set.areas[k];
        set.regions[twin] = set.regions[k];
    }
}

double share_volume(double cell, bool mirror, SphereSet& set) {
    const std::size_t surface = set.surface_count, inside = set.size() - surface;
    Eigen::Vector4d others = Eigen::Vector4d::Zero();
    if (cell == 0.0) {
        set.volumes.assign(set.size(), set.solid.volume / static_cast<double>(set.size()));
        match_moments(set.size(), others, mirror, set);
        return centroid_miss(others, set.size(), set);
    }
    const double most = (1.0 - kLeastRest) * set.solid.volume;
    // interior cells may add up to more than the solid where it is thin: then they are made
    // smaller
    if (static_cast<double>(inside) * cell > most) cell = most / static_cast<double>(inside);
    others[0] = static_cast<double>(inside) * cell;
    const double rest = set.solid.volume - others[0];
    const double area = std::accumulate(set.areas.begin(), set.areas.end(), 0.0);
    set.volumes.assign(set.size(), cell);
    // a sphere without area keeps a little, so that no share is zero
    const double floor = kLeastOfMean * area / static_cast<double>(surface);
    for (std::size_t k = 0; k < surface; ++k)
        set.volumes[k] = rest * std::max(set.areas[k], floor) / area;
    others.tail<3>() = moment_of(set, surface, set.size());
    match_moments(surface, others, mirror, set);
    return centroid_miss(others, surface, set);
}

}  // namespace ice
