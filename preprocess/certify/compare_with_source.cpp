// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/certify/compare_with_source.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/base/parallel.hpp"
#include "common/geometry/edge_table.hpp"
#include "common/geometry/surface_tree.hpp"
#include "preprocess/certify/shared_triangles.hpp"
#include "preprocess/clean/find_parts.hpp"
#include "preprocess/clean/weld.hpp"
#include "preprocess/fill/surface_samples.hpp"

namespace ice {

namespace {

// Samples beyond one per triangle at most [-]: the 99th percentile needs no more. More find a
// larger maximum on coarse triangles and take longer.
constexpr double kMostSamples = 4e5;
// Distance over the size [-] up to which a vertex is on the surface: weld() merges such vertices. A
// larger value takes more of the solid's triangles for caps of openings; with a smaller one, caps
// whose vertices were merged count as distance from the mesh.
constexpr double kOnSurface = 1e-6;
// Distance over the size [-] that counts as zero: rounding of computed coordinates. A larger value
// hides true distances; with a smaller one, rounding is reported as a distance.
constexpr double kRounding = 1e-12;
// Share of a part's area [-] away from the solid from which the part bounds nothing of it. A larger
// value leaves fewer parts out of the comparison, so that its largest distance grows; a smaller one
// leaves out parts that lie mostly in the solid.
constexpr double kMostlyAway = 0.5;

// A piece of one surface and how far the other is.
struct Probe {
    Vec3 at = Vec3::Zero();
    double area = 0.0, distance = 0.0;
    std::int32_t triangle = -1;
};

struct Probed {
    std::vector<Probe> probes;  // of triangles that the other has not
    double equal_area = 0.0, equal_area_in_belt = 0.0;
};

// Samples of the triangles that are not shared; shared ones only add their area.
Probed take_samples(const TriangleMesh& mesh, const std::vector<std::uint8_t>& shared, double size,
                    const IceBelt& belt) {
    const SurfaceSampler sampler(mesh, size, 3);
    Probed out;
    std::vector<SurfaceSample> samples;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        sampler.sample(t, samples);
        for (const SurfaceSample& s : samples) {
            // Triangles that both meshes have lie at distance 0: a search would only confirm it.
            if (shared[t] == 0) {
                out.probes.push_back({s.point, s.area, 0.0, s.triangle});
                continue;
            }
            out.equal_area += s.area;
            if (belt.contains(s.point.z())) out.equal_area_in_belt += s.area;
        }
    }
    return out;
}

double sample_size(const TriangleMesh& mesh, double radius) {
    double area = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += mesh.area_vector(t).norm();
    // half a radius apart, or as many as the bound allows on a large surface
    return std::max(0.5 * radius, std::sqrt(area / kMostSamples));
}

// By share of the area, the equal one included.
SurfaceDistance summarize(std::vector<Probe> probes, double equal_area) {
    SurfaceDistance out;
    std::sort(probes.begin(), probes.end(), [](const Probe& l, const Probe& r) {
        return l.distance < r.distance || (l.distance == r.distance && l.triangle < r.triangle);
    });
    double total = equal_area;
    for (const Probe& p : probes) total += p.area;
    double sum = equal_area;
    for (const Probe& p : probes) {
        sum += p.area;
        // the distance at which the sum of the area passes the half, and 99 %
        if (sum - p.area < 0.5 * total && sum >= 0.5 * total) out.p50 = p.distance;
        if (sum - p.area < 0.99 * total && sum >= 0.99 * total) out.p99 = p.distance;
    }
    if (probes.empty()) return out;
    out.max = probes.back().distance;
    if (out.max > 0.0) out.at = {probes.back().at.x(), probes.back().at.y(), probes.back().at.z()};
    return out;
}

SurfaceDistance summarize_belt(const Probed& probed, const IceBelt& belt) {
    std::vector<Probe> inside;
    for (const Probe& p : probed.probes)
        if (belt.contains(p.at.z())) inside.push_back(p);
    return summarize(std::move(inside), probed.equal_area_in_belt);
}

// Parts of the source that bound nothing: most of their area is away from the solid, and they are
// open, or around all of it.
class LeftOut {
public:
    LeftOut(const TriangleMesh& source, const Eigen::AlignedBox3d& solid) : mesh_(source) {
        weld(mesh_);  // the triangles' order is kept, some are dropped
        parts_ = find_parts(mesh_);
        const auto count = static_cast<std::size_t>(parts_.count);
        area_.assign(count, 0.0);
        std::vector<Eigen::AlignedBox3d> boxes(count);
        std::vector<std::uint8_t> open(count, 0);
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            const auto part = static_cast<std::size_t>(parts_.of_triangle[t]);
            area_[part] += mesh_.area_vector(t).norm();
            for (int k = 0; k < 3; ++k) boxes[part].extend(mesh_.corner(t, k));
        }
        for (const MeshEdge& edge : edge_table(mesh_))
            if (edge.count == 1 && edge.triangles[0] >= 0)
                open[static_cast<std::size_t>(
                    parts_.of_triangle[static_cast<std::size_t>(edge.triangles[0])])] = 1;
        candidate_.assign(count, 0);
        for (std::size_t p = 0; p < count; ++p)
            candidate_[p] = open[p] != 0 ||
                            // a box around the solid with far more volume is a tank
                            (boxes[p].contains(solid) && boxes[p].volume() > 2.0 * solid.volume());
    }

