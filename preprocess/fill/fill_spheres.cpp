// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/fill_spheres.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/base/timer.hpp"
#include "preprocess/fill/certificate.hpp"
#include "preprocess/fill/lattice.hpp"
#include "preprocess/fill/mirror_shares.hpp"
#include "preprocess/fill/shares.hpp"
#include "preprocess/fill/shell.hpp"

namespace ice {

namespace {

// Volume shares whose centroid is off by more than this many radii are worth a warning.
constexpr double kCentroidMiss = 1e-6;
constexpr double kMostSpheres = 3e7;  // 250 bytes each while they are made

// Radius of the largest sphere found inside [m]: the deepest point of a coarse grid, then uphill.
double inscribed_radius(const SurfaceTree& tree, int dimension) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : tree.mesh().vertices) box.extend(v);
    constexpr int kPoints = 24;
    Vec3 best = box.center();
    double depth = 0.0;
    const auto depth_at = [&](const Vec3& p) {
        const Foot foot = tree.closest(p);
        return foot.inside ? foot.distance : -foot.distance;
    };
    for (int k = 0; k < kPoints * kPoints * kPoints; ++k) {
        Vec3 p = box.min() +
                 box.sizes().cwiseProduct(Vec3(k % kPoints + 0.5, k / kPoints % kPoints + 0.5,
                                               k / (kPoints * kPoints) + 0.5)) /
                     kPoints;
        if (dimension == 2) p.y() = 0.0;
        if (const double now = depth_at(p); now > depth) {
            depth = now;
            best = p;
        }
    }
    for (double step = 0.5 * box.sizes().maxCoeff() / kPoints; step > 1e-4 * depth; step *= 0.5)
        for (int d = 0; d < 6; ++d) {
            const Vec3 p = best + (d % 2 ? step : -step) * Vec3::Unit(d / 2);
            if (dimension == 2 && d / 2 == 1) continue;
            if (const double now = depth_at(p); now > depth) {
                depth = now;
                best = p;
            }
        }
    return depth;
}

// An absurd number of spheres is a wrong unit more often than a wish.
void refuse_too_many(const SphereSet& set, const FillOptions& o) {
    const double wide = 2.0 * o.radius;
    const bool flat = set.dimension == 2;
    double count =
        flat ? set.solid.volume / (wide * wide) : set.solid.volume / (wide * wide * wide);
    if (o.surface_only) count = 0.0;
    if (o.arrangement == Arrangement::conforming && !flat)
        count += 1.155 * set.solid.area / (set.spacing * set.spacing);  // a hexagonal layer
    if (count < kMostSpheres) return;
    Eigen::AlignedBox3d box;
    for (const Vec3& v : set.mesh.vertices) box.extend(v);
    throw bad_input("--radius",
                    fmt::format("a solid of {:.5g} x {:.5g} x {:.5g} m would take about {:.1g} "
                                "spheres of {:g} m",
                                box.sizes().x(), box.sizes().y(), box.sizes().z(), count, o.radius),
                    "if the mesh is in millimetres give --units mm; else use a larger radius");
}

void add_spheres(SphereSet& set, const std::vector<Vec3>& centers, std::uint8_t layer) {
    set.centers.insert(set.centers.end(), centers.begin(), centers.end());
    set.layers.insert(set.layers.end(), centers.size(), layer);
}

void place(const SurfaceTree& tree, const std::vector<SurfaceSample>& samples, const FillOptions& o,
           bool mirror, SphereSet& set, SpheresReport& report) {
    const Timer timer;
    if (o.arrangement == Arrangement::lattice) {
        const Lattice lattice = fill_lattice(tree, o.radius, o.radius, set.dimension, mirror);
        for (const std::uint8_t outer : {std::uint8_t{1}, std::uint8_t{0}}) {
            std::vector<Vec3> part;
            for (std::size_t k = 0; k < lattice.centers.size(); ++k)
                if (lattice.outer[k] == outer) part.push_back(lattice.centers[k]);
            if (outer == 1 || !o.surface_only) add_spheres(set, part, outer);
        }
        report.seconds["lattice"] = timer.seconds();
        return;
    }
    add_spheres(set, make_shell(tree, samples, {o.radius, set.spacing, set.dimension, mirror}), 1);
    report.seconds["surface_layer"] = timer.seconds();
    if (o.surface_only) return;
    add_spheres(set, fill_lattice(tree, o.radius, 2.0 * o.radius, set.dimension, mirror).centers,
                0);
    report.seconds["interior"] = timer.seconds() - report.seconds["surface_layer"];
}

