// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/measure_certificate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "common/base/parallel.hpp"
#include "common/base/units.hpp"
#include "preprocess/fill/offset_surface.hpp"
#include "preprocess/fill/point_cells.hpp"

namespace ice {

namespace {

// Gap [radii] from which a place is thin: sharp convex edges of 60 degrees lose 1, of 40 degrees
// 1.9, so that ordinary edges are none. A smaller value reports edges as thin parts.
constexpr double kThinGap = 2.5;
// Distance [spacings] by which the nearest sphere may lie aside of a place: the layer's covering
// radius. A larger value counts fewer places as thin or without a sphere, a smaller one counts
// places between the spheres of an ordinary layer as such.
constexpr double kAside = 0.65;
// Places whose cover is measured by a climb: the worst samples. More may find a worse place and
// take as much longer.
constexpr std::size_t kClimbs = 512;
// Steps of such a climb over the samples' distance [-]: the first, and those that are too short to
// find more. A longer first one leaves the sample's surroundings, shorter last ones take longer for
// the third digit of the radius.
constexpr double kFirstStep = 0.5, kShortStep = 0.04;

// Values up to `most` by weight, in bins of most / 65536: a percentile needs no sorting.
class Histogram {
public:
    explicit Histogram(double most) : most_(most), weight_(most > 0.0 ? kBins : 1, 0.0) {}
    void add(double value, double weight) {
        const auto last = static_cast<double>(weight_.size() - 1);
        const double at = most_ > 0.0 ? value / most_ * last : 0.0;
        weight_[static_cast<std::size_t>(std::clamp(at, 0.0, last))] += weight;
        total_ += weight;
    }
    double percentile(double share) const {
        double sum = 0.0;
        std::size_t bin = 0;
        while (bin + 1 < weight_.size() && (sum += weight_[bin]) < share * total_) ++bin;
        return most_ > 0.0 ? most_ * static_cast<double>(bin) / static_cast<double>(kBins - 1)
                           : 0.0;
    }

private:
    // a percentile is within 1 / 65536 of the largest value [-], and the memory is half a megabyte;
    // more bins are finer and larger
    static constexpr std::size_t kBins = 1 << 16;
    double most_, total_ = 0.0;
    std::vector<double> weight_;
};

// The wetted surface that no sphere fits, and the gaps in the ice belt.
class Unfitted {
public:
    Unfitted(const SphereSet& set, const IceBelt& belt)
        : belt_(belt), least_(std::hypot(1.5 * set.radius, kAside * set.spacing) - set.radius) {}

    void add(const Sight& sight) {
        // above the water only the belt counts: a deck and a superstructure touch no ice
        const auto z = static_cast<double>(sight.point.z());
        if (belt_ && z > belt_.water()) return add_in_belt(sight, z);
        area_ += sight.area;
        if (sight.cover < 0.0f && sight.gap > least_) unfitted_ += sight.area;
        add_in_belt(sight, z);
    }
    void tell(SpheresReport& report) {
        report.unfitted_share = area_ > 0.0 ? unfitted_ / area_ : 0.0;
        if (!belt_ || gaps_.empty()) return;
        std::sort(gaps_.begin(), gaps_.end());
        double total = 0.0, sum = 0.0;
        for (const auto& [gap, area] : gaps_) total += area;
        for (const auto& [gap, area] : gaps_) {
            if (sum < 0.99 * total) report.belt.gap_p99 = gap;
            sum += area;
        }
        report.belt.gap_max = gaps_.back().first;
    }

private:
    void add_in_belt(const Sight& sight, double z) {
        if (belt_.contains(z)) gaps_.emplace_back(static_cast<double>(sight.gap), sight.area);
    }

