// SPDX-License-Identifier: GPL-3.0-or-later
/// Added mass and damping of a ship that another program computed, from a file.
#pragma once

#include <filesystem>

#include "solver/flow/added_mass.hpp"

namespace ice {

/// Matrices of surge, sway, heave along x, y, z and roll, pitch, yaw about axes through `about`, in
/// the hull mesh's axes.
struct ShipMatrix {
    Mat6 added = Mat6::Zero();    ///< [kg], [kg m], [kg m2]
    Mat6 damping = Mat6::Zero();  ///< [N s/m], [N s], [N m s]
    Vec3 about = Vec3::Zero();    ///< [m]
};

/// Reads ship.matrix, a TOML text as examples/ship_matrix.py writes it: `about`, and a row of six
/// numbers for each motion in [added_mass] and, where there is damping, in [damping]. Of each
/// matrix the symmetric part.
/// @throws Error (exit code 2) naming the line; (1) where the file cannot be read
ShipMatrix read_ship_matrix(const std::filesystem::path& file);

/// The matrix about another point: M' = T^T M T, v = v' + arm x w.
/// @param arm  from the old point to the new one [m]
Mat6 moved(const Mat6& matrix, const Vec3& arm);

/// Largest |M_ij| / sqrt(M_ii M_jj) [-], i != j; motions without mass do not count.
double largest_coupling(const Mat6& matrix);

}  // namespace ice