    // Drops the probes of such parts; `part_of` finds a probe's part by its triangle's corners.
    void remove(const TriangleMesh& source, double radius, std::vector<Probe>& probes,
                SourceCheck& check) const {
        if (std::none_of(candidate_.begin(), candidate_.end(), [](auto c) { return c != 0; }))
            return;
        const PlacedVertices places(mesh_, kOnSurface);
        std::vector<std::int32_t> vertex_part(mesh_.vertices.size(), -1);
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
            for (const std::int32_t v : mesh_.triangles[t])
                vertex_part[static_cast<std::size_t>(v)] = parts_.of_triangle[t];
        std::vector<std::int32_t> part(probes.size(), -1);
        std::vector<double> away(area_.size(), 0.0), here(area_.size(), 0.0);
        for (std::size_t k = 0; k < probes.size(); ++k) {
            const auto t = static_cast<std::size_t>(probes[k].triangle);
            const std::int32_t v = places.find(source.corner(t, 0));
            if (v < 0) continue;
            part[k] = vertex_part[static_cast<std::size_t>(v)];
            if (part[k] < 0) continue;
            // area off the solid by more than a radius, and area on it
            auto& sum = probes[k].distance > radius ? away : here;
            sum[static_cast<std::size_t>(part[k])] += probes[k].area;
        }
        std::size_t kept = 0;
        for (std::size_t k = 0; k < probes.size(); ++k) {
            const auto p = static_cast<std::size_t>(std::max(part[k], 0));
            // triangles without probes are shared with the solid
            if (part[k] >= 0 && candidate_[p] != 0 && away[p] > kMostlyAway * area_[p]) {
                if (check.left_out_area == 0.0)
                    check.left_out_at = {probes[k].at.x(), probes[k].at.y(), probes[k].at.z()};
                check.left_out_area += probes[k].area;
                continue;
            }
            probes[kept++] = probes[k];
        }
        probes.resize(kept);
    }

private:
    TriangleMesh mesh_;
    Parts parts_;
    std::vector<double> area_;
    std::vector<std::uint8_t> candidate_;
};

Eigen::AlignedBox3d box_around(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const auto& t : mesh.triangles)
        for (const std::int32_t v : t) box.extend(mesh.vertices[static_cast<std::size_t>(v)]);
    return box;
}