    const IceBelt belt_;
    double least_;  // gap [m]
    double area_ = 0.0, unfitted_ = 0.0;
    std::vector<std::pair<double, double>> gaps_;  // in the belt, with their areas
};

// The points of a small cube, which are one feature.
struct Clump {
    Eigen::AlignedBox3d box;
    bool taken = false;
};

// Groups unfilled samples: cubes of them that are within `distance` of each other are of one
// feature. Cubes, because a fine mesh has a sample in each triangle.
std::vector<ThinFeature> group(const std::vector<Vec3>& points, double distance) {
    std::map<std::array<std::int64_t, 3>, std::size_t> known;
    std::vector<Clump> clumps;
    std::vector<Vec3> first_points;
    // samples that share a cube are one clump
    const double cube = 0.25 * distance;
    for (const Vec3& p : points) {
        std::array<std::int64_t, 3> at;
        for (int d = 0; d < 3; ++d)
            at[static_cast<std::size_t>(d)] = static_cast<std::int64_t>(std::floor(p[d] / cube));
        const auto [found, fresh] = known.try_emplace(at, clumps.size());
        if (fresh) {
            clumps.emplace_back();
            first_points.push_back(p);
        }
        clumps[found->second].box.extend(p);
    }
    std::vector<ThinFeature> out;
    if (clumps.empty()) return out;
    // clumps within the distance of each other join: a flood fill from each one not taken yet
    const PointCells cells(first_points, distance);
    const double reach = distance + 2.0 * std::sqrt(3.0) * cube;
    std::vector<std::size_t> front;
    for (std::size_t first = 0; first < clumps.size(); ++first) {
        if (clumps[first].taken) continue;
        clumps[first].taken = true;
        front.assign(1, first);
        Eigen::AlignedBox3d box = clumps[first].box;
        while (!front.empty()) {
            const std::size_t here = front.back();
            front.pop_back();
            cells.visit(first_points[here], reach, [&](std::int32_t k, double) {
                const auto near = static_cast<std::size_t>(k);
                Clump& other = clumps[near];
                if (other.taken || clumps[here].box.exteriorDistance(other.box) > distance) return;
                other.taken = true;
                front.push_back(near);
                box.extend(other.box);
            });
        }
        const Vec3 at = box.center();
        out.push_back({{at.x(), at.y(), at.z()}, box.diagonal().norm()});
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const ThinFeature& l, const ThinFeature& r) { return l.size > r.size; });
    return out;
}

double measure_protrusion(const SurfaceTree& tree, const SphereSet& set, bool half) {
    // the interior's lattice points were each decided by their distance when they were placed
    std::vector<double> beyond(set.surface_count, 0.0);
    parallel_for(set.surface_count, 512, [&](std::size_t k) {
        if (half && set.centers[k].y() < 0.0) return;
        // a conforming layer's centres are inside by their winding numbers (drop_outside), a
        // lattice's by their rows', where a foot's normal may be another
        beyond[k] = set.radii[k] - tree.closest(set.centers[k]).distance;
    });
    return beyond.empty() ? 0.0 : std::max(0.0, *std::max_element(beyond.begin(), beyond.end()));
}

// Sets report.covering_radius and where it is.
void measure_cover(const SurfaceTree& tree, const SphereSet& set, const SphereFinder& finder,
                   const std::vector<Sight>& sights, double size, SpheresReport& report) {
    std::vector<std::int32_t> worst;
    float found = 0.0f;
    for (const Sight& sight : sights) found = std::max(found, sight.cover);
    // the places between the samples: climb from the worst of them
    const float enough = found - static_cast<float>(size);
    for (std::size_t k = 0; k < sights.size(); ++k)
        if (sights[k].cover > std::max(enough, 0.0f)) worst.push_back(static_cast<std::int32_t>(k));
    const auto farther = [&](std::int32_t l, std::int32_t r) {
        const float a = sights[static_cast<std::size_t>(l)].cover;
        const float b = sights[static_cast<std::size_t>(r)].cover;
        return a > b || (a == b && l < r);
    };
    const std::size_t count = std::min(worst.size(), kClimbs);
    std::partial_sort(worst.begin(), worst.begin() + static_cast<std::ptrdiff_t>(count),
                      worst.end(), farther);
    std::vector<double> top(count, static_cast<double>(found));
    std::vector<Vec3> places(count, Vec3::Zero());
    parallel_for(count, 16, [&](std::size_t k) {
        const Sight& sight = sights[static_cast<std::size_t>(worst[k])];
        const Vec3& normal = tree.normal(sight.triangle);
        Vec3 at = sight.point.cast<double>() - set.radius * normal;
        double here = finder.covering(at, normal, finder.nearest(at)).distance;
        Vec3 e1 = set.dimension == 2 ? normal.cross(Vec3::UnitY()) : normal.unitOrthogonal();
        const Vec3 e2 = normal.cross(e1);
        // A climb in eight directions, with steps that are halved. The result holds near the worst
        // samples only: it proves no bound.
        for (double step = kFirstStep * size; step > kShortStep * size; step *= 0.5)
            for (int direction = 0; direction < (set.dimension == 2 ? 2 : 8); ++direction) {
                const double angle = set.dimension == 2 ? direction * std::numbers::pi
                                                        : direction * std::numbers::pi / 4.0;
                const auto seat =
                    settle(tree, at + step * (std::cos(angle) * e1 + std::sin(angle) * e2),
                           set.radius, sight.triangle);
                if (!seat) continue;
                const auto any = finder.nearest(seat->center);
                const double there = finder.covering(seat->center, seat->normal, any).distance;
                if (there <= here) continue;
                here = there;
                at = seat->center;
            }
        top[k] = here;
        places[k] = tree.closest(at, sight.triangle).point;
    });
    report.covering_radius = std::max(static_cast<double>(found), 0.0);
    for (std::size_t k = 0; k < count; ++k) {
        if (top[k] < report.covering_radius) continue;
        report.covering_radius = top[k];
        report.covering_at = {places[k].x(), places[k].y(), places[k].z()};
    }
}

}  // namespace

