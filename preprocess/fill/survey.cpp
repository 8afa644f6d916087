// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/survey.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/assert.hpp"
#include "common/base/parallel.hpp"
#include "preprocess/fill/offset_surface.hpp"

namespace ice {

namespace {

// Samples of a survey, about, at most [-]: 60 MB. Percentiles need no more; more find deeper gaps
// of fine sets and take longer.
constexpr double kMostSamples = 1.5e6;
// Size of a sample [spacings] where only shares are needed: about nine samples for each sphere. A
// larger value makes the areas of equal spheres differ, a smaller one takes longer.
constexpr double kShareSize = 1.0 / 3.0;
// Share of the radius [-] by which the other side may be nearer: rounding of settled seats. A
// larger value counts places that no sphere fits as places without cover, a smaller one leaves such
// that one just fits out.
constexpr double kReachable = 1e-6;
// Distance to the nearest sphere [spacings] from which a part has no spheres and is represented by
// none. A larger value only makes the search longer there.
constexpr double kFar = 8.0;
// Spread [rad], 5 degrees, beyond which a sphere is in an edge and has no normal of a face. A
// larger value adds the normals of edges to the normal errors, a smaller one leaves curved faces
// out of them.
constexpr double kFaceSpread = 0.087;

// `last` is the sphere that the sample before was near to: likely a neighbour.
Sight look(const SurfaceTree& tree, const SphereSet& set, const SphereFinder& finder,
           const SurfaceSample& sample, bool share_only, std::int32_t& last) {
    const double radius = set.radius;
    Sight out;
    out.area = sample.area;
    out.triangle = sample.triangle;
    out.point = sample.point.cast<float>();
    // The centre of the sphere that would touch the surface here.
    const Vec3 seat = sample.point - radius * sample.normal;
    // the sphere of the sample: the nearest one whose normals agree with the surface there
    const auto any = finder.nearest(seat, last);
    last = any.index;
    const auto near = finder.agreeing(seat, sample.normal, any);
    out.owner = near.index;
    const Vec3& center = set.centers[static_cast<std::size_t>(near.index)];
    out.gap = static_cast<float>(std::max((sample.point - center).norm() - radius, 0.0));
    // Where no sphere fits, nothing can cover: in a wedge or a thin part the sphere at this seat
    // would stick out on the other side. Such places count as gap, not as cover.
    if (share_only || !tree.is_clear(seat, radius * (1.0 - kReachable))) return out;
    out.cover = static_cast<float>(finder.covering(seat, sample.normal, any).distance);
    const auto k = static_cast<std::size_t>(near.index);
    // In an edge a sphere has a normal midway between faces, which is right there and wrong on each
    // of them.
    if (set.normal_spread[k] >= kFaceSpread) return out;
    const Vec3& n = set.normals[k];
    // the angle by its sine too: acos alone has no digits near zero
    out.normal_error =
        static_cast<float>(std::atan2(n.cross(sample.normal).norm(), n.dot(sample.normal)));
    return out;
}

}  // namespace

SphereFinder::SphereFinder(const SphereSet& set)
    : set_(set),
      cells_(std::span(set.centers).first(set.surface_count), 2.0 * set.spacing),
      least_(set.surface_count) {
    ICE_ASSERT(set.surface_count <= set.normals.size() &&
               set.surface_count <= set.normal_spread.size());
    // Cosines once for each sphere: they are compared for millions of samples.
    const double on_face = std::cos(kFaceTurn);
    for (std::size_t k = 0; k < least_.size(); ++k)
        least_[k] = set.normal_spread[k] == 0.0
                        ? on_face
                        : std::cos(std::min(set.normal_spread[k] + kFaceTurn, std::numbers::pi));
}

PointCells::Nearest SphereFinder::nearest(const Vec3& p, std::int32_t known) const {
    if (known < 0) return cells_.nearest(p);
    const double distance = (set_.centers[static_cast<std::size_t>(known)] - p).norm();
    return cells_.nearest(p, {known, distance});
}

bool SphereFinder::covers(std::int32_t sphere, const Vec3& normal) const {
    // a right angle and a little [rad]: the faces of a box cover each other's edges despite
    // rounding; a larger value lets spheres cover faces that turn away from them, a smaller one
    // leaves edges of boxes uncovered
    constexpr double kRightAngle = 0.5 * std::numbers::pi + 0.01;
    const auto k = static_cast<std::size_t>(sphere);
    const double most = std::min(set_.normal_spread[k] + kRightAngle, std::numbers::pi);
    return set_.normals[k].dot(normal) >= std::cos(most);
}

template <class Accept>
PointCells::Nearest SphereFinder::nearest_of(const Vec3& p, const PointCells::Nearest& any,
                                             const Accept& accept) const {
    if (accept(any.index) || any.distance > kFar * set_.spacing) return any;
    // Of equal distances the smaller index, whatever the order of the cells: the report has the
    // same numbers on any machine.
    PointCells::Nearest best{-1, any.distance + 2.0 * set_.spacing};
    // others that accept lie at most two spacings farther away than the nearest of all
    cells_.visit(p, best.distance, [&](std::int32_t k, double distance) {
        if (distance > best.distance || (distance == best.distance && k > best.index)) return;
        if (accept(k)) best = {k, distance};
    });
    return best.index >= 0 ? best : any;
}

PointCells::Nearest SphereFinder::agreeing(const Vec3& p, const Vec3& normal,
                                           const PointCells::Nearest& any) const {
    return nearest_of(p, any, [&](std::int32_t k) { return agrees(k, normal); });
}

PointCells::Nearest SphereFinder::covering(const Vec3& p, const Vec3& normal,
                                           const PointCells::Nearest& any) const {
    return nearest_of(p, any, [&](std::int32_t k) { return covers(k, normal); });
}

double survey_size(const SphereSet& set, bool half) {
    // A quarter of the spacing finds the places between spheres; for very fine sets the number of
    // samples is bounded, as the percentiles do not need more.
    const double area = set.solid.area * (half ? 0.5 : 1.0);
    return std::max(std::min(set.spacing, 2.0 * set.radius) / 4.0,
                    set.dimension == 2 ? 0.0 : std::sqrt(area / kMostSamples));
}

std::vector<Sight> survey_surface(const SurfaceTree& tree, const SphereSet& set,
                                  const SphereFinder& finder, bool half, bool shares_only) {
    const double size = shares_only ? kShareSize * set.spacing : survey_size(set, half);
    const SurfaceSampler sampler(tree.mesh(), size, set.dimension, half);
    // triangles by the block [-], so that the blocks' sights join in order. Its size sets the time
    // alone.
    constexpr std::size_t kBlock = 64;
    const std::size_t blocks = (sampler.triangle_count() + kBlock - 1) / kBlock;
    std::vector<std::vector<Sight>> found(blocks);
    parallel_tasks(blocks, true, [&](std::size_t b) {
        std::vector<SurfaceSample> samples;
        std::int32_t last = -1;
        const std::size_t end = std::min(sampler.triangle_count(), (b + 1) * kBlock);
        for (std::size_t t = b * kBlock; t < end; ++t) {
            sampler.sample(t, samples);
            for (const SurfaceSample& sample : samples)
                found[b].push_back(look(tree, set, finder, sample, shares_only, last));
        }
    });
    std::vector<Sight> out;
    std::size_t count = 0;
    for (const auto& part : found) count += part.size();
    out.reserve(count);
    for (auto& part : found) {
        out.insert(out.end(), part.begin(), part.end());
        part = {};
    }
    return out;
}

}  // namespace ice