void fill_report(const SphereSet& set, SpheresReport& report) {
    report.dimension = set.dimension;
    report.radius = set.radius;
    report.spacing = set.spacing;
    report.spheres = static_cast<std::int64_t>(set.size());
    report.surface_spheres = std::count(set.layers.begin(), set.layers.end(), std::uint8_t{1});
    report.volume = set.solid.volume;
    report.area = set.solid.area;
    report.centroid = {set.solid.centroid.x(), set.solid.centroid.y(), set.solid.centroid.z()};
    const Mat3& i = set.solid.inertia;
    report.inertia_unit_density = {i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2)};
}

// `space` is what spheres are placed in: the solid, or in 2D the section widened along y.
SphereSet fill(const TriangleMesh& solid, const TriangleMesh& space, int dimension,
               const FillOptions& o, SpheresReport& report) {
    SphereSet set;
    set.dimension = dimension;
    set.radius = o.radius;
    set.spacing = o.arrangement == Arrangement::lattice ? 2.0 * o.radius
                  : o.spacing > 0.0                     ? o.spacing
                                                        : o.radius;
    set.mode = o.surface_only ? "surface" : "fill";
    set.mesh = solid;
    set.solid = measure_mass(solid);

    refuse_too_many(set, o);
    const SurfaceTree tree(space);
    const bool mirror = dimension == 3 && is_mirror_symmetric(tree);
    const auto samples =
        sample_surface(space, std::min(set.spacing, 2.0 * o.radius) / 4.0, dimension);
    place(tree, samples, o, mirror, set, report);
    if (set.centers.empty() || set.layers.front() == 0)
        throw bad_input("--radius",
                        fmt::format("no sphere of radius {:g} m fits into the solid", o.radius),
                        fmt::format("the largest that fits has {:.3g} m; use less",
                                    inscribed_radius(tree, dimension)));
    set.radii.assign(set.size(), o.radius);

    const Timer timer;
    share_surface(tree, samples, set);
    const double miss = share_volume(tree, o.arrangement == Arrangement::lattice, set);
    if (!(miss <= kCentroidMiss * o.radius))
        report.warnings.push_back(fmt::format(
            "the volume shares miss the centroid by {:.3g} m: too few spheres to stand for the "
            "volume; mass and inertia are exact all the same",
            miss));
    if (mirror) mirror_shares(set);
    report.seconds["shares"] = timer.seconds();
    certify(tree, samples, set, report);
    report.seconds["certificate"] = timer.seconds() - report.seconds["shares"];
    fill_report(set, report);
    return set;
}

}  // namespace

SphereSet fill_spheres(const TriangleMesh& solid, const FillOptions& options,
                       SpheresReport& report) {
    return fill(solid, solid, 3, options, report);
}

SphereSet fill_discs(const Section& section, const std::vector<std::string>& region_names,
                     const FillOptions& options, SpheresReport& report) {
    const TriangleMesh solid = extrude(section, region_names);
    // the flat ends must be farther away than the section is deep: they bound no disc
    TriangleMesh space = solid;
    Eigen::AlignedBox3d box;
    for (const Vec3& v : solid.vertices) box.extend(v);
    for (Vec3& v : space.vertices) v.y() *= 2.0 * box.diagonal().norm() + 10.0 * options.radius;
    SphereSet set = fill(solid, space, 2, options, report);
    // surface of the section per metre: its outline, without the ends
    set.solid.area = 0.0;
    for (const auto& loop : section.loops)
        for (const SectionEdge& edge : loop) set.solid.area += (edge.b - edge.a).norm();
    report.area = set.solid.area;
    return set;
}

}  // namespace ice
