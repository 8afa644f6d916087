// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "common/formats/sphere_set.hpp"
#include "common/formats/spheres_report.hpp"
#include "preprocess/slice/slice_solid.hpp"

namespace ice {

/// Arrangement of the spheres: a layer that touches the surface and a packing inside, or one
/// lattice.
enum class Arrangement { conforming, lattice };

/// How a solid is filled.
struct FillOptions {
    double radius = 0.1;   ///< [m]
    double spacing = 0.0;  ///< of the surface layer [m]; 0: the radius (lattice: 2 R always)
    Arrangement arrangement = Arrangement::conforming;
    bool surface_only = false;  ///< drop the interior
    /// For flat-faced solids by the thousand: no certificate, shares from samples a third of the
    /// spacing apart, edges followed by fewer points.
    bool quick = false;
    /// Cosine of the least turn between faces that meet in an edge: 20 degrees, for hulls made of
    /// many facets.
    ///
    /// Nearer to 1 also smooth knuckles get lines of spheres.
    double sharp = 0.94;
    bool edges_by_ends = false;  ///< settle two points at each end of a straight edge, none between
    /// Where given, called now and then with the present stage and the finished share of it.
    std::function<void(const std::string& step, double share)> progress = {};
};

/// Fills a closed solid with contact spheres of one radius: surface spheres first, then interior.
///
/// Conforming: a layer tangent to the surface from inside (fill/make_layer.hpp), then every point
/// of a hexagonal close packing (in 2D a square lattice) whose sphere lies inside; the two overlap.
/// Lattice: a cubic one alone (fill/lattice.hpp). Shares, normals and the certificate are filled
/// in; names and provenance are the caller's.
///
/// The search for the largest sphere inside comes first. The time falls as the radius grows: it is
/// spent on places of the surface that are a part of the radius apart, not on the mesh's triangles.
///
/// @throws Error (exit code 2) when no sphere fits, naming the largest radius that does
SphereSet fill_spheres(const TriangleMesh& solid, const FillOptions& options,
                       SpheresReport& report);

/// Fills a section with discs in the plane y = 0; everything is per metre of breadth.
SphereSet fill_discs(const Section& section, const std::vector<std::string>& region_names,
                     const FillOptions& options, SpheresReport& report);

}  // namespace ice
