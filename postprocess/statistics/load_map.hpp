// SPDX-License-Identifier: GPL-3.0-or-later
/// Where the ice pressed on the hull, on the average.
#pragma once

#include <vector>

#include "common/formats/run_file.hpp"

namespace ice::statistics {

/// Mean normal load on the hull over a part of the run.
struct LoadMap {
    TriangleMesh mesh;            ///< the hull in T small triangles, ship frame [m]
    std::vector<double> load;     ///< [T] per triangle [Pa]
    double radius = 0.0;          ///< each contact is spread over this distance [m]
    double from = 0.0, to = 0.0;  ///< averaged time [s]
    double force = 0.0;           ///< sum of load times area: mean of all |normal forces| [N]
};

/// Spreads the hull contacts of the frames with t > `from` over the hull's surface.
///
/// A contact at p with the mean normal force F over the time s adds to the triangles that face it
/// (outward normal against F) with centre c and area A
///
///     load = F s / T  k(|c - p| / radius) / sum(A k),   k(x) = (1 - x^2)^2 for x < 1, else 0
///
/// to the nearest triangle alone where none is so near. So load times area, summed, is the mean
/// force whatever the mesh. The radius is 1.5 spacings of the hull's spheres, but at least a
/// hundredth of the hull's length: a load on less than that is the spheres', not the hull's.
/// Coarse hull meshes are divided until their edges are shorter than the radius, large ones are
/// simplified before; see refine_mesh() and simplify_mesh().
///
/// In 2D distances are those in the x-z plane and the force is that on the mesh's breadth.
/// A run without contacts after `from`, or without a hull, gives zeros and an empty mesh.
/// @param from [s]
LoadMap make_load_map(const RunData& run, double from);

/// Divides triangles at the middle of every edge longer than `longest` until none is left; the
/// surface and its closedness stay. Stops, coarser, before it makes more than `most` triangles (a
/// count). @param longest [m], > 0
TriangleMesh refine_mesh(const TriangleMesh& mesh, double longest, std::size_t most);

/// The load that 99 % of the loaded area stays below, rounded up to two digits [Pa]; 0 without
/// load. Scales end there: a single spot would leave all others dark.
double scale_end(const LoadMap& map);

}  // namespace ice::statistics
