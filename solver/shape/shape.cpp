// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shape/shape.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "common/base/error.hpp"
#include "solver/shape/sphere_grid.hpp"

namespace ice {

namespace {

// Faces whose normals are this far apart (cosine [-]) meet in a knife edge of less than 20 degrees,
// or are the two sides of a plate as thin as the sphere: that is left round. A tip at r / cos of
// the half angle would lie far outside the sphere. Nearer to -1 keeps sharper tips.
constexpr double kKnife = -0.94;

// Normals whose box product with two others is below this [-], 6 degrees where those are square,
// lie in their plane: an edge, no corner. Smaller makes corners of smooth strips, whose cones are
// needles; larger makes edges of blunt corners.
constexpr double kSamePlane = 0.1;

// Patch radius over the spacing [-]: a little more than the 1 / sqrt(2) by which the places between
// four spheres of a square lattice are off. Smaller leaves such places to no sphere, and contacts
// there are lost; larger compares more spheres and gives a place to more of them.
constexpr double kPatchShare = 0.75;

// A sphere whose nearest neighbour is farther than this many spacings or diameters [-], whichever
// are longer, is alone and tells no spacing. The search hardly looks farther, so that a larger
// value changes nothing; a smaller one makes the patches of thin sets too small.
constexpr double kAlone = 3.0;

// The mesh as the water's kernels read it, eight triangles beside each other.
FacetBlocks facets_of(const TriangleMesh& mesh) {
    std::vector<Facet> facets;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        facets.push_back(make_facet(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)));
    return FacetBlocks(facets);
}

// Of the normals that meet at a sphere three at most: the two farthest apart and the one farthest
// out of their plane. Edges of smooth strips list many that lie between these.
NormalCone outermost_faces(const std::vector<Vec3>& normals) {
    if (normals.size() < 2) return {};
    // any third normal must leave the plane of the first two by kSamePlane to make a vertex
    double least = 2.0, most = kSamePlane;
    std::array<Vec3, 3> out{normals[0], normals[1], Vec3::Zero()};
    std::size_t count = 2;
    for (std::size_t i = 0; i < normals.size(); ++i)
        for (std::size_t j = i + 1; j < normals.size(); ++j)
            if (normals[i].dot(normals[j]) < least) {
                least = normals[i].dot(normals[j]);
                out[0] = normals[i];
                out[1] = normals[j];
            }
    // faces nearly back to back: a knife, which counts as round
    if (least < kKnife) return {};
    const Vec3 across = out[0].cross(out[1]);
    for (const Vec3& n : normals)
        if (std::abs(n.dot(across)) > most) {
            most = std::abs(n.dot(across));
            out[2] = n;
            count = 3;
        }
    return NormalCone::meeting({out.data(), count});
}

std::vector<NormalCone> meeting_faces(const SphereSet& set) {
    std::vector<std::vector<Vec3>> normals(set.surface_count);
    for (const CreaseNormal& c : set.creases)
        normals[static_cast<std::size_t>(c.sphere)].push_back(c.normal);
    std::vector<NormalCone> out;
    for (std::size_t k = 0; k < set.surface_count; ++k) {
        NormalCone faces = outermost_faces(normals[k]);
        // the tip along the middle normal lies behind all planes: the plane whose normal is nearest
        // to it ends it first, at r / cos of the smallest angle
        double nearest = 0.0;
        for (const Vec3& n : normals[k]) nearest = std::max(nearest, n.dot(set.normals[k]));
        faces.apex_distance =
            faces.count > 0 && nearest > 0.0 ? set.radii[k] / nearest : set.radii[k];
        faces.tangent_extent = std::sqrt(
            std::max(0.0, faces.apex_distance * faces.apex_distance - set.radii[k] * set.radii[k]));
        out.push_back(faces);
    }
    return out;
}

void copy_surface_spheres(const SphereSet& set, const Vec3& origin, Shape& shape) {
    shape.cone = meeting_faces(set);
    for (std::size_t k = 0; k < set.surface_count; ++k) {
        shape.center.push_back(set.centers[k] - origin);
        shape.radius.push_back(set.radii[k]);
        shape.normal.push_back(set.normals[k]);
        // rounded to float: the last bit of cos differs between systems' libraries, a run must not
        const double cosine = static_cast<float>(std::cos(set.normal_spread[k]));
        shape.spread_cos.push_back(cosine);
        shape.spread_sin.push_back(std::sqrt(1.0 - cosine * cosine));
        shape.area.push_back(set.areas[k]);
        shape.largest_radius = std::max(shape.largest_radius, set.radii[k]);
    }
}

// Numbers the feature types by their first spheres. Pairs of types share their separating axes, so
// that a box floe of 240 spheres has 26 types (docs/design-notes.md).
void number_feature_types(Shape& shape) {
    std::map<std::array<double, 18>, std::int32_t> known;
    for (std::size_t k = 0; k < shape.center.size(); ++k) {
        const NormalCone& faces = shape.cone[k];
        // A feature type is everything but the place: equal bits, as copies along an edge have
        // them.
        std::array<double, 18> key{shape.radius[k], shape.spread_cos[k], faces.apex_distance,
                                   faces.tangent_extent, static_cast<double>(faces.count)};
        auto to = key.begin() + 5;
        for (int d = 0; d < 3; ++d) *to++ = shape.normal[k][d];
        for (const Vec3& n : faces.normal)
            for (int d = 0; d < 3; ++d) *to++ = n[d];
        const auto next = static_cast<std::int32_t>(known.size());
        shape.feature_type.push_back(known.try_emplace(key, next).first->second);
    }
    shape.feature_types = known.size();
}

void rank_places(Shape& shape) {
    const std::vector<Vec3>& at = shape.center;
    const auto place = [&](std::int32_t k) {
        return std::tuple(at[k].x(), std::abs(at[k].y()), at[k].z());
    };
    // Mirror images about y = 0 share a rank, so that an order by ranks treats them alike.
    std::vector<std::int32_t> order(at.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](std::int32_t l, std::int32_t r) { return place(l) < place(r); });
    shape.mirror_rank.assign(at.size(), 0);
    for (std::size_t k = 1; k < order.size(); ++k)
        shape.mirror_rank[order[k]] =
            shape.mirror_rank[order[k - 1]] + (place(order[k - 1]) < place(order[k]) ? 1 : 0);
}