// From the source's outside to the solid.
void probe_source(const TriangleMesh& solid, double radius, std::vector<Probe>& probes) {
    const SurfaceTree tree(solid);
    const double rounding = kRounding * box_around(solid).diagonal().norm();
    std::vector<std::uint8_t> hidden(probes.size(), 0);
    parallel_for(probes.size(), 256, [&](std::size_t k) {
        const Foot foot = tree.closest(probes[k].at);
        probes[k].distance = foot.distance > rounding ? foot.distance : 0.0;
        // deeper inside than a radius: inner skins and bulkheads, which are no outside
        hidden[k] = foot.inside && foot.distance > radius;
    });
    std::size_t kept = 0;
    for (std::size_t k = 0; k < probes.size(); ++k)
        if (hidden[k] == 0) probes[kept++] = probes[k];
    probes.resize(kept);
}

// From the solid to the source; caps are taken out.
void probe_solid(const TriangleMesh& source, const TriangleMesh& solid, std::vector<Probe>& probes,
                 SourceCheck& check) {
    const SurfaceTree tree(source);
    const double on = kOnSurface * box_around(solid).diagonal().norm();
    const auto is_vertex = [&](const Vec3& p) {
        const auto nearest = static_cast<std::size_t>(tree.closest(p).triangle);
        return (source.corner(nearest, 0) - p).norm() <= on ||
               (source.corner(nearest, 1) - p).norm() <= on ||
               (source.corner(nearest, 2) - p).norm() <= on;
    };
    std::vector<std::uint8_t> cap(probes.size(), 0);
    parallel_for(probes.size(), 256, [&](std::size_t k) {
        Probe& probe = probes[k];
        probe.distance = tree.closest(probe.at).distance;
        if (probe.distance <= kRounding / kOnSurface * on) probe.distance = 0.0;
        if (probe.distance <= on) return;
        const auto t = static_cast<std::size_t>(probe.triangle);
        // A triangle off the source with all corners in vertices of the source closes an opening: a
        // cap.
        cap[k] = 1;
        for (int c = 0; c < 3; ++c)
            if (!is_vertex(solid.corner(t, c))) cap[k] = 0;
    });
    std::size_t kept = 0;
    for (std::size_t k = 0; k < probes.size(); ++k) {
        if (cap[k] != 0)
            check.caps_area += probes[k].area;
        else
            probes[kept++] = probes[k];
    }
    probes.resize(kept);
}

}  // namespace

void compare_with_source(const TriangleMesh& source, const TriangleMesh& solid, double radius,
                         SpheresReport& report) {
    SourceCheck& check = report.source;
    check = {};
    check.known = true;
    for (std::size_t t = 0; t < source.triangles.size(); ++t)
        check.area += source.area_vector(t).norm();
    // Both directions: a part that repairs removed is far from the solid but leaves the solid near
    // the source; one that they added is seen from the solid only.
    // equal triangles have equal bits: only the others need be measured
    const PlacedVertices in_solid(solid, 0.0), in_source(source, 0.0);
    const double size = std::max(sample_size(source, radius), sample_size(solid, radius));
    Probed from_source =
        take_samples(source, shared_triangles(source, solid, in_solid), size, report.belt);
    Probed from_solid =
        take_samples(solid, shared_triangles(solid, source, in_source), size, report.belt);
    if (!from_source.probes.empty()) {
        probe_source(solid, radius, from_source.probes);
        const bool far = std::any_of(from_source.probes.begin(), from_source.probes.end(),
                                     [&](const Probe& p) { return p.distance > radius; });
        if (far)
            LeftOut(source, box_around(solid)).remove(source, radius, from_source.probes, check);
    }
    if (!from_solid.probes.empty()) probe_solid(source, solid, from_solid.probes, check);
    if (report.belt) {
        report.belt.to_solid = summarize_belt(from_source, report.belt);
        report.belt.to_source = summarize_belt(from_solid, report.belt);
    }
    check.to_solid = summarize(std::move(from_source.probes), from_source.equal_area);
    check.to_source = summarize(std::move(from_solid.probes), from_solid.equal_area);
}

}  // namespace ice