void measure_certificate(const SurfaceTree& tree, const SphereFinder& finder,
                         const std::vector<Sight>& sights, bool half, const SphereSet& set,
                         SpheresReport& report) {
    report.protrusion_max = measure_protrusion(tree, set, half);
    measure_cover(tree, set, finder, sights, survey_size(set, half), report);
    // the histograms need their ends first
    double gap_max = 0.0, error_max = 0.0;
    for (const Sight& sight : sights) {
        gap_max = std::max(gap_max, static_cast<double>(sight.gap));
        error_max = std::max(error_max, static_cast<double>(sight.normal_error));
    }
    // the sphere of a sample may lie aside by as much as the layer's spacing allows
    const double thin_gap =
        std::hypot((1.0 + kThinGap) * set.radius, kAside * set.spacing) - set.radius;
    Histogram gaps(gap_max), errors(error_max);
    double error_sum = 0.0, error_area = 0.0;
    std::vector<Vec3> thin;
    Unfitted unfitted(set, report.belt);
    for (const Sight& sight : sights) {
        gaps.add(sight.gap, sight.area);
        unfitted.add(sight);
        if (sight.gap > thin_gap) {
            const Vec3 at = sight.point.cast<double>();
            thin.push_back(at);
            if (half && at.y() > 0.0) thin.emplace_back(at.x(), -at.y(), at.z());
        }
        if (sight.normal_error < 0.0f) continue;
        errors.add(sight.normal_error, sight.area);
        error_sum += static_cast<double>(sight.normal_error) * sight.area;
        error_area += sight.area;
    }
    report.gap_p50 = gaps.percentile(0.5);
    report.gap_p99 = gaps.percentile(0.99);
    report.gap_max = gap_max;
    unfitted.tell(report);
    report.normal_error_mean_deg =
        error_area > 0.0 ? kDegreesPerRadian * error_sum / error_area : 0.0;
    report.normal_error_p99_deg = kDegreesPerRadian * errors.percentile(0.99);
    report.thin_features = group(thin, 3.0 * set.radius);
}

}  // namespace ice
