// SPDX-License-Identifier: GPL-3.0-or-later
/// Added mass of bodies in ideal water, from the panels of the flow.
#pragma once

#include <Eigen/Core>

#include "solver/flow/source_panel.hpp"

namespace ice {

using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Added mass [kg], [kg m], [kg m2] for surge, sway, heave along x, y, z and roll, pitch, yaw about
/// axes through `about`, of water of this density:
///
///     A_ij = -rho int phi_i (n_j) dA,   v_i . n = n_i on the body,
///     n_i = n (i <= 3), (r - about) x n (i > 3)
///
/// with n into the water and the mean over a panel at its flux_points(). A is the symmetric part of
/// what the panels give. The body's images decide about the water's surface (PanelBody::image).
/// @param body     all of it: not PanelBody::symmetric
/// @param about    [m], in the panels' axes
/// @param density  of the water [kg/m3]
/// @throws Error (exit code 1) where the flow has no solution
Mat6 added_mass(const PanelBody& body, const Vec3& about, double density);

/// Added mass of a ship afloat.
struct ShipAddedMass {
    Mat6 matrix = Mat6::Zero();  ///< as added_mass(): [kg], [kg m], [kg m2]
    double displacement = 0.0;   ///< rho V of the panels' body [kg]
    std::size_t panels = 0;      ///< that it was computed from
};

/// The added mass of the wetted part of a closed hull. Surge, sway and yaw are slow: the water's
/// surface is a lid. Heave, roll and pitch are fast: it is free (phi = 0), the limit of infinite
/// frequency. Terms that couple the one with the other are 0, as they are for two such surfaces
/// together.
/// @param water  z of the water in the mesh's frame [m]
/// @param about  in the mesh's frame [m]
/// @param longest_edge  of a panel [m]; 0: a fifteenth of the wetted length
/// @throws Error (exit code 2) where nothing is wet; (1) where the flow has no solution
ShipAddedMass ship_added_mass(const TriangleMesh& hull, double water, const Vec3& about,
                              double density, double longest_edge = 0.0);

/// A closed body as panels, whole: the mesh's triangles, split until no edge is longer.
/// @param longest_edge  [m], > 0 @param image  PanelBody::image [-]
/// @throws Error (exit code 2) where that gives more than 4000 panels
PanelBody whole_body(const TriangleMesh& mesh, double longest_edge, double image);

}  // namespace ice
