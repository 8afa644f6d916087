// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/fill_spheres.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.hpp"
#include "common/base/timer.hpp"
#include "common/formats/hexagonal_layer.hpp"
#include "preprocess/fill/corners.hpp"
#include "preprocess/fill/drop_outside.hpp"
#include "preprocess/fill/inscribed.hpp"
#include "preprocess/fill/lattice.hpp"
#include "preprocess/fill/make_layer.hpp"
#include "preprocess/fill/measure_certificate.hpp"
#include "preprocess/fill/shares.hpp"
#include "preprocess/fill/twins.hpp"
#include "preprocess/measure/mirror_symmetry.hpp"

namespace ice {

namespace {

// Distance of the volume shares' centroid from the solid's [radii] that is worth a warning: above
// rounding, far below any effect on a moment. A larger value leaves wrong shares unsaid, a smaller
// one warns of rounding.
constexpr double kCentroidMiss = 1e-6;
// Between the points that edges are followed by [spacings]. Curved edges need several per sphere;
// more take longer.
constexpr double kLineStep = 0.2;
// The same for floes by the thousand (FillOptions::quick), whose edges are straight. A larger value
// follows the arcs of cusps less closely, a smaller one takes longer for each floe.
constexpr double kQuickStep = 0.5;
// Share of the radius [-] by which the largest sphere inside may be smaller: a sphere that just
// fits is found to rounding only. A larger value begins fills in which no sphere fits, a smaller
// one refuses a sphere that just does.
constexpr double kSettled = 1e-6;
// Spheres of a set at most [-]: 250 bytes each while they are made, 7.5 GB. More is a wrong unit
// more often than a wish. A larger value may run out of memory, a smaller one refuses fine sets
// that have room.
constexpr double kMostSpheres = 3e7;

void tell(const FillOptions& o, const char* step, double share = 0.0) {
    if (o.progress) o.progress(step, share);
}

// Before minutes go into a layer that stays empty.
void refuse_too_large(const SurfaceTree& tree, int dimension, double radius) {
    const Inscribed largest = find_inscribed(tree, dimension, radius);
    if (largest.bound >= radius * (1.0 - kSettled)) return;
    throw bad_input("--radius",
                    fmt::format("no {} of radius {:g} m fits into the solid",
                                dimension == 2 ? "disc" : "sphere", radius),
                    fmt::format("the largest that fits has {:.3g} m; use less", largest.radius));
}

// An absurd number of spheres is a wrong unit more often than a wish.
void refuse_too_many(const SphereSet& set, const FillOptions& o) {
    const double wide = 2.0 * o.radius;
    const bool flat = set.dimension == 2;
    // two radii apart on a square lattice: fewer than the close packing has
    double count =
        flat ? set.solid.volume / (wide * wide) : set.solid.volume / (wide * wide * wide);
    if (o.surface_only) count = 0.0;
    if (o.arrangement == Arrangement::conforming && !flat)
        count += kHexagonal * set.solid.area / (set.spacing * set.spacing);
    // the outline is a slab's area without its two ends; it is followed by five points a disc
    if (o.arrangement == Arrangement::conforming && flat)
        count += 5.0 * (set.solid.area - 2.0 * set.solid.volume) / set.spacing;
    if (count < kMostSpheres) return;
    Eigen::AlignedBox3d box;
    for (const Vec3& v : set.mesh.vertices) box.extend(v);
    throw bad_input("--radius",
                    fmt::format("a solid of {:.5g} x {:.5g} x {:.5g} m would take about {:.1g} "
                                "spheres of {:g} m",
                                box.sizes().x(), box.sizes().y(), box.sizes().z(), count, o.radius),
                    "if the mesh is in millimetres give --units mm; else use a larger radius");
}

// Surface spheres of a lattice: those with a neighbour missing.
void place_lattice(const SurfaceTree& tree, const FillOptions& o, bool mirror, SphereSet& set) {
    const Lattice lattice = fill_lattice(tree, o.radius, o.radius, set.dimension, mirror);
    for (const std::uint8_t outer : {std::uint8_t{1}, std::uint8_t{0}}) {
        if (outer == 0) set.surface_count = set.size();
        if (outer == 0 && o.surface_only) break;
        for (std::size_t k = 0; k < lattice.centers.size(); ++k)
            if (lattice.outer[k] == outer) set.centers.push_back(lattice.centers[k]);
    }
}

void place_surface(const SurfaceTree& tree, const FillOptions& o, bool mirror, SphereSet& set,
                   SpheresReport& report) {
    const Timer timer;
    if (o.arrangement == Arrangement::lattice) {
        place_lattice(tree, o, mirror, set);
    } else {
        // A lattice is the paper's arrangement; the layer follows edges and corners, and each of
        // its spheres touches the surface.
        set.centers = make_layer(tree, {o.radius, set.spacing, set.dimension, mirror,
                                        o.quick ? kQuickStep : kLineStep, o.sharp, o.edges_by_ends,
                                        [&](double share) { tell(o, "surface layer", share); }});
        if (set.dimension == 3 && !o.quick)
            report.outside_dropped = drop_outside(tree.mesh(), o.radius, set.centers);
        set.surface_count = set.size();
    }
    report.seconds["surface_layer"] = timer.seconds();
    if (set.surface_count == 0)
        throw bad_input("--radius",
                        fmt::format("no sphere of radius {:g} m fits into the solid", o.radius),
                        fmt::format("the largest that fits has {:.3g} m; use less",
                                    find_inscribed(tree, set.dimension).radius));
}

// Volume of an interior sphere's cell: hexagonal close packing, in 2D squares.
double place_interior(const SurfaceTree& tree, const FillOptions& o, bool mirror, SphereSet& set,
                      SpheresReport& report) {
    const double r = o.radius;
    const bool flat = set.dimension == 2;
    const double cell = flat ? 4.0 * r * r : 4.0 * std::numbers::sqrt2 * r * r * r;
    if (o.arrangement == Arrangement::lattice) return 0.0;
    if (o.surface_only) return cell;
    const Timer timer;
    const LatticeFill fill = fill_lattice_rows(
        tree.mesh(),
        {flat ? LatticeKind::cubic : LatticeKind::hexagonal, r, r, set.dimension, mirror});
    set.centers.resize(set.surface_count + fill.count);
    expand(fill, std::span(set.centers).subspan(set.surface_count));
    report.seconds["interior"] = timer.seconds();
    return cell;
}

void fill_report(const SphereSet& set, SpheresReport& report) {
    report.dimension = set.dimension;
    report.radius = set.radius;
    report.spacing = set.spacing;
    report.spheres = static_cast<std::int64_t>(set.size());
    report.surface_spheres = static_cast<std::int64_t>(set.surface_count);
    report.volume = set.solid.volume;
    report.area = set.solid.area;
    // a sum that is zero but for rounding is reported as zero
    const double rounding = 1e-14 * std::cbrt(set.solid.volume);
    for (int d = 0; d < 3; ++d)
        report.centroid[static_cast<std::size_t>(d)] =
            std::abs(set.solid.centroid[d]) < rounding ? 0.0 : set.solid.centroid[d];
    const Mat3& i = set.solid.inertia;
    report.inertia_unit_density = {i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2)};
}

// Normals of the surface spheres, and a sphere in each corner that the layer left empty; once more
// for these. A lattice's spheres touch a feature by chance only, so that none is added.
// @return the twins
std::vector<std::int32_t> set_features(const SurfaceTree& tree, const FillOptions& o, bool mirror,
                                       SphereSet& set, SpheresReport& report) {
    std::vector<std::int32_t> twins;
    CornerCount corners;
    // Twice at most: added spheres change the features of their neighbours, so all are set anew. A
    // corner that is still empty then is reported, not filled again, since that need not end.
    for (const bool may_add : {true, false}) {
        if (mirror) twins = find_twins(set);
        set_normals(tree, twins, set);
        if (set.dimension == 2 || o.arrangement == Arrangement::lattice) return twins;
        corners = count_corners(tree, set, mirror);
        if (corners.blind.empty() || !may_add) break;
        set.centers.insert(set.centers.end(), corners.blind.begin(), corners.blind.end());
        set.surface_count = set.size();
        set.radii.assign(set.size(), o.radius);
    }
    report.corners = corners.all;
    report.blind_corners = static_cast<std::int64_t>(corners.blind.size());
    if (!corners.blind.empty())
        report.warnings.push_back(fmt::format(
            "{} of {} corners have no sphere whose feature has their three faces: a contact there "
            "begins late; try another radius or spacing",
            corners.blind.size(), corners.all));
    return twins;
}

// `space` is the body that spheres are placed in: the solid, or in 2D the section widened along y.
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
    const Timer timer;
    const SurfaceTree tree(space);
    const bool mirror = dimension == 3 && is_mirror_symmetric(tree);
    report.seconds["tree"] = timer.seconds();
    if (!o.quick) refuse_too_large(tree, dimension, o.radius);
    place_surface(tree, o, mirror, set, report);
    set.radii.assign(set.size(), o.radius);

