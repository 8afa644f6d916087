// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/certificate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/parallel.hpp"
#include "preprocess/fill/nearest_points.hpp"

namespace ice {

namespace {

constexpr double kThinGap =
    2.5;  // radii; sharp convex edges of 60 degrees lose 1, of 40 degrees 1.9
constexpr double kReachable = 1e-6;    // radii by which the other side may be nearer
constexpr double kFaceSpread = 0.087;  // 5 degrees

struct Measure {
    double gap = 0.0;
    double cover = -1.0;         // -1 where no sphere can touch
    double normal_error = -1.0;  // [rad]
};

Measure measure(const SurfaceTree& tree, const SphereSet& set, const NearestPoints& surface,
                const SurfaceSample& sample) {
    Measure out;
    out.gap = std::max(surface.nearest(sample.point).distance - set.radius, 0.0);
    const Vec3 seat = sample.point - set.radius * sample.normal;
    if (!tree.is_clear(seat, set.radius * (1.0 - kReachable))) return out;
    const auto near = surface.nearest(seat);
    out.cover = near.distance;
    const auto k = static_cast<std::size_t>(near.index);
    if (set.normal_spread[k] < kFaceSpread)
        out.normal_error = std::acos(std::clamp(set.normals[k].dot(sample.normal), -1.0, 1.0));
    return out;
}

double percentile(std::vector<std::pair<double, double>>& value_and_weight, double share) {
    std::sort(value_and_weight.begin(), value_and_weight.end());
    double total = 0.0, sum = 0.0;
    for (const auto& [value, weight] : value_and_weight) total += weight;
    for (const auto& [value, weight] : value_and_weight) {
        sum += weight;
        if (sum >= share * total) return value;
    }
    return value_and_weight.empty() ? 0.0 : value_and_weight.back().first;
}

// Groups unfilled samples that lie near each other.
std::vector<ThinFeature> group(std::vector<Vec3> points, double distance) {
    std::vector<ThinFeature> out;
    while (!points.empty()) {
        std::vector<Vec3> cluster{points.back()};
        points.pop_back();
        Eigen::AlignedBox3d box(cluster[0]);
        for (std::size_t k = 0; k < cluster.size(); ++k) {
            const auto split = std::partition(points.begin(), points.end(), [&](const Vec3& p) {
                return (p - cluster[k]).norm() > distance;
            });
            for (auto it = split; it != points.end(); ++it) {
                cluster.push_back(*it);
                box.extend(*it);
            }
            points.erase(split, points.end());
        }
        const Vec3 at = box.center();
        out.push_back({{at.x(), at.y(), at.z()}, box.diagonal().norm()});
    }
    std::sort(out.begin(), out.end(),
              [](const ThinFeature& l, const ThinFeature& r) { return l.size > r.size; });
    return out;
}

}  // namespace

void certify(const SurfaceTree& tree, const std::vector<SurfaceSample>& samples,
             const SphereSet& set, SpheresReport& report) {
    const auto surface_count =
        static_cast<std::size_t>(std::count(set.layers.begin(), set.layers.end(), std::uint8_t{1}));
    const NearestPoints surface(std::span(set.centers).first(surface_count));
    std::vector<Measure> measures(samples.size());
    parallel_for(samples.size(), 512,
                 [&](std::size_t k) { measures[k] = measure(tree, set, surface, samples[k]); });
    std::vector<double> beyond(set.size());
    parallel_for(set.size(), 512, [&](std::size_t k) {
        const Foot foot = tree.closest(set.centers[k]);
        beyond[k] = set.radii[k] + (foot.inside ? -foot.distance : foot.distance);
    });
    report.protrusion_max =
        beyond.empty() ? 0.0 : std::max(0.0, *std::max_element(beyond.begin(), beyond.end()));

    std::vector<std::pair<double, double>> gaps, errors;
    std::vector<Vec3> thin;
    double error_sum = 0.0, error_area = 0.0;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        const Measure& m = measures[k];
        gaps.emplace_back(m.gap, samples[k].area);
        report.covering_radius = std::max(report.covering_radius, m.cover);
        if (m.gap > kThinGap * set.radius) thin.push_back(samples[k].point);
        if (m.normal_error < 0.0) continue;
        errors.emplace_back(m.normal_error, samples[k].area);
        error_sum += m.normal_error * samples[k].area;
        error_area += samples[k].area;
    }
    constexpr double kDegrees = 180.0 / std::numbers::pi;
    report.gap_p50 = percentile(gaps, 0.5);
    report.gap_p99 = percentile(gaps, 0.99);
    report.gap_max = gaps.empty() ? 0.0 : gaps.back().first;
    report.normal_error_mean_deg = error_area > 0.0 ? kDegrees * error_sum / error_area : 0.0;
    report.normal_error_p99_deg = kDegrees * percentile(errors, 0.99);
    report.thin_features = group(std::move(thin), 3.0 * set.radius);
}

}  // namespace ice