// The largest distance from a surface sphere to its nearest neighbour is the set's real spacing s.
// A square lattice leaves points s / sqrt(2) from every sphere, a hexagonal one s / sqrt(3). On a
// thin plate the nearest is across the thickness: along the edges they are the nominal apart.
double measure_patch_radius(const Shape& shape, double nominal_spacing) {
    const double limit = kAlone * std::max(nominal_spacing, 2.0 * shape.largest_radius);
    const SphereGrid grid(shape.center, 2.0 * shape.largest_radius);
    double spacing = 0.0;
    for (std::size_t k = 0; k < shape.center.size(); ++k) {
        double nearest = limit;
        grid.for_each_near(shape.center[k], nominal_spacing, [&](std::int32_t other) {
            const double distance = (shape.center[other] - shape.center[k]).norm();
            if (static_cast<std::size_t>(other) != k) nearest = std::min(nearest, distance);
        });
        if (nearest < limit) spacing = std::max(spacing, nearest);
    }
    return kPatchShare * std::max(spacing, nominal_spacing);
}

}  // namespace

Shape build_shape(const SphereSet& set, bool about_centre_of_mass) {
    Shape shape;
    const Vec3 origin = about_centre_of_mass ? set.solid.centroid : Vec3::Zero();
    shape.dimension = set.dimension;
    shape.sphere_count = set.size();
    shape.region = FaceRegions(set);
    shape.region_names = set.mesh.region_names;
    copy_surface_spheres(set, origin, shape);
    number_feature_types(shape);
    rank_places(shape);
    if (shape.center.empty())
        throw bad_input(set.source_mesh, "the sphere set has no surface spheres",
                        "make it again with spherize");

    // the mesh and everything derived from it about the centre of mass, the hull's about its
    // origin
    shape.mesh = set.mesh;
    for (Vec3& v : shape.mesh.vertices) v -= origin;
    shape.solid = set.solid;
    shape.solid.centroid -= origin;

    for (const Vec3& v : shape.mesh.vertices) shape.box.extend(v);
    for (std::size_t k = 0; k < shape.center.size(); ++k) {
        shape.box.extend(shape.center[k] + Vec3::Constant(shape.radius[k]));
        shape.box.extend(shape.center[k] - Vec3::Constant(shape.radius[k]));
    }
    if (set.dimension == 2) {
        // discs are spheres in the plane; the prism's breadth must not widen searches
        shape.box.min().y() = -shape.largest_radius;
        shape.box.max().y() = shape.largest_radius;
    }
    shape.bounding_radius = shape.box.min().cwiseAbs().cwiseMax(shape.box.max().cwiseAbs()).norm();
    std::vector<BoundedSphere> bounded;
    for (std::size_t k = 0; k < shape.center.size(); ++k) {
        bounded.push_back({shape.center[k], shape.radius[k]});
        // the edges of a chamfer narrower than the sphere are one sharp edge, outside the mesh
        if (shape.cone[k].count > 0)
            bounded.back().tip = shape.cone[k].apex_distance * shape.normal[k];
    }
    shape.bounds = ConvexBounds(shape.mesh, bounded);
    if (set.dimension == 3) shape.convex = make_convex_piece(shape.mesh);
    shape.spacing = set.spacing;
    shape.patch_radius = measure_patch_radius(shape, set.spacing);
    shape.side_planes = SidePlanes(shape);
    std::vector<SearchSphere> spheres, balls;
    for (NormalCone& faces : shape.cone)  // half the part of an edge that its sphere represents
        if (faces.count > 0) faces.tangent_extent += 0.5 * shape.patch_radius;
    for (std::size_t k = 0; k < shape.center.size(); ++k) {
        spheres.push_back(
            {shape.center[k], shape.cone[k].apex_distance, shape.cone[k].tangent_extent});
        balls.push_back({shape.center[k], shape.radius[k], 0.0});
    }
    shape.blocks = SphereBlocks(spheres);
    shape.balls = SphereBlocks(balls);
    shape.facets = facets_of(shape.mesh);
    shape.surface = std::make_shared<const SolidSurface>(shape.mesh);
    if (about_centre_of_mass) shape.edges = find_edges(shape.mesh);
    return shape;
}

}  // namespace ice