    tell(o, "certificate");
    const Timer measuring;
    // Order matters: normals before shares, because a sample belongs to a sphere that agrees
    // with its normal; surface before interior, because the interior's cells leave the rest of
    // the volume to the surface.
    const std::vector<std::int32_t> twins = set_features(tree, o, mirror, set, report);
    const SphereFinder finder(set);
    const std::vector<Sight> sights = survey_surface(tree, set, finder, mirror, o.quick);
    share_surface(tree, sights, twins, set);
    report.seconds["shares"] = measuring.seconds();
    if (!o.quick) measure_certificate(tree, finder, sights, mirror, set, report);
    report.seconds["certificate"] = measuring.seconds() - report.seconds["shares"];

    tell(o, "interior");
    const double cell = place_interior(tree, o, mirror, set, report);
    const Timer sharing;
    set.radii.resize(set.size(), o.radius);
    const double miss = share_volume(cell, mirror, set);
    if (!(miss <= kCentroidMiss * o.radius))
        report.warnings.push_back(fmt::format(
            "the volume shares miss the centroid by {:.3g} m: too few spheres to represent the "
            "volume; mass and inertia are exact all the same",
            miss));
    report.seconds["shares"] += sharing.seconds();
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
    // the section's prism made so long that its ends are never the nearest face
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
