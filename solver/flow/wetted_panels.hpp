// SPDX-License-Identifier: GPL-3.0-or-later
/// The wetted hull as source panels.
#pragma once

#include <span>
#include <string>

#include "solver/flow/source_panel.hpp"

namespace ice {

/// How fine the panels are to be.
struct PanelSize {
    double longest_edge = 0.0;  ///< [m]; 0: a fifteenth of the wetted length
    std::size_t most = 4000;    ///< panels; bounds memory (8 most^2 bytes) and time
};

/// The wetted part of a closed hull.
struct WettedHull {
    PanelBody body;
    double longest_edge = 0.0;  ///< given, or chosen [m]
    Vec3 low, high;             ///< corners of its box, of both sides [m]
    double volume = 0.0;        ///< under water, of both sides [m3]
};

/// Cuts a closed mesh at the water, of a symmetric one keeps y >= 0, and splits longest edges until
/// none is longer than given; corners on edges of neighbours do not matter to source panels. Meshes
/// of more triangles than `most` are simplified first (meshoptimizer).
///
/// Faces in the water's surface are left out: the mirror image closes the body.
/// @param mesh    counter-clockwise seen from the water
/// @param water   z of the water in the mesh's frame; panels have z = 0 there [m]
/// @throws Error (exit code 2) where nothing is wet, or edges as short as given make more than
///         `most` panels
WettedHull make_wetted_hull(const TriangleMesh& mesh, double water, const PanelSize& size);

/// A mesh without the triangles of some regions, its vertices kept: thin plates such as rudders and
/// bilge keels, whose two sides are nearer to each other than a panel is long. The water passes
/// where they were.
/// @throws Error (exit code 2) where the mesh has no such region, or nothing is left
TriangleMesh without_regions(const TriangleMesh& mesh, std::span<const std::string> names);

/// All triangles of a mesh as panels, split until no edge is longer; none where that gives more
/// than `most`. @param longest_edge  [m], > 0
std::vector<SourcePanel> split_triangles(const TriangleMesh& mesh, double longest_edge,
                                         std::size_t most);

}  // namespace ice
